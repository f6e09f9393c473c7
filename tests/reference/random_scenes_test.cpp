#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../scenes.h"
#include "../support/extremes.h"
#include "reference/events/event_solver.h"

namespace slipcheck {
namespace {

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  bool chance(double p) { return (*this)(0, 1) < p; }

 private:
  std::mt19937_64 generator_;
};

/// Anything the solver takes: unlike spheres, rubbing, rolling friction over the speed, drilling,
/// drops and bounces.
Scene random_scene(unsigned seed) {
  Random random(seed);
  Scene scene;
  scene.gravity = random.chance(0.1) ? 0 : random(1, 30);
  scene.confined = random.chance(0.2);
  const std::size_t materials = random.chance(0.5) ? 1 : 2;
  for (std::size_t m = 0; m < materials; ++m) {
    SubstrateContact c;
    c.kinetic_friction = random.chance(0.1) ? 0 : random(0.01, 1);
    c.static_friction = c.kinetic_friction + random(0, 0.5);
    if (random.chance(0.5)) c.rolling = RollingFriction(random(0, c.static_friction));
    if (random.chance(0.3))
      c.rolling = RollingFriction({{0.05, random(0, c.static_friction)},
                                   {0.2, random(0, c.static_friction)},
                                   {0.5, random(0, c.static_friction)}});
    if (random.chance(0.5)) c.drilling_length = random(0, 1e-3);
    if (random.chance(0.5)) c.restitution = random(0, 0.95);
    scene.substrate.push_back(c);
  }
  scene.pairs.resize(materials * materials);
  for (std::size_t a = 0; a < materials; ++a)
    for (std::size_t b = 0; b <= a; ++b) {
      PairContact pair{random(0, 1), random.chance(0.4) ? 0 : random(0, 1), random(-1, 1)};
      scene.pairs[a * materials + b] = scene.pairs[b * materials + a] = pair;
    }
  const double size = random(0.002, 0.05);
  const auto count = static_cast<std::size_t>(random(1, 9));
  for (std::size_t i = 0; i < count; ++i) {
    const double radius = size * random(0.6, 1);
    scene.bodies.push_back({radius, random(0.5, 2), random(0.3, 1)});
    scene.material.push_back(static_cast<std::size_t>(random(0, static_cast<double>(materials))));
    BodyState s;
    s.position = {2.5 * size * static_cast<double>(i % 3), 2.5 * size * static_cast<double>(i / 3),
                  radius};
    if (!scene.confined && random.chance(0.3)) s.position.z() += random(0, 0.1);
    if (random.chance(0.8)) s.velocity = {random(-1, 1), random(-1, 1), 0};
    if (random.chance(0.5)) s.angular_velocity = rolling_angular_velocity(s.velocity, radius);
    if (random.chance(0.3))
      s.angular_velocity += Vector3(random(-9, 9), random(-9, 9), random(-9, 9));
    scene.initial.push_back(s);
  }
  return scene;
}

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
    const Scene scene = random_scene(seed);
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
