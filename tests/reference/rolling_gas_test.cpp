#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../scenes.h"
#include "../support/deepest_overlap.h"
#include "../support/extremes.h"
#include "reference/events/event_solver.h"
#include "reference/forces/contact_solver.h"

namespace slipcheck {
namespace {

/// side² rolling balls on a jittered square lattice of `spacing` [m] around `middle`, with
/// velocities of up to `speed` [m/s].
Scene gas(std::size_t side, double spacing, double speed, const Vector2& middle, unsigned seed) {
  Scene scene = test::steel_scene(side * side);
  std::mt19937_64 random(seed);
  const auto u = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  const double low = -0.5 * spacing * static_cast<double>(side);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const double jitter = 0.45 * (spacing - 0.004);
    const double x = low + spacing * (static_cast<double>(i % side) + 0.5) + jitter * u();
    const double y = low + spacing * (static_cast<double>(i / side) + 0.5) + jitter * u();
    const double v_y = speed * u(), v_x = speed * u();  // arguments are drawn in any order
    scene.initial[i] = test::rolling_at(middle.x() + x, middle.y() + y, v_x, v_y);
  }
  return scene;
}

Scene periodic_gas(std::size_t side, double spacing, double speed, const Vector2& middle,
                   unsigned seed) {
  Scene scene = gas(side, spacing, speed, middle, seed);
  scene.periodic = Vector2::Constant(spacing * static_cast<double>(side));
  return scene;
}

/// The collisions of a run: who, and when.
struct Collisions final : FrameSink {
  void take(double time, const Frame& frame) override {
    for (const Touch& touch : frame.touches)
      if (touch.second != kSubstrate) {
        times.push_back(time);
        pairs.push_back({touch.first, touch.second});
      }
  }
  std::vector<double> times;
  std::vector<std::pair<int, int>> pairs;
};

Collisions collisions_of(const Scene& scene, double end, const EventSettings& settings = {}) {
  Collisions seen;
  EventSolver(scene, scene.initial, settings).run(until_time(end), &seen);
  return seen;
}

EventSettings without_cells() {
  EventSettings settings;
  settings.most_without_cells = 10000;
  return settings;
}

Vector3 momentum(const Scene& scene, const std::vector<BodyState>& states) {
  Vector3 p = Vector3::Zero();
  for (std::size_t i = 0; i < states.size(); ++i) p += scene.bodies[i].mass * states[i].velocity;
  return p;
}

double kinetic_energy(const Scene& scene, const std::vector<BodyState>& states) {
  double e = 0;
  for (std::size_t i = 0; i < states.size(); ++i)
    e += 0.5 * scene.bodies[i].mass * states[i].velocity.squaredNorm() +
         0.5 * scene.bodies[i].moment_of_inertia() * states[i].angular_velocity.squaredNorm();
  return e;
}

void expect_same(const Collisions& a, const Collisions& b, std::size_t count, double tolerance) {
  ASSERT_GE(a.times.size(), count);
  ASSERT_GE(b.times.size(), count);
  for (std::size_t k = 0; k < count; ++k) {
    ASSERT_EQ(a.pairs[k], b.pairs[k]) << k;
    ASSERT_NEAR(a.times[k], b.times[k], tolerance) << k;
  }
}

TEST(RollingGas, CellsFindTheCollisionsOfAllPairs) {
  const Scene scene = gas(10, 0.0055, 0.3, {0.013, -0.002}, 1);
  // Rounding, 1e-17 s here, grows some tenfold at each of a ball's collisions, here 4 in the mean.
  expect_same(collisions_of(scene, 0.5), collisions_of(scene, 0.5, without_cells()), 200, 1e-9);
}

/// side² balls in a triangular lattice of `spacing` [m], each moved a little.
Scene dense_gas(std::size_t side, double spacing, double speed, unsigned seed) {
  Scene scene = test::steel_scene(side * side);
  std::mt19937_64 random(seed);
  const auto u = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  const double jitter = 0.3 * (spacing - 0.004);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::size_t row = i / side;
    const double x = spacing * (static_cast<double>(i % side) + (row % 2 == 0 ? 0.0 : 0.5));
    const double y = spacing * std::sqrt(0.75) * static_cast<double>(row);
    const double v_y = speed * u(), v_x = speed * u(), d_y = jitter * u(), d_x = jitter * u();
    scene.initial[i] = test::rolling_at(x + d_x, y + d_y, v_x, v_y);
  }
  return scene;
}

