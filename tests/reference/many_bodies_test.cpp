#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../scenes.h"
#include "../support/extremes.h"
#include "reference/events/event_solver.h"

namespace slipcheck {
namespace {

/// Balls on a jittered grid with random velocities, converging on the middle.
Scene cloud(std::size_t side, double friction, double restitution, unsigned seed) {
  Scene scene = test::steel_scene(side * side);
  scene.pairs[0].restitution = restitution;
  scene.substrate[0].kinetic_friction = friction;
  std::mt19937_64 random(seed);
  const auto u = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const double x = 0.006 * (static_cast<double>(i % side) - 0.5 * static_cast<double>(side));
    const double y = 0.006 * (static_cast<double>(i / side) - 0.5 * static_cast<double>(side));
    scene.initial[i] =
        test::rolling_at(x + 5e-4 * u(), y + 5e-4 * u(), -5 * x + 0.1 * u(), -5 * y + 0.1 * u());
  }
  return scene;
}

/// Watches for overlaps in every frame.
struct OverlapWatch final : FrameSink {
  explicit OverlapWatch(const Scene& scene) : scene_(scene) {}
  void take(double, const Frame& frame) override {
    for (std::size_t i = 0; i < frame.bodies.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double contact = scene_.bodies[i].radius + scene_.bodies[j].radius;
        const double distance = (frame.bodies[i].position - frame.bodies[j].position).norm();
        deepest = test::largest_of(deepest, 1 - distance / contact);
      }
  }
  const Scene& scene_;
  double deepest = 0;
};

Vector3 momentum(const Scene& scene, const std::vector<BodyState>& states) {
  Vector3 p = Vector3::Zero();
  for (std::size_t i = 0; i < states.size(); ++i) p += scene.bodies[i].mass * states[i].velocity;
  return p;
}

double kinetic_energy(const Scene& scene, const std::vector<BodyState>& states) {
  double e = 0;
  for (std::size_t i = 0; i < states.size(); ++i)
    e += 0.5 * scene.bodies[i].mass * states[i].velocity.squaredNorm();
  return e;
}

TEST(ManyBodies, FrictionlessElasticGasConservesMomentumAndEnergyWithoutOverlap) {
  const Scene scene = cloud(6, 0, 1, 1);
  EventSolver solver(scene, scene.initial);
  OverlapWatch watch(scene);
  const SolvedRun run = solver.run(until_time(0.5), &watch);
  ASSERT_GT(run.collisions, 50u);
  const double p_scale =
      std::sqrt(2 * kinetic_energy(scene, scene.initial) * scene.bodies[0].mass * 36);
  const double per_collision = 1e-15 * static_cast<double>(run.collisions);
  EXPECT_LE((momentum(scene, solver.states()) - momentum(scene, scene.initial)).norm(),
            per_collision * p_scale);
  EXPECT_NEAR(kinetic_energy(scene, solver.states()) / kinetic_energy(scene, scene.initial), 1,
              10 * per_collision);
  EXPECT_LE(watch.deepest, 1e-12);
}

TEST(ManyBodies, SlidingGasComesToRollingWithoutOverlap) {
  const Scene scene = cloud(5, 0.1, 0.9, 2);
  EventSolver solver(scene, scene.initial);
  OverlapWatch watch(scene);
  const SolvedRun run = solver.run({Run::Until::rolling, 0, 60}, &watch);
  ASSERT_TRUE(run.reached) << run.reason;
  EXPECT_GT(run.collisions, 20u);
  EXPECT_LE(watch.deepest, 1e-12);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    EXPECT_LE(slip_velocity(solver.states()[i], 0.002).norm(), 1e-14);
}

TEST(ManyBodies, TimeReversedFrictionlessElasticGasRetracesItsPath) {
  const Scene scene = cloud(4, 0, 1, 3);
  const RunEnd end = until_time(0.05);
  EventSolver there(scene, scene.initial);
  ASSERT_GT(there.run(end, nullptr).collisions, 3u);
  std::vector<BodyState> turned = there.states();
  for (BodyState& state : turned) {
    state.velocity *= -1;
    state.angular_velocity *= -1;
  }
  EventSolver back(scene, turned);
  back.run(end, nullptr);
  // Hard discs amplify rounding by some tens at each collision.
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    EXPECT_LE((back.states()[i].position - scene.initial[i].position).norm(), 1e-9);
}

TEST(ManyBodies, RowOfTouchingBallsPassesTheBlowOn) {
  // Equal elastic balls: the velocity goes to the last, all others stop.
  Scene scene = test::steel_scene(4);
  scene.pairs[0].restitution = 1.0;
  scene.substrate[0].kinetic_friction = 0;
  scene.initial[0] = test::rolling_at(-0.01, 0, 0.1, 0);
  for (std::size_t i : {1u, 2u, 3u})
    scene.initial[i] = test::rolling_at(0.004 * static_cast<double>(i - 1), 0, 0, 0);
  EventSolver solver(scene, scene.initial);
  const SolvedRun run = solver.run(until_time(0.1), nullptr);
  EXPECT_EQ(run.collisions, 3u);
  EXPECT_NEAR(solver.states()[3].velocity.x(), 0.1, 1e-15);
  for (std::size_t i : {0u, 1u, 2u}) EXPECT_NEAR(solver.states()[i].velocity.x(), 0, 1e-15);
}

TEST(ManyBodies, SameSceneGivesTheSameBits) {
  const Scene scene = cloud(5, 0.1, 0.9, 4);
  EventSolver a(scene, scene.initial), b(scene, scene.initial);
  const RunEnd end{Run::Until::rolling, 0, 60};
  EXPECT_EQ(a.run(end, nullptr).events, b.run(end, nullptr).events);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    EXPECT_EQ(a.states()[i].position, b.states()[i].position);
}

}  // namespace
}  // namespace slipcheck
