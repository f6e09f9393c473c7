#include "reference/events/surface_world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "physics/motion/driven_phase.h"
#include "planar_scenes.h"
#include "reference/events/event_solver.h"

namespace slipcheck {
namespace {

constexpr double kR = 0.03, kG = 9.81;

/// A ball on the substrate and one surface beside it.
Scene beside(const Surface& surface, const SurfaceContact& contact) {
  Scene scene;
  scene.bodies = {{kR, 0.2, 0.4}};
  scene.initial.resize(1);
  scene.initial[0].position = {0, 0, kR};
  scene.material = {0};
  SubstrateContact table;
  table.static_friction = table.kinetic_friction = 0.2;
  scene.substrate = {table};
  scene.pairs.resize(1);
  scene.gravity = kG;
  scene.surfaces = {surface};
  scene.on_surfaces = {contact};
  return scene;
}

SurfaceContact bouncing(double e, double friction, double beta = 0) {
  SurfaceContact contact;
  contact.impact = {e, friction, beta};
  contact.lasting.static_friction = contact.lasting.kinetic_friction = friction;
  contact.lasting.restitution = e;
  return contact;
}

const Surface kCushion{PlaneShape{Vector3(1, 0, 0), -Vector3::UnitX()}, {}};

/// The first frame after the first touch of what is no substrate.
struct AfterFirstHit final : FrameSink {
  void take(double, const Frame& frame) override {
    for (const Touch& touch : frame.touches)
      if (touch.second == surface_touch(0) && !state) state = frame.bodies[0];
  }
  std::optional<BodyState> state;
};

BodyState after_hit(const Scene& scene) {
  EventSolver solver(scene, scene.initial);
  AfterFirstHit hit;
  solver.run(until_time(10), &hit);
  EXPECT_TRUE(hit.state.has_value());
  return hit.state.value_or(BodyState{});
}

// Rigid impulses on a ball that rolls on a level table against a vertical cushion at the height of
// its centre. Before, u = (v_x, v_y + R Ω_z, −R Ω_y) at the point of contact; a free ball takes
// Δu_t = (1 + 1/q) P_t/m, Δu_n = P_n/m. 1e-12: roundings of the way there.
constexpr double kExact = 1e-12;

Scene rolling_towards(double vx, double vy, double spin, double e, double friction, double beta) {
  Scene scene = beside(kCushion, bouncing(e, friction, beta));
  scene.initial[0].velocity = {vx, vy, 0};
  scene.initial[0].angular_velocity = {-vy / kR, vx / kR, spin};
  return scene;
}

TEST(SurfaceWorld, CushionThatGripsStopsTheSlip) {
  const double vx = 2, vy = 0.5, spin = 3, e = 0.7;
  const BodyState after = after_hit(rolling_towards(vx, vy, spin, e, 10, 0));
  const double slip = vy + kR * spin;
  EXPECT_NEAR(after.velocity.x(), -e * vx, kExact);
  EXPECT_NEAR(after.velocity.y(), vy - 2 * slip / 7, kExact);
  EXPECT_NEAR(after.velocity.z(), 2 * vx / 7, kExact);  // it climbs
  // ΔΩ = −(5/2)/(m R) n×P with n = −x̂, and no slip is left.
  EXPECT_NEAR(after.angular_velocity.z(), spin - 2.5 / kR * 2 * slip / 7, kExact / kR);
  EXPECT_NEAR(after.angular_velocity.y(), vx / kR - 2.5 / kR * 2 * vx / 7, kExact / kR);
  EXPECT_NEAR(after.angular_velocity.x(), -vy / kR, kExact / kR);
}

TEST(SurfaceWorld, CushionThatSlipsTakesCoulombsImpulse) {
  const double vx = 2, vy = 1.5, spin = -4, e = 0.85, friction = 0.14;
  const BodyState after = after_hit(rolling_towards(vx, vy, spin, e, friction, 0.3));
  const double normal = (1 + e) * vx;
  const Vector3 slip(0, vy + kR * spin, -vx);
  const Vector3 push = -friction * normal * slip.normalized();  // per mass
  EXPECT_NEAR(after.velocity.x(), -e * vx, kExact);
  EXPECT_NEAR(after.velocity.y(), vy + push.y(), kExact);
  EXPECT_NEAR(after.velocity.z(), push.z(), kExact);
  EXPECT_NEAR(after.angular_velocity.z(), spin + 2.5 / kR * push.y(), kExact / kR);
  EXPECT_NEAR(after.angular_velocity.y(), vx / kR - 2.5 / kR * push.z(), kExact / kR);
}

/// With backspin the cushion presses the ball onto the table, whose friction then acts, too.
TEST(SurfaceWorld, TableTakesItsPartInAnImpactThatPressesDown) {
  const double vx = 2, e = 0.8, friction = 0.2, table = 0.2;
  Scene scene = rolling_towards(vx, 0, 0, e, friction, 0);
  scene.initial[0].position.x() = 1 - kR - 1e-9;  // no friction on the way there
  scene.initial[0].angular_velocity = {0, -150, 0};
  const double way = 1e-9 / vx;
  const double spin = -150 + 2.5 * table * kG * way / kR, speed = vx - table * kG * way;
  const BodyState after = after_hit(scene);
  const double normal = (1 + e) * speed, down = friction * normal;
  const double turned = spin + 2.5 / kR * down;  // of the cushion alone
  const double bottom = -e * speed - kR * turned;
  ASSERT_GT(bottom, 0);
  ASSERT_LT(3.5 * table * down, bottom);  // it goes on to slip
  EXPECT_NEAR(after.velocity.z(), 0, kExact);
  EXPECT_NEAR(after.velocity.x(), -e * speed - table * down, 1e-9);
  EXPECT_NEAR(after.angular_velocity.y(), turned + 2.5 / kR * table * down, 1e-9 / kR);
}

TEST(SurfaceWorld, CushionThatMovesAddsItsSpeed) {
  Scene scene = beside({kCushion.shape, SurfaceMotion::moving(SubstrateMotion::constant({0.5, 0}),
                                                              -Vector3::UnitX(), kUp)},
                       bouncing(0.6, 0));
  scene.substrate[0] = {};
  scene.initial[0].velocity = {1, 0, 0};
  AfterFirstHit hit;
  EventSolver solver(scene, scene.initial);
  EXPECT_NEAR(solver.first_contact(5), (1 - kR) / 1.5, 1e-14);
  solver.run(until_time(1), &hit);
  EXPECT_NEAR(hit.state->velocity.x(), -0.5 - 0.6 * 1.5, kExact);
}

// --- a plate that carries
// -------------------------------------------------------------------------

/// A slope of 3 in 4 under gravity alone; its normal is (0.6, 0, 0.8).
Scene on_slope(double friction) {
  Scene scene =
      beside({RectangleShape{Vector3(2, 0, 1.5), Vector3(2, 0, -1.5), Vector3(0, 3, 0)}, {}},
             bouncing(0, friction));
  scene.initial[0].position = Vector3(1, 0, 2.25) + kR * Vector3(0.6, 0, 0.8);
  return scene;
}

TEST(SurfaceWorld, BallRollsDownASlopeThatHoldsIt) {
  const Scene scene = on_slope(0.5);  // > 2/7 tan
  EventSolver solver(scene, scene.initial);
  ASSERT_TRUE(solver.run(until_time(0.4), nullptr).reached);
  const BodyState state = solver.states()[0];
  const Vector3 down(0.8, 0, -0.6);
  const double speed = 5.0 / 7 * 0.6 * kG * 0.4;
  EXPECT_NEAR((state.velocity - speed * down).norm(), 0, kExact);
  EXPECT_NEAR((state.position - scene.initial[0].position - 0.5 * speed * 0.4 * down).norm(), 0,
              kExact);
  EXPECT_NEAR(state.angular_velocity.y(), speed / kR, kExact / kR);
}

TEST(SurfaceWorld, BallSlipsDownASlopeThatDoesNot) {
  const double friction = 0.1;  // < 2/7 · 3/4
  const Scene scene = on_slope(friction);
  EventSolver solver(scene, scene.initial);
  ASSERT_TRUE(solver.run(until_time(0.4), nullptr).reached);
  const BodyState state = solver.states()[0];
  EXPECT_NEAR(state.velocity.norm(), (0.6 - friction * 0.8) * kG * 0.4, kExact);
  EXPECT_NEAR(state.angular_velocity.y(), 2.5 * friction * 0.8 * kG / kR * 0.4, kExact / kR);
}

/// The same motion as on a substrate that is tilted, in its own frame.
TEST(SurfaceWorld, SlopeAgreesWithATiltedSubstrate) {
  Scene plate = on_slope(0.1);
  const Vector3 normal(0.6, 0, 0.8), down(0.8, 0, -0.6), across(0, 1, 0);
  plate.initial[0].velocity = 0.3 * across + 0.2 * down;
  plate.initial[0].angular_velocity = 7 * normal - 5 * down;
  plate.on_surfaces[0].lasting.drilling_length = 1e-3;
  plate.on_surfaces[0].lasting.rolling = RollingFriction({{0, 0.01}, {1, 0.03}});
  EventSolver on_plate(plate, plate.initial);
  ASSERT_TRUE(on_plate.run(until_time(0.5), nullptr).reached);

  BodyState state;
  state.position = {0, 0, kR};
  state.velocity = {0.3, -0.2, 0};  // downhill along −y
  state.angular_velocity = {0, 5, 7};
  const Vector2 downhill(0, -0.6 * kG);
  double time = 0;
  while (time < 0.5) {
    const DrivenPhase phase(plate.bodies[0], plate.on_surfaces[0].lasting, 0.8 * kG, downhill, {},
                            time, state);
    const double step = std::min(phase.duration(), 0.5 - time);
    state = step < phase.duration() ? phase.at(step) : phase.at_end();
    time += step;
  }
  const BodyState found = on_plate.states()[0];
  const Vector3 way = found.position - plate.initial[0].position;
  EXPECT_NEAR(way.dot(across), state.position.x(), 1e-11);
  EXPECT_NEAR(way.dot(down), -state.position.y(), 1e-11);
  EXPECT_NEAR(way.dot(normal), 0, 1e-14);
  EXPECT_NEAR(found.velocity.dot(down), -state.velocity.y(), 1e-11);
  EXPECT_NEAR(found.angular_velocity.dot(normal), state.angular_velocity.z(), 1e-9);
}

TEST(SurfaceWorld, BallFliesOverTheEdgeAndLandsWhereTheParabolaDoes) {
  const double height = 0.5, speed = 2;
  Scene scene =
      beside({RectangleShape{Vector3(0, 0, height), Vector3(1, 0, 0), Vector3(0, 1, 0)}, {}},
             bouncing(0, 0));
  scene.substrate[0] = {};
  scene.initial[0].position = {0, 0, height + kR};
  scene.initial[0].velocity = {speed, 0, 0};
  EventSolver solver(scene, scene.initial);
  const double fall = std::sqrt(2 * height / kG);
  EXPECT_NEAR(solver.first_contact(10), 1 / speed + fall, kExact);
  ASSERT_TRUE(solver.run(until_time(1 / speed + fall + 0.1), nullptr).reached);
  const BodyState state = solver.states()[0];
  EXPECT_NEAR(state.position.x(), 1 + speed * (fall + 0.1), kExact);
  EXPECT_EQ(state.position.z(), kR);
}

TEST(SurfaceWorld, SlowBallTurnsAboutTheEdgeWhichLasts) {
  Scene scene = beside({RectangleShape{Vector3(0, 0, 0.5), Vector3(1, 0, 0), Vector3(0, 1, 0)}, {}},
                       bouncing(0, 0.3));
  scene.initial[0].position = {0, 0, 0.5 + kR};
  const double limit = std::sqrt(kG * kR);
  for (const double part : {0.99, 1.01}) {
    scene.initial[0].velocity = {part * limit, 0, 0};
    scene.initial[0].angular_velocity = {0, part * limit / kR, 0};
    EventSolver solver(scene, scene.initial);
    const SolvedRun run = solver.run(until_time(4), nullptr);
    EXPECT_EQ(run.lasting, part < 1) << run.reason;
    EXPECT_EQ(run.reached, part > 1) << run.reason;
  }
}

TEST(SurfaceWorld, BallBetweenTwoSlopesLasts) {
  Scene scene = on_slope(0.5);
  scene.has_substrate = false;
  scene.surfaces.push_back(
      {RectangleShape{Vector3(6, 0, 1.5), Vector3(2, 0, 1.5), Vector3(0, 3, 0)}, {}});
  scene.on_surfaces.push_back(scene.on_surfaces[0]);
  EventSolver solver(scene, scene.initial);
  const SolvedRun run = solver.run(until_time(60), nullptr);
  EXPECT_FALSE(run.reached);
  EXPECT_TRUE(run.lasting);
  EXPECT_NE(run.reason.find("body 0"), std::string::npos) << run.reason;
}

/// A belt on a plate takes a ball along until it rolls on it at 2/7 of the belt's speed.
TEST(SurfaceWorld, BeltCarriesABall) {
  const double belt = 0.7, friction = 0.2;
  Scene scene = beside(
      {PlaneShape{Vector3(0, 0, -1), kUp}, SurfaceMotion::belt(SubstrateMotion::constant({belt, 0}),
                                                               Vector3::UnitY(), Vector3::UnitX())},
      bouncing(0, friction));
  scene.has_substrate = false;
  scene.initial[0].position = {0, 0, kR - 1};
  EventSolver solver(scene, scene.initial);
  const double slide = 2 * belt / (7 * friction * kG);
  ASSERT_TRUE(solver.run(until_time(slide + 0.1), nullptr).reached);
  const BodyState state = solver.states()[0];
  EXPECT_NEAR(state.velocity.y(), 2 * belt / 7, kExact);
  EXPECT_NEAR(state.position.y(), 0.5 * friction * kG * slide * slide + 0.1 * 2 * belt / 7, kExact);
}

/// e^k of the speed after k bounces on a ball that is fixed, straight from above.
TEST(SurfaceWorld, BouncesOnWhatIsRound) {
  Scene scene = beside({BallShape{Vector3(0, 0, 1), 0.2}, {}}, bouncing(0.5, 0.3));
  scene.initial[0].position = {0, 0, 1.2 + kR + 0.5};
  const double speed = std::sqrt(2 * kG * 0.5);
  AfterFirstHit hit;
  EventSolver solver(scene, scene.initial);
  EXPECT_NEAR(solver.first_contact(1), speed / kG, kExact);
  solver.run(until_time(speed / kG + 0.1), &hit);
  EXPECT_NEAR(hit.state->velocity.z(), 0.5 * speed, kExact);
}

/// Who is in no cell beside a body meets it not: the same collisions. Instants are found from other
/// moments, whose roundings some three collisions a body let grow to less than 1e-9.
TEST(SurfaceWorld, CellsFindWhatAllPairsFind) {
  const Scene scene = test::balls_in_frame(60);
  EventSolver in_cells(scene, scene.initial);
  EventSolver all_pairs(scene, scene.initial, {.most_without_cells = 60});
  ASSERT_NE(in_cells.features(), all_pairs.features());
  const SolvedRun cells = in_cells.run(until_time(6), nullptr);
  const SolvedRun pairs = all_pairs.run(until_time(6), nullptr);
  ASSERT_TRUE(cells.reached && pairs.reached);
  EXPECT_GT(cells.collisions, 80u);
  EXPECT_EQ(cells.collisions, pairs.collisions);
  EXPECT_EQ(cells.events, pairs.events);
  const std::vector<BodyState> a = in_cells.states(), b = all_pairs.states();
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_LT((a[i].position - b[i].position).norm(), 1e-9) << i;
    EXPECT_LT((a[i].velocity - b[i].velocity).norm(), 1e-9) << i;
  }
}

/// Flights, and slides on a table that moves, whose ways through cells are no parabolas.
TEST(SurfaceWorld, CellsFollowFlightsAndSlides) {
  Scene scene = test::balls_in_frame(30);
  for (std::size_t i = 0; i < scene.initial.size(); i += 3)
    scene.initial[i].position.z() += 2 + 0.1 * static_cast<double>(i);
  scene.motion = SubstrateMotion::constant({0.3, -0.2});
  EventSolver in_cells(scene, scene.initial);
  EventSolver all_pairs(scene, scene.initial, {.most_without_cells = 30});
  const SolvedRun cells = in_cells.run(until_time(2), nullptr);
  const SolvedRun pairs = all_pairs.run(until_time(2), nullptr);
  ASSERT_TRUE(cells.reached && pairs.reached) << cells.reason << pairs.reason;
  EXPECT_GT(cells.collisions, 10u);
  EXPECT_EQ(cells.collisions, pairs.collisions);
  const std::vector<BodyState> a = in_cells.states(), b = all_pairs.states();
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_LT((a[i].position - b[i].position).norm(), 1e-8) << i;
}

}  // namespace
}  // namespace slipcheck