TEST(RollingGas, CellsFindTheCollisionsOfAllPairsWhereABodyHasLessRoomThanItsDiameter) {
  // In a triangular lattice of 2.02 R a ball has √0.75 · 2.02² R² = (1.88 R)²: cells must be larger
  // than this, or two that touch are not in neighbouring ones.
  const Scene scene = dense_gas(9, 2.02 * 0.002, 0.05, 12);
  // Some 5 collisions a ball: 1e-17 s grow as above.
  expect_same(collisions_of(scene, 0.004), collisions_of(scene, 0.004, without_cells()), 100, 1e-9);
}

TEST(RollingGas, CellsFindTheCollisionsOfAllPairsWhereRollingFrictionDependsOnTheSpeed) {
  Scene scene = gas(8, 0.0055, 0.3, {0, 0}, 2);
  scene.substrate[0].rolling = RollingFriction({{0, 0.001}, {0.1, 0.004}, {0.5, 0.01}});
  expect_same(collisions_of(scene, 0.5), collisions_of(scene, 0.5, without_cells()), 150, 1e-9);
}

TEST(RollingGas, RunUntilRollingEndsAlikeWithCellsAndWithout) {
  Scene scene = gas(7, 0.012, 0.1, {0, 0}, 3);
  scene.substrate[0].rolling = RollingFriction(0.002);
  for (const Run::Until what : {Run::Until::rolling, Run::Until::rest}) {
    EventSolver cells(scene, scene.initial), pairs(scene, scene.initial, without_cells());
    const RunEnd end{what, 0, 60};
    const SolvedRun a = cells.run(end, nullptr), b = pairs.run(end, nullptr);
    ASSERT_TRUE(a.reached && b.reached) << a.reason << b.reason;
    EXPECT_GT(a.collisions, 20u);
    EXPECT_EQ(a.collisions, b.collisions);
    EXPECT_NEAR(a.end_time, b.end_time, 1e-9);  // as above
  }
}

TEST(RollingGas, PeriodicGasIsTheSameWhereverItsBorderLies) {
  // Shifted by half the cell, what met inside meets across the border.
  const Scene here = periodic_gas(6, 0.007, 0.3, {0.021, 0.021}, 4);
  const Scene there = periodic_gas(6, 0.007, 0.3, {0.0, 0.042}, 4);
  // Positions are other numbers with other roundings; 5 collisions a ball amplify them as above.
  expect_same(collisions_of(here, 1), collisions_of(there, 1), 100, 1e-9);
}

TEST(RollingGas, StatesGoOnAcrossThePeriodicBorder) {
  Scene scene = test::steel_scene(1);
  scene.periodic = {0.02, 0};
  scene.initial[0] = test::rolling_at(0.001, 0.3, -0.5, 0.25);
  EventSolver solver(scene, scene.initial);
  ASSERT_TRUE(solver.run(until_time(4), nullptr).reached);
  // Rounding of numbers of order 1.
  EXPECT_NEAR(solver.states()[0].position.x(), 0.001 - 2, 1e-14);
  EXPECT_NEAR(solver.states()[0].position.y(), 1.3, 1e-14);
}

TEST(RollingGas, TwoBallsMeetAroundThePeriodicCell) {
  Scene scene = test::head_on(-0.1, 0.1, 0.9);  // 1 cm apart, running apart
  scene.periodic = {0.03, 0.02};
  EventSolver solver(scene, scene.initial);
  // The images are 3 − 1 cm apart and touch at 4 mm.
  EXPECT_NEAR(solver.next_collision(1, 0), (0.02 - 0.004) / 0.2, 1e-15);
}

