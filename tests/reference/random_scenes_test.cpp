#include <gtest/gtest.h>

#include <cmath>

#include "../support/extremes.h"
#include "random_scene.h"
#include "reference/events/event_solver.h"

namespace slipcheck {
namespace {

/// No energy out of nothing, no overlap, nobody below the plane, no state that is not finite.
struct Watch final : FrameSink {
  explicit Watch(const Scene& watched) : scene(watched) {}

  double energy(const Frame& frame) const {
    double sum = 0;
    for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
      const BodyState& s = frame.bodies[i];
      const Sphere& b = scene.bodies[i];
      sum += 0.5 * b.mass * s.velocity.squaredNorm() +
             0.5 * b.moment_of_inertia() * s.angular_velocity.squaredNorm() +
             b.mass * scene.gravity * (s.position.z() - b.radius);
    }
    return sum;
  }

  void take(double time, const Frame& frame) override {
    EXPECT_GE(time, last_time);
    last_time = time;
    const double now = energy(frame);
    ASSERT_TRUE(std::isfinite(now));
    if (before >= 0) largest_gain = test::largest_of(largest_gain, (now - before) / scale);
    if (before < 0) scale = now + 1e-30;
    before = now;
    for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
      const double radius = scene.bodies[i].radius;
      deepest = test::largest_of(deepest, 1 - frame.bodies[i].position.z() / radius);
      for (std::size_t j = 0; j < i; ++j) {
        const double contact = radius + scene.bodies[j].radius;
        deepest = test::largest_of(
            deepest, 1 - (frame.bodies[i].position - frame.bodies[j].position).norm() / contact);
      }
    }
  }

  const Scene& scene;
  double last_time = 0, before = -1, scale = 1, largest_gain = 0, deepest = 0;
};

TEST(RandomScenes, GainNoEnergyAndNeverOverlap) {
  std::size_t collisions = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    const Scene scene = test::random_scene(seed);
    EventSettings settings;
    settings.most_events = 1000;
    settings.burst = 5000;
    EventSolver solver(scene, scene.initial, settings);
    Watch watch(scene);
    const SolvedRun run = solver.run(until_time(2), &watch);
    collisions += run.collisions;
    // The rebound that keeps a collapse finite may give back 1e-12 of the scene's energy.
    EXPECT_LE(watch.largest_gain, 1e-11) << "seed " << seed;
    // Rounding of positions over some thousand events.
    EXPECT_LE(watch.deepest, 1e-9) << "seed " << seed;
  }
  EXPECT_GT(collisions, 1000u);
}

}  // namespace
}  // namespace slipcheck
