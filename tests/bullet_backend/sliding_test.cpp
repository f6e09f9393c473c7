// From sliding to rolling: K's t^s = 2 v0/(7 μ_k g), v = 5/7 v0 for a solid sphere that starts
// without spin.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bullet_run.h"

namespace slipcheck {
namespace {

TEST(BulletSliding, TheTimeIsTheExactOneRoundedUpToAStep) {
  constexpr double kRadius = 0.002, kMu = 0.4;
  const double exact = 2 * 1.0 / (7 * kMu * kGravity);  // 72.8 ms
  BodyState state;
  state.position = Vector3(0, 0, kRadius);
  state.velocity = Vector3(1, 0, 0);
  const HardScene scene = scene_of(steel_ball(kRadius), {state}, ground_with_friction(kMu));
  for (const char* precision : {"double", "single"}) {
    RemoteEngine engine(bullet_executable(precision));
    for (const double rate : {60.0, 240.0, 1000.0}) {
      const auto frames = run(engine, scene, "default", rate, static_cast<std::size_t>(rate / 5));
      const auto rolls = std::find_if(frames.begin(), frames.end(), [](const Frame& frame) {
        return slip_velocity(frame.bodies[0], kRadius).norm() < 1e-6;
      });
      ASSERT_NE(rolls, frames.end());
      const auto steps = rolls - frames.begin() + 1;
      EXPECT_EQ(steps, static_cast<std::ptrdiff_t>(std::ceil(exact * rate))) << rate << " Hz";
      // What is left of the slip, and single precision, set the tolerance.
      EXPECT_NEAR(rolls->bodies[0].velocity.x(), 5.0 / 7, 2e-6);
    }
  }
}

TEST(BulletSliding, ItIsBrakedByTheFrictionOfTheScene) {
  BodyState state;
  state.position = Vector3(0, 0, 0.01);
  state.velocity = Vector3(2, 0, 0);
  const HardScene scene = scene_of(steel_ball(0.01), {state}, ground_with_friction(0.3));
  RemoteEngine engine(bullet_executable("double"));
  const auto frames = run(engine, scene, "default", 1000, 20);
  // dv/dt = −μ g; the plane carries the sphere within a few parts in 1e4 of its weight at first.
  EXPECT_NEAR((2 - frames.back().bodies[0].velocity.x()) / (0.3 * kGravity * 0.02), 1, 1e-3);
}

}  // namespace
}  // namespace slipcheck