TEST(RollingGas, FrictionlessPeriodicGasKeepsMomentumAndEnergy) {
  Scene scene = periodic_gas(10, 0.006, 0.3, {0, 0}, 5);
  scene.substrate[0].kinetic_friction = 0;
  scene.pairs[0].restitution = 1.0;
  EventSolver solver(scene, scene.initial);
  const SolvedRun run = solver.run(until_time(2), nullptr);
  ASSERT_GT(run.collisions, 5000u);
  const double energy = kinetic_energy(scene, scene.initial);
  const double scale = std::sqrt(2 * energy * scene.bodies[0].mass * 100);
  // One rounding of the pair's momentum, about 1e-16, at each collision.
  const double rounding = 1e-16 * static_cast<double>(run.collisions);
  EXPECT_LE((momentum(scene, solver.states()) - momentum(scene, scene.initial)).norm(),
            rounding * scale);
  EXPECT_NEAR(kinetic_energy(scene, solver.states()) / energy, 1, 10 * rounding);
  // Positions are rounded to 1e-17 m.
  EXPECT_LE(test::deepest_overlap(scene, solver.states()), 1e-12);
}

/// Adds up what each contact takes: sliding μ_k m g |u|, whose slip falls linearly; rolling
/// (1 + q) μ_r m g |v|; a collision ½ m_eff (1 − e²) u_n².
struct Losses final : FrameSink {
  explicit Losses(const Scene& watched) : scene(watched) {}
  void take(double time, const Frame& frame) override {
    for (std::size_t i = 0; time > last && i < frame.bodies.size(); ++i) {
      const Sphere& ball = scene.bodies[i];
      const SubstrateContact& on = scene.on_substrate(i);
      const BodyState &a = before.bodies[i], &b = frame.bodies[i];
      const double slip = slip_velocity(a, ball.radius).norm();
      const double weight = ball.mass * scene.gravity;
      if (slip > 1e-12)
        lost += on.kinetic_friction * weight * (time - last) * 0.5 *
                (slip + slip_velocity(b, ball.radius).norm());
      else
        lost += (1 + ball.shape_factor) * on.rolling(0) * weight * (b.position - a.position).norm();
    }
    for (const Touch& touch : frame.touches)
      if (touch.second != kSubstrate) {
        const auto i = static_cast<std::size_t>(touch.first);
        const auto j = static_cast<std::size_t>(touch.second);
        const BodyState &a = before.bodies[i], &b = before.bodies[j];
        Vector3 n = a.position - b.position;
        for (int axis : {0, 1})
          n[axis] -= scene.periodic[axis] * std::nearbyint(n[axis] / scene.periodic[axis]);
        const double u = n.normalized().dot(a.velocity - b.velocity);
        const double e = std::get<double>(scene.between(i, j).restitution);
        lost += 0.25 * scene.bodies[i].mass * (1 - e * e) * u * u;
      }
    before = frame;
    last = time;
  }
  const Scene& scene;
  Frame before;
  double last = 0, lost = 0;
};

TEST(RollingGas, EnergyGoesWhereTheContactsTakeIt) {
  Scene scene = periodic_gas(7, 0.006, 0.3, {0, 0}, 6);
  scene.substrate[0].rolling = RollingFriction(0.003);
  EventSolver solver(scene, scene.initial);
  Losses losses(scene);
  const SolvedRun run = solver.run(until_time(0.5), &losses);
  ASSERT_GT(run.collisions, 100u);
  const double energy = kinetic_energy(scene, scene.initial);
  // Some roundings of the energy at each of about 1000 events.
  EXPECT_NEAR((kinetic_energy(scene, solver.states()) + losses.lost) / energy, 1, 1e-12);
}

