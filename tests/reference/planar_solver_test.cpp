#include "reference/events/planar_solver.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "../support/deepest_overlap.h"
#include "../support/extremes.h"
#include "physics/contact/collision.h"
#include "planar_scenes.h"
#include "reference/events/indexed_heap.h"

namespace slipcheck {
namespace {

constexpr double kGravity = 9.81;
constexpr LeastSpeeds kLeast{.rebound = 1e-6, .landing = 1e-4};

PairContact contact(double e, double friction = 0, double beta0 = -1) {
  return {.restitution = e, .friction = friction, .tangential_restitution = beta0};
}

/// The planar rule is that of collide() in three dimensions, whose tests hold it against L.
TEST(PlanarCollision, IsTheSpatialOneInThePlane) {
  std::mt19937_64 random(3);
  const auto symmetric = [&] { return 2 * test::uniform(random) - 1; };
  for (int k = 0; k < 500; ++k) {
    const double e = test::uniform(random), mu = test::uniform(random), beta0 = symmetric();
    Scene scene = test::of_one_material(2, 1, contact(e, mu, beta0));
    scene.bodies[0] = {0.5 + test::uniform(random), 0.5 + test::uniform(random), 0.4};
    scene.bodies[1] = {0.5 + test::uniform(random), 0.5 + test::uniform(random), 0.5};
    Box box;
    box.width = 100;
    scene.box = box;
    scene.box->on_floor = scene.box->on_wall = scene.box->on_lid = scene.pairs;
    const double angle = 3.1 * symmetric();
    const double distance = (scene.bodies[0].radius + scene.bodies[1].radius) * (1 - 1e-15);
    const Vector3 n(std::cos(angle), 0, std::sin(angle));
    std::array<BodyState, 2> states;
    states[0].position = Vector3(50, 0, 50);
    states[1].position = states[0].position - distance * n;
    states[0].velocity = -n + Vector3(symmetric(), 0, symmetric()) * 0.5;
    states[1].velocity = Vector3(symmetric(), 0, symmetric()) * 0.3;
    states[0].angular_velocity = {0, symmetric(), 0};
    states[1].angular_velocity = {0, symmetric(), 0};
    scene.initial = {states[0], states[1]};
    PlanarWorld world(scene, scene.initial, {});
    world.collide(0, 1, 0);
    collide(scene.pairs[0], {}, {scene.bodies[0], scene.substrate[0], states[0], false},
            {scene.bodies[1], scene.substrate[0], states[1], false});
    for (std::size_t i = 0; i < 2; ++i) {
      const BodyState found = world.state_at(i, 0);
      // Rounding of numbers of order 1 in different order.
      EXPECT_LT((found.velocity - states[i].velocity).norm(), 1e-14) << k;
      EXPECT_LT((found.angular_velocity - states[i].angular_velocity).norm(), 1e-14) << k;
    }
    EXPECT_LT(world.momentum_error(), 1e-12);
  }
}

/// A ball in a still box without friction: it bounces on the floor with the period 2 v/g and
/// between the walls with 2 (width − 2R)/v_x, for ever.
TEST(PlanarSolver, ABallInAnElasticBoxGoesOnForEver) {
  Scene scene = test::shaken_box(1, 0, contact(1));
  const double R = scene.bodies[0].radius, vx = 0.3, v = 1.2;
  scene.initial[0].position = {R, 0, R};
  scene.initial[0].velocity = {vx, 0, v};
  PlanarSolver solver(scene, scene.initial);
  const double period = 2 * v / kGravity, crossing = (scene.box->width - 2 * R) / vx;
  const double time = 1000.25 * period;
  const SolvedRun run = solver.run(until_time(time), nullptr);
  const BodyState end = solver.states()[0];
  // 8000 walls at 0.3 m/s and 1000 bounces at 1.2 m/s, each twice its speed times the rounding of
  // times up to 244 s, 1.4e-14 s: 7e-11 and 3e-11 m at most.
  const double t = 0.25 * period;
  EXPECT_NEAR(end.position.z(), R + v * t - 0.5 * kGravity * t * t, 1e-10);
  const double crossings = time / crossing, part = crossings - std::floor(crossings);
  const bool returns = static_cast<long>(std::floor(crossings)) % 2 == 1;
  EXPECT_NEAR(end.position.x(), R + (returns ? 1 - part : part) * (scene.box->width - 2 * R),
              1e-10);
  EXPECT_LT(std::abs(run.balance->error()), 1e-12);
  EXPECT_LT(run.momentum_error, 1e-12);
  EXPECT_EQ(run.collisions, 0u);
}

TEST(EnergyBalance, HidesNoNaN) {
  EXPECT_EQ(EnergyBalance{}.error(), 0);
  EXPECT_DOUBLE_EQ((EnergyBalance{1.25, 1, 0.25, 0.25, 2}).error(), 0.125);
  const double nan = std::nan("");
  EXPECT_TRUE(std::isnan((EnergyBalance{nan, 1, 0, 0, nan}).error()));
  EXPECT_TRUE(std::isnan((EnergyBalance{1, 1, 0, 0, nan}).error()));
}

TEST(PlanarSolver, KnowsWhatStaysInAPlane) {
  const Scene gas = test::smooth_gas(9, 0.1, contact(0.9));
  const auto is_planar = [](const Scene& scene) {
    return PlanarWorld::is_planar(scene, scene.initial);
  };
  EXPECT_TRUE(is_planar(gas));
  EXPECT_TRUE(is_planar(test::shaken_box(5, 1, contact(0.9, 0.1, 0))));
  Scene rubbed = gas, rolling = gas, unlike = gas, tilted = gas, flying = gas;
  rubbed.substrate[0].kinetic_friction = 0.1;
  rolling.initial[3].angular_velocity.x() = 1;  // its collisions would lift
  unlike.bodies[2].radius *= 0.5;               // lines of centres would not be level
  tilted.downhill = {0, -1};
  flying.initial[1].position.z() *= 2;
  for (const Scene& scene : {rubbed, rolling, unlike, tilted, flying})
    EXPECT_FALSE(is_planar(scene));
}

/// On a floor that moves with v_f at the impact the rebound is −e (v − v_f) + v_f.
TEST(PlanarSolver, ReboundsFromAMovingFloorInItsFrame) {
  Scene scene = test::shaken_box(1, 1.5, contact(0.7));
  scene.initial[0].position = {5e-3, 0, 0.05};
  scene.initial[0].velocity = Vector3::Zero();
  struct Looker : FrameSink {
    std::vector<std::pair<double, BodyState>> seen;
    void take(double time, const Frame& frame) override {
      seen.emplace_back(time, frame.bodies[0]);
    }
  } looker;
  PlanarSolver solver(scene, scene.initial);
  const double step = 1e-5;
  solver.run(until_time(0.15, step), &looker);
  // Between two looks that enclose the first impact: both parabolas meet the floor's sine there.
  const ShakenFloor& floor = scene.box->floor;
  std::size_t k = 0;
  while (looker.seen[k + 1].second.velocity.z() < looker.seen[k].second.velocity.z()) ++k;
  const auto& [before_time, before] = looker.seen[k];
  const auto& [after_time, after] = looker.seen[k + 1];
  double low = before_time, high = after_time;
  for (int turn = 0; turn < 100; ++turn) {
    const double middle = 0.5 * (low + high), t = middle - before_time;
    const double bottom = before.position.z() + before.velocity.z() * t - 0.5 * kGravity * t * t -
                          scene.bodies[0].radius;
    (bottom > floor.height(middle) ? low : high) = middle;
  }
  const double vf = floor.velocity(low);
  const double v = before.velocity.z() - kGravity * (low - before_time);
  const double rebound = after.velocity.z() + kGravity * (after_time - low);
  // The bisection's end and the sine near its phase: 1e-15 of time, times the accelerations.
  EXPECT_NEAR(rebound, -0.7 * (v - vf) + vf, 1e-11);
}

/// A lid, still or shaken with the box, and rough side walls keep a fast body in.
TEST(PlanarSolver, ALidKeepsBodiesIn) {
  for (const bool moving : {false, true}) {
    Scene scene = test::shaken_box(8, 2, contact(0.95, 0.3, 0.2));
    scene.box->lid = 0.02;
    scene.box->moving_walls = moving;
    struct Looker : FrameSink {
      const Scene* scene;
      void take(double time, const Frame& frame) override {
        const Box& box = *scene->box;
        const double shift = box.floor.height(time);
        for (const BodyState& body : frame.bodies) {
          const double R = 0.5e-3, slack = 1e-12;
          EXPECT_GE(body.position.x(), R - slack);
          EXPECT_LE(body.position.x(), box.width - R + slack);
          EXPECT_GE(body.position.z(), shift + R - slack);
          EXPECT_LE(body.position.z(), *box.lid + (box.moving_walls ? shift : 0) - R + slack);
          EXPECT_EQ(body.position.y(), 0);
        }
      }
    } looker;
    looker.scene = &scene;
    PlanarSolver solver(scene, scene.initial);
    const SolvedRun run = solver.run(until_time(1, 1e-3), &looker);
    EXPECT_GT(run.contacts, 100u);
    EXPECT_LT(std::abs(run.balance->error()), 1e-12);
    EXPECT_LT(run.momentum_error, 1e-11);
  }
}

TEST(PlanarSolver, AGasKeepsMomentumAndEnergyAndNeverOverlaps) {
  const Scene scene = test::smooth_gas(200, 0.3, contact(1));
  PlanarSolver solver(scene, scene.initial);
  const SolvedRun run = solver.run(until_time(150), nullptr);
  EXPECT_GT(run.collisions, 10'000u);
  EXPECT_LT(std::abs(run.balance->error()), 1e-12);  // 100 collisions a body, 1e-16 each
  EXPECT_LT(run.momentum_error, 1e-13);
  EXPECT_LT(solver.world().momentum_error(), 1e-12);
  EXPECT_LT(test::deepest_overlap(scene, solver.states()), 1e-12);
}

TEST(PlanarSolver, BodiesThatBeginPeriodsAwayMoveAlike) {
  const Scene scene = test::smooth_gas(200, 0.3, contact(0.9));
  const double L = scene.periodic.x();
  const auto shift = [&](std::size_t i) {
    return Vector3(L * (static_cast<double>(i % 5) - 2), L * (static_cast<double>(i % 3) - 1), 0);
  };
  Scene away = scene;
  for (std::size_t i = 0; i < 200; ++i) away.initial[i].position += shift(i);
  PlanarSolver solver(scene, scene.initial), other(away, away.initial);
  const SolvedRun run = solver.run(until_time(5), nullptr);
  EXPECT_GT(run.collisions, 200u);
  EXPECT_EQ(other.run(until_time(5), nullptr).collisions, run.collisions);
  const std::vector<BodyState> states = solver.states(), from_away = other.states();
  // Roundings of 2 L at the start grow by some 2 λ/R, 10, at each of a body's few collisions.
  for (std::size_t i = 0; i < 200; ++i)
    EXPECT_LT((from_away[i].position - shift(i) - states[i].position).norm(), 1e-8 * L);
}

/// Over very many events too; SLIPCHECK_SOAK_EVENTS asks for more than is quick.
TEST(PlanarSolver, NothingOverlapsInManyEvents) {
  const char* asked = std::getenv("SLIPCHECK_SOAK_EVENTS");
  const auto events = static_cast<std::size_t>(asked ? std::atof(asked) : 2e5);
  const Scene gas = test::smooth_gas(300, 0.4, contact(1));
  const Scene box = test::shaken_box(50, 1, contact(0.9, 0.2, 0.3));
  for (const Scene& scene : {gas, box}) {
    PlanarWorld world(scene, scene.initial, kLeast);
    EventScheduler<PlanarWorld> scheduler(world, 0);
    const double first = world.energy_at(0);
    double deepest = -1;
    std::vector<BodyState> states(scene.bodies.size());
    for (std::size_t k = 0; k < events; ++k) {
      scheduler.step();
      if (k % 1000 != 0) continue;
      for (std::size_t i = 0; i < states.size(); ++i)
        states[i] = world.state_at(i, scheduler.now());
      deepest = test::largest_of(deepest, test::deepest_overlap(scene, states));
    }
    // Rounding of a time t moves a body by its speed times 1e-16 t: of its radius at most so much.
    const double speed = scene.box ? 10 : 5, radius = scene.bodies[0].radius;
    EXPECT_LT(deepest, 1e-13 + 4e-16 * scheduler.now() * speed / radius);
    EXPECT_LT(world.momentum_error(), 1e-12);
    const double balance =
        world.energy_at(scheduler.now()) - first - world.work() + world.dissipated();
    const double sum = first + std::abs(world.work()) + world.dissipated();
    // Rounding of each collision, at random.
    EXPECT_LT(std::abs(balance), (1e-13 + 4e-16 * std::sqrt(static_cast<double>(events))) * sum);
    std::printf("%zu events, %zu collisions: deepest overlap %.1e, energy balance %.1e\n", events,
                world.collisions(), deepest, balance / sum);
  }
}

/// What the collisions' laws say they dissipate is what is gone.
TEST(PlanarSolver, ARoughGasLosesWhatItsCollisionsDissipate) {
  const Scene scene = test::smooth_gas(200, 0.3, contact(0.9, 0.4, 0.5));
  PlanarSolver solver(scene, scene.initial);
  const SolvedRun run = solver.run(until_time(50), nullptr);
  EXPECT_GT(run.balance->dissipated, 0.5 * run.balance->energy);
  EXPECT_LT(std::abs(run.balance->error()), 1e-13);
  EXPECT_LT(solver.world().momentum_error(), 1e-12);
}

/// A dilute smooth gas of disks collides at the rate of Chapman and Enskog, per body
/// √(2π)... in two dimensions 2 n d √π √(T/m) χ with χ = (1 − 7φ/16)/(1 − φ)² (Henderson 1975).
TEST(PlanarSolver, AnElasticGasCollidesAtEnskogsRate) {
  const double fraction = 0.1, n = 400;
  const Scene scene = test::smooth_gas(400, fraction, contact(1));
  PlanarSolver solver(scene, scene.initial);
  solver.run(until_time(50), nullptr);  // to a Maxwellian
  const std::size_t before = solver.world().collisions();
  const SolvedRun run = solver.run(until_time(450), nullptr);
  // The centre of mass moves too: the temperature is of what is left.
  const Vector2 p = solver.world().momentum_at(run.end_time);
  const double T = (run.balance->energy - 0.5 * p.squaredNorm() / n) / n;
  const double density = fraction / (0.25 * std::numbers::pi);
  const double chi = (1 - 7 * fraction / 16) / ((1 - fraction) * (1 - fraction));
  const double rate = 2 * density * std::sqrt(std::numbers::pi * T) * chi;
  const double seen = 2 * static_cast<double>(run.collisions - before) / (n * 400);
  // 5e4 collisions scatter by 0.5 %; Henderson's χ is right to 0.1 % here.
  EXPECT_NEAR(seen / rate, 1, 0.02);
}

TEST(PlanarSolver, TheSameSceneGivesTheSameBits) {
  const Scene scene = test::shaken_box(50, 1, contact(0.9, 0.2, 0.3));
  std::vector<BodyState> first;
  for (int turn = 0; turn < 2; ++turn) {
    PlanarSolver solver(scene, scene.initial);
    solver.run(until_time(0.5), nullptr);
    const std::vector<BodyState> states = solver.states();
    if (turn == 0) first = states;
    for (std::size_t i = 0; i < states.size(); ++i) {
      EXPECT_EQ(std::memcmp(states[i].position.data(), first[i].position.data(), 24), 0);
      EXPECT_EQ(std::memcmp(states[i].velocity.data(), first[i].velocity.data(), 24), 0);
    }
  }
}

/// Few, and many: events of these are looked ahead to.
TEST(PlanarSolver, BothQueuesServeTheSameEvents) {
  for (const Scene& scene : {test::shaken_box(50, 1, contact(0.9, 0.2, 0.3)),
                             test::smooth_gas(kManyForCaches + 500, 0.3, contact(0.9))}) {
    PlanarWorld one(scene, scene.initial, kLeast), other(scene, scene.initial, kLeast);
    EventScheduler<PlanarWorld, CalendarQueue> calendar(one, 0);
    EventScheduler<PlanarWorld, HeapQueue> heap(other, 0);
    for (int k = 0; k < 50'000; ++k) {
      ASSERT_EQ(calendar.next_time(), heap.next_time()) << "event " << k;
      calendar.step();
      heap.step();
    }
  }
}

/// A loop that leaves out what the scene lacks gives the bits of the one that leaves out nothing.
TEST(PlanarSolver, LeavingOutWhatASceneLacksChangesNoBit) {
  struct Lack {
    Scene scene;
    double time;
    std::vector<std::string> left_out;
  };
  Scene unlike = test::shaken_box(40, 1, contact(0.9, 0.2, 0.3));
  unlike.bodies[7].radius *= 0.7;
  Scene clustered = test::smooth_gas(100, 0.4, contact(0.5));
  clustered.collapse = {CollapseRule::Model::largest_velocity, 1e-4};
  Scene spinning = test::smooth_gas(100, 0.3, contact(0.95));
  for (std::size_t i = 0; i < 100; ++i)
    spinning.initial[i].angular_velocity.z() = std::cos(static_cast<double>(i));
  const std::vector<std::string> smooth{"gravity and walls", "different radii",
                                        "friction and spin"};
  const std::vector<std::string> rough{"gravity and walls", "different radii"};
  const std::vector<Lack> cases{
      {test::smooth_gas(300, 0.2, contact(1)), 40, smooth},
      {spinning, 40, smooth},
      {clustered, 40, smooth},
      {test::smooth_gas(300, 0.3, contact(0.95, 0.1, 0.4)), 40, rough},
      {test::shaken_box(50, 1, contact(0.9, 0.2, 0.3)), 0.5, {"different radii"}},
      {unlike, 0.5, {}}};
  for (const Lack& c : cases) {
    PlanarSettings settings;
    settings.general = true;
    PlanarSolver general(c.scene, c.scene.initial, settings), chosen(c.scene, c.scene.initial);
    EXPECT_TRUE(general.left_out().empty());
    EXPECT_EQ(chosen.left_out(), c.left_out);
    const SolvedRun all = general.run(until_time(c.time), nullptr);
    const SolvedRun less = chosen.run(until_time(c.time), nullptr);
    EXPECT_GT(all.collisions, c.scene.bodies.size());
    EXPECT_EQ(all.collisions, less.collisions);
    EXPECT_EQ(all.collapses, less.collapses);
    EXPECT_EQ(all.events, less.events);
    EXPECT_EQ(all.balance->energy, less.balance->energy);
    EXPECT_EQ(all.balance->dissipated, less.balance->dissipated);
    const std::vector<BodyState> states = general.states(), other = chosen.states();
    for (std::size_t i = 0; i < states.size(); ++i) {
      EXPECT_EQ(std::memcmp(states[i].position.data(), other[i].position.data(), 24), 0);
      EXPECT_EQ(std::memcmp(states[i].velocity.data(), other[i].velocity.data(), 24), 0);
      EXPECT_EQ(
          std::memcmp(states[i].angular_velocity.data(), other[i].angular_velocity.data(), 24), 0);
    }
  }
}

TEST(PlanarSolver, WhatIsShownDoesNotChangeTheRun) {
  const Scene scene = test::shaken_box(20, 1, contact(0.9, 0.2, 0.3));
  struct : FrameSink {
    std::size_t frames = 0;
    void take(double, const Frame&) override { ++frames; }
  } sink;
  PlanarSolver seen(scene, scene.initial), alone(scene, scene.initial);
  seen.run(until_time(0.2, 1e-3), &sink);
  alone.run(until_time(0.2), nullptr);
  EXPECT_EQ(sink.frames, 201u);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    EXPECT_EQ(seen.states()[i].position, alone.states()[i].position);
}

/// Balls of different sizes find each other whatever the cell: none overlap in a dense box.
TEST(PlanarSolver, PolydisperseBodiesNeverOverlap) {
  Scene scene = test::shaken_box(60, 0.8, contact(0.9, 0.2, 0.3));
  std::mt19937_64 random(5);
  for (Sphere& sphere : scene.bodies) sphere.radius *= 0.4 + 0.6 * test::uniform(random);
  PlanarSolver solver(scene, scene.initial);
  for (int k = 1; k <= 50; ++k) {
    const SolvedRun run = solver.run(until_time(0.02 * k), nullptr);
    ASSERT_LT(test::deepest_overlap(scene, solver.states()), 1e-11) << run.end_time;
  }
}

/// Four balls in a row on a wall with e below the limit of Bernu and Mazighi collapse: infinitely
/// many collisions in finite time. Each rule ends it, and a hard limit says so where none does.
Scene collapsing_row(const CollapseRule& rule) {
  // e = 0.05 for 4 balls and a wall is far below tan²((π/4)(1 − 1/N)).
  Scene scene = test::shaken_box(4, 0, contact(0.05));
  scene.gravity = 0;
  scene.collapse = rule;
  for (std::size_t i = 0; i < 4; ++i) {
    scene.initial[i].position = {5e-3, 0, (1 + 1.5 * static_cast<double>(i)) * 1e-3};
    scene.initial[i].velocity = {0, 0, -0.1 * static_cast<double>(i + 1)};
  }
  return scene;
}

TEST(InelasticCollapse, EveryRuleEndsIt) {
  using Model = CollapseRule::Model;
  for (const CollapseRule& rule :
       {CollapseRule{Model::slowest_rebound, 0}, CollapseRule{Model::contact_time, 1e-5},
        CollapseRule{Model::largest_velocity, 1e-5}}) {
    const Scene scene = collapsing_row(rule);
    PlanarSolver solver(scene, scene.initial);
    const SolvedRun run = solver.run(until_time(0.1), nullptr);
    EXPECT_TRUE(run.reached) << run.reason;
    EXPECT_GT(run.collapses, 0u);
    EXPECT_LT(run.events, 1'000'000u);
    EXPECT_LT(std::abs(run.balance->error()), 1e-12);
    EXPECT_LT(test::deepest_overlap(scene, solver.states()), 1e-11);
  }
}

TEST(InelasticCollapse, TheLimitOnEventsEndsWhatNoRuleDoes) {
  const Scene scene = collapsing_row({});
  PlanarSettings settings;
  settings.collapse_fraction = settings.landing_fraction = 1e-300;
  settings.most_events = 1e6;
  PlanarSolver solver(scene, scene.initial, settings);
  const SolvedRun run = solver.run(until_time(10), nullptr);
  if (run.reached) GTEST_FAIL() << "no collapse in " << run.events << " events";
  EXPECT_NE(run.reason.find("more than 1e+06 events for each body and second"), std::string::npos)
      << run.reason;
}

/// A ball on the still floor of a box: impacts 2 e v/g apart are elastic once t_c is longer.
TEST(InelasticCollapse, TheContactTimeIsTheTimeBelowWhichAnImpactIsElastic) {
  const double e = 0.5, height = 0.01, g = 9.81;
  const double speed = std::sqrt(2 * g * height), first = speed / g, between = 2 * e * speed / g;
  for (const double share : {0.6, 0.99, 1.01}) {
    Scene scene = test::shaken_box(1, 0, contact(e));
    scene.initial[0].position = {5e-3, 0, 0.5e-3 + height};
    scene.initial[0].velocity = Vector3::Zero();
    scene.collapse = {CollapseRule::Model::contact_time, between * share};
    PlanarSolver solver(scene, scene.initial);
    solver.run(until_time(first + 1.001 * between), nullptr);
    // Just after the second impact: e² v of what hit the floor first, or e v.
    const double left = (share < 1 ? e * e : e) * speed - g * 0.001 * between;
    EXPECT_NEAR(solver.states()[0].velocity.z(), left, 1e-12) << share;
  }
}

/// The TC model only acts on bodies that collide twice within t_c: a dilute gas does not see it.
TEST(InelasticCollapse, TheContactTimeDoesNotChangeADiluteGas) {
  Scene scene = test::smooth_gas(30, 0.05, contact(0.9));
  PlanarSolver without(scene, scene.initial);
  without.run(until_time(5), nullptr);
  Scene with_rule = scene;
  with_rule.collapse = {CollapseRule::Model::contact_time, 1e-9};
  PlanarSolver with(with_rule, with_rule.initial);
  with.run(until_time(5), nullptr);
  EXPECT_EQ(with.world().collisions(), without.world().collisions());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    EXPECT_EQ(with.states()[i].position, without.states()[i].position);
}

}  // namespace
}  // namespace slipcheck
