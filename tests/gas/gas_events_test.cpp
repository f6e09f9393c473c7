#include <gtest/gtest.h>

#include "../reference/planar_scenes.h"
#include "gases.h"
#include "reference/events/planar_solver.h"

namespace slipcheck {
namespace {

/// Means and standard errors of some runs.
struct OfRuns {
  Measured log_translation, log_rotation, collisions;
};

Measured mean_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, sum = 0;
  for (const double value : values) mean += value / n;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return {mean, std::sqrt(sum / (n * (n - 1)))};
}

/// Maxwellian velocities of mean square 1 without momentum.
void set_velocities(Scene& scene, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Vector3 mean = Vector3::Zero();
  const auto n = static_cast<double>(scene.initial.size());
  for (BodyState& state : scene.initial) {
    const double size = std::sqrt(-2 * std::log(1 - test::uniform(random)));
    const double angle = 2 * M_PI * test::uniform(random);
    state.velocity = {size * std::cos(angle), size * std::sin(angle), 0};
    mean += state.velocity / n;
  }
  double sum = 0;
  for (BodyState& state : scene.initial) {
    state.velocity -= mean;
    sum += state.velocity.squaredNorm() / n;
  }
  for (BodyState& state : scene.initial) state.velocity /= std::sqrt(sum);
}

constexpr double kFilled = 0.005;

/// Hard disks from event to event.
OfRuns event_driven(const PairContact& contact, double time, std::size_t runs) {
  constexpr std::size_t kDisks = 2500;
  std::vector<double> translation, rotation, collisions;
  for (std::size_t run = 0; run < runs; ++run) {
    Scene scene = test::smooth_gas(kDisks, kFilled, contact, run + 1);
    set_velocities(scene, 100 + run);
    PlanarSolver solver(scene, scene.initial);
    const SolvedRun done = solver.run(until_time(time), nullptr);
    EXPECT_TRUE(done.reached) << done.reason;
    double v2 = 0, spin = 0;
    for (const BodyState& state : solver.states()) {
      v2 += state.velocity.squaredNorm() / kDisks;
      spin += 0.4 * 0.25 * state.angular_velocity.squaredNorm() / kDisks;
    }
    translation.push_back(std::log(0.5 * v2));
    rotation.push_back(std::log(spin));
    collisions.push_back(2 * static_cast<double>(done.collisions) / kDisks);
  }
  return {mean_of(translation), mean_of(rotation), mean_of(collisions)};
}

/// The same by DSMC, of as many particles as all these runs together and more.
void expect_as_event_driven(const PairContact& contact, double collisions) {
  GasSetup setup;
  setup.sphere = {0.5, 1, 0.4};
  setup.dimensions = 2;
  setup.filled = kFilled;
  setup.particles = 200'000;
  const GasLaw law = hard_gas(contact, setup.sphere);
  Gas gas(setup, law);
  while (gas.collisions_per_particle() < collisions) gas.advance();
  const GasTemperatures both = test::temperatures(gas);
  const OfRuns seen = event_driven(contact, gas.now(), 12);
  // DSMC has ten times as many collisions, whose errors do not count. Disks of finite number are
  // without 1/N of their pairs.
  const double finite = 2.0 / 2500;
  EXPECT_NEAR(std::log(both.translation), seen.log_translation.value,
              4 * seen.log_translation.error + finite);
  EXPECT_LT(seen.log_translation.error, 0.02);
  EXPECT_NEAR(gas.collisions_per_particle(), seen.collisions.value,
              4 * seen.collisions.error + collisions * finite);
  if (law.rough()) {
    EXPECT_NEAR(std::log(both.rotation), seen.log_rotation.value,
                4 * seen.log_rotation.error + finite);
    EXPECT_LT(seen.log_rotation.error, 0.03);
  }
}

TEST(GasEvents, SmoothDisksCoolAsFromEventToEvent) {
  expect_as_event_driven({.restitution = 0.9}, 20);
}

TEST(GasEvents, RoughDisksCoolAndSpinAsFromEventToEvent) {
  expect_as_event_driven({.restitution = 0.9, .friction = 0.3, .tangential_restitution = 0.4}, 12);
}

TEST(GasEvents, DisksOfBridgesLawCoolAsFromEventToEvent) {
  PairContact contact;
  contact.restitution = PowerLawRestitution{0.8, 0.1, 1};
  expect_as_event_driven(contact, 12);
}

}  // namespace
}  // namespace slipcheck