TEST(RollingGas, ThousandBallsNeverOverlapAndGiveTheSameBitsAgain) {
  Scene scene = periodic_gas(32, 0.0052, 0.3, {0.01, 0.02}, 7);
  scene.substrate[0].rolling = RollingFriction({{0, 0.001}, {0.2, 0.004}});
  EventSolver a(scene, scene.initial), b(scene, scene.initial);
  std::size_t collisions = 0;
  for (int k = 1; k <= 5; ++k) {
    const SolvedRun run = a.run(until_time(0.05 * k), nullptr);
    ASSERT_TRUE(run.reached) << run.reason;
    collisions += run.collisions;
    b.run(until_time(0.05 * k), nullptr);
    EXPECT_LE(test::deepest_overlap(scene, a.states()), 1e-12);
  }
  EXPECT_GT(collisions, 2000u);
  const std::vector<BodyState> of_a = a.states(), of_b = b.states();
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    ASSERT_EQ(of_a[i].position, of_b[i].position);
    ASSERT_EQ(of_a[i].angular_velocity, of_b[i].angular_velocity);
  }
}

TEST(RollingGas, CopyRunsOnByItself) {
  const Scene scene = periodic_gas(6, 0.006, 0.3, {0, 0}, 8);
  EventSolver solver(scene, scene.initial);
  solver.run(until_time(0.05), nullptr);
  EventSolver other = solver;
  other.run(until_time(0.1), nullptr);
  solver.run(until_time(0.1), nullptr);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    EXPECT_EQ(solver.states()[i].position, other.states()[i].position);
}

// --- rules for collapse --------------------------------------------------------------------------

TEST(RollingGas, CollisionsInQuickSuccessionDoNotDissipateUnderTheContactTimeModel) {
  // The spins drive the balls together again 2 e v/(μ_k g) = 6 ms after the first time, and slide
  // for (1 + e) v/((1 + A) μ_k g) = 45 ms.
  Scene scene = test::head_on(0.15, -0.15, 0.02);
  scene.collapse = {CollapseRule::Model::contact_time, 1.0};
  struct Speeds final : FrameSink {
    void take(double, const Frame& frame) override {
      const double now = frame.bodies[0].velocity.x();
      if (frame.touches.size() == 3) {
        impact.push_back(before);
        rebound.push_back(-now);
      }
      before = now;
    }
    double before = 0;
    std::vector<double> impact, rebound;
  } seen;
  EventSolver solver(scene, scene.initial);
  const SolvedRun run = solver.run({Run::Until::rolling, 0, 10}, &seen);
  ASSERT_TRUE(run.reached) << run.reason;
  ASSERT_GE(seen.impact.size(), 7u);
  EXPECT_EQ(run.collapses, run.collisions - 1);
  EXPECT_NEAR(seen.rebound[0], 0.02 * seen.impact[0], 1e-16);
  // Friction brakes and drives back alike, and no collision takes anything: roundings of 0.15 m/s.
  for (std::size_t k = 1; k < seen.impact.size(); ++k)
    EXPECT_NEAR(seen.rebound[k], seen.impact[k], 1e-16) << k;
  EXPECT_NEAR(seen.impact[1], 0.02 * 0.15, 1e-15);
}

TEST(RollingGas, ContactTimeIsTheTimeBelowWhichACollisionIsElastic) {
  // As above: the second collision follows the first after 2 e v/(μ_k g), of which e v/(μ_k g)
  // apart and as long back again, on parabolas.
  const double e = 0.02, between = 2 * e * 0.15 / (0.1 * 9.81), first = (0.01 - 0.004) / 0.3;
  for (const double share : {0.6, 0.99, 1.01}) {
    Scene scene = test::head_on(0.15, -0.15, e);
    scene.collapse = {CollapseRule::Model::contact_time, between * share};
    EventSolver solver(scene, scene.initial);
    const SolvedRun run = solver.run(until_time(first + 1.001 * between), nullptr);
    ASSERT_EQ(run.collisions, 2u);
    EXPECT_EQ(run.collapses, share < 1 ? 0u : 1u) << share;
  }
}

TEST(RollingGas, ClusterComesToRestAtOnceUnderTheLargestVelocityModel) {
  // Three balls in a row, without friction: 0 runs into 1 and 2, which nearly touch. Once 0 and 1
  // meet again, the three have collapsed: what is left of approach is 1e-6 of it.
  Scene scene = test::steel_scene(3);
  scene.substrate[0].kinetic_friction = 0;
  scene.pairs[0].restitution = 0.1;
  scene.collapse = {CollapseRule::Model::largest_velocity, 1.0};
  scene.initial[0] = test::rolling_at(-0.01, 0, 0.1, 0);
  scene.initial[1] = test::rolling_at(0, 0, 0, 0);
  scene.initial[2] = test::rolling_at(0.004 + 1e-5, 0, 0, 0);
  EventSolver solver(scene, scene.initial);
  const SolvedRun run = solver.run(until_time(1), nullptr);
  ASSERT_TRUE(run.reached) << run.reason;
  EXPECT_GT(run.collapses, 0u);
  EXPECT_LT(run.collisions, 100u);
  const std::vector<BodyState> states = solver.states();
  EXPECT_NEAR(states[0].velocity.x() + states[1].velocity.x() + states[2].velocity.x(), 0.1, 1e-15);
  EXPECT_LE(states[0].velocity.x() - states[1].velocity.x(), 1e-6 * 0.1);
  EXPECT_LE(states[1].velocity.x() - states[2].velocity.x(), 1e-6 * 0.1);
  EXPECT_LE(test::deepest_overlap(scene, states), 1e-12);
}

// --- tilted and moving planes --------------------------------------------------------------------

/// The event solver against the integrated phases of ContactSolver: their collisions and states.
void expect_as_integrated(const Scene& scene, double end, std::size_t collisions,
                          double tolerance) {
  Collisions a, b;
  EventSolver events(scene, scene.initial);
  const SolvedRun run = events.run(until_time(end), &a);
  ASSERT_TRUE(run.reached) << run.reason;
  const ContactScene contacts = with_hard_contacts(scene);
  ContactSolver integrated(contacts, scene.initial);
  ASSERT_TRUE(integrated.run(until_time(end), &b).reached);
  EXPECT_EQ(a.times.size(), b.times.size());
  expect_same(a, b, collisions, tolerance);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    EXPECT_LE((events.states()[i].position - integrated.states()[i].position).norm(), tolerance);
    EXPECT_LE((events.states()[i].velocity - integrated.states()[i].velocity).norm(),
              10 * tolerance);
  }
}

TEST(RollingGas, ThirtySixBallsOnAnOscillatingPlaneMoveAsIntegrated) {
  Scene scene = gas(6, 0.0065, 0.2, {0, 0}, 9);
  scene.motion = SubstrateMotion::oscillation({0.004, 0.001}, 8, 0.4);
  // CVODE's error, 1e-13 relative a step, and tenfold at each of a ball's first collisions.
  expect_as_integrated(scene, 0.03, 10, 1e-11);
}

TEST(RollingGas, BallsOnATiltedPlaneWithRollingFrictionMoveAsIntegrated) {
  Scene scene = gas(6, 0.0065, 0.2, {0, 0}, 10);
  scene.downhill = {0, -9.81 * std::sin(0.05)};
  scene.gravity = 9.81 * std::cos(0.05);
  scene.substrate[0].rolling = RollingFriction(0.005);
  expect_as_integrated(scene, 0.03, 10, 1e-11);
}

/// A ball that rolls down a slope from rest and one that rolling friction holds on it, `gap` [m]
/// apart.
Scene ball_above_a_held_one(double angle, double gap) {
  Scene scene = test::steel_scene(2);
  scene.downhill = {9.81 * std::sin(angle), 0};
  scene.gravity = 9.81 * std::cos(angle);
  scene.material = {0, 1};
  scene.substrate.push_back(scene.substrate[0]);
  scene.substrate[1].rolling = RollingFriction(0.2);
  scene.pairs.assign(4, scene.pairs[0]);
  scene.initial = {test::rolling_at(0, 0, 0, 0), test::rolling_at(0.004 + gap, 0, 0, 0)};
  return scene;
}

TEST(RollingGas, ABallThatRollsDownASlopeMeetsAHeldOneWhenItMust) {
  // Rolling takes (5/7) g sin θ, K (24): the gap is gone after √(2 d/a), whichever is the first.
  const double angle = 0.05, gap = 0.013, a = 5.0 / 7 * 9.81 * std::sin(angle);
  Scene scene = ball_above_a_held_one(angle, gap);
  for (const int turn : {0, 1}) {
    EventSolver solver(scene, scene.initial);
    EXPECT_NEAR(solver.next_collision(10, 0), std::sqrt(2 * gap / a), 1e-14) << turn;
    std::swap(scene.initial[0], scene.initial[1]);
    std::swap(scene.material[0], scene.material[1]);
  }
}

TEST(RollingGas, ASmoothBallOnASlopeCatchesARollingOneWhenItMust) {
  // Both from rest, the one without friction above: g sin θ against (5/7) g sin θ.
  const double angle = 0.05, gap = 0.013, a = 2.0 / 7 * 9.81 * std::sin(angle);
  Scene scene = ball_above_a_held_one(angle, gap);
  scene.material = {1, 0};
  scene.substrate[1] = SubstrateContact{};
  for (const int turn : {0, 1}) {
    EventSolver solver(scene, scene.initial);
    EXPECT_NEAR(solver.next_collision(10, 0), std::sqrt(2 * gap / a), 1e-14) << turn;
    std::swap(scene.initial[0], scene.initial[1]);
    std::swap(scene.material[0], scene.material[1]);
  }
}

TEST(RollingGas, ABallOnASlopeHitsAHeldOneAgainAndAgainAsIntegrated) {
  // In the end it leans on the other one, after ever weaker collisions: the first three of them.
  const Scene scene = ball_above_a_held_one(0.05, 0.002);
  Collisions a, b;
  EventSolver events(scene, scene.initial);
  double end = 0;
  for (int k = 0; k < 3; ++k) {
    end = events.next_collision(10, 0) + 1e-6;
    ASSERT_TRUE(events.run(until_time(end), &a).reached);
  }
  const ContactScene contacts = with_hard_contacts(scene);
  ContactSolver integrated(contacts, scene.initial);
  ASSERT_TRUE(integrated.run(until_time(end), &b).reached);
  // CVODE's error, 1e-13 relative a step, over some hundred steps.
  expect_same(a, b, 3, 1e-10);
}

TEST(RollingGas, RestOnATiltedPlaneWaitsForTheSpin) {
  // Rolling friction holds the ball where it is; its spin about the vertical, against which
  // drilling friction has the torque l m g cos θ, dies after ω q R²/(l g cos θ).
  const double angle = 0.02, spin = 30, length = 1e-5;
  Scene scene = test::steel_scene(1);
  scene.downhill = {9.81 * std::sin(angle), 0};
  scene.gravity = 9.81 * std::cos(angle);
  scene.substrate[0].rolling = RollingFriction(0.2);
  scene.substrate[0].drilling_length = length;
  scene.initial[0] = test::rolling_at(0, 0, 0, 0);
  scene.initial[0].angular_velocity.z() = spin;
  EventSolver solver(scene, scene.initial);
  const SolvedRun run = solver.run({Run::Until::rest, 0, 60}, nullptr);
  ASSERT_TRUE(run.reached) << run.reason;
  EXPECT_NEAR(run.end_time, spin * 0.4 * 4e-6 / (length * scene.gravity), 1e-12);
  EXPECT_EQ(solver.states()[0].angular_velocity.z(), 0);
}

TEST(RollingGas, GasOnAnOscillatingPlaneRunsInCellsAsInAllPairs) {
  Scene scene = gas(6, 0.0055, 0.3, {0, 0}, 11);
  scene.motion = SubstrateMotion::oscillation({0.002, 0}, 10, 0);
  expect_same(collisions_of(scene, 0.2), collisions_of(scene, 0.2, without_cells()), 40, 1e-9);
}

}  // namespace
}  // namespace slipcheck
