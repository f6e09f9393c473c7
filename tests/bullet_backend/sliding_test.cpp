// From sliding to rolling: K's t^s = 2 v0/(7 μ_k g), v = 5/7 v0 for a solid sphere that starts
// without spin.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bullet_run.h"

namespace slipcheck {
namespace {

TEST(BulletSliding, TheTimeIsTheExactOneRoundedUpToAStep) {
  constexpr double kMu = 0.4;
  const double exact = 2 * 1.0 / (7 * kMu * kGravity);  // 72.8 ms
  BodyState state;
  state.position = Vector3(0, 0, kRadius);
  state.velocity = Vector3(1, 0, 0);
  const Scene scene = scene_of(steel_ball(kRadius), {state}, ground_with_friction(kMu));
  for (const char* precision : {"double", "single"}) {
    RemoteEngine engine(bullet_executable(precision));
    for (const double rate : {60.0, 240.0, 1000.0}) {
      const auto frames = run(engine, scene, kDefault, rate, static_cast<std::size_t>(rate / 5));
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
  // The plane carries the sphere within a few parts in 1e4 of its weight at first.
  EXPECT_NEAR(braking_friction(0.3, kDefault) / 0.3, 1, 1e-3);
}

class BulletSlipTold : public ::testing::TestWithParam<const char*> {
 protected:
  Settings settings() const { return with(shipped("physical"), {{"body", GetParam()}}); }
  RemoteEngine engine_{bullet_executable("double")};
};

TEST_P(BulletSlipTold, OnASlopeStaticFrictionHoldsWhatRollsAndKineticBrakesWhatSlides) {
  // Rolling down needs (2/7) g sin θ, between μ_k g cos θ and μ_s g cos θ.
  const double theta = 0.5, time = 0.1, rate = 240;
  SubstrateContact ground = ground_with_friction(0.1);
  ground.static_friction = 0.3;
  Scene scene = scene_of(steel_ball(kRadius), {rolling_along_x(kRadius, 0, 0)}, ground);
  scene.gravity = kGravity * std::cos(theta);
  scene.downhill = {kGravity * std::sin(theta), 0};
  const auto end = [&] {
    return run(engine_, scene, settings(), rate, static_cast<std::size_t>(time * rate))
        .back()
        .bodies[0]
        .velocity.x();
  };
  EXPECT_NEAR(end(), 5.0 / 7 * kGravity * std::sin(theta) * time, 1e-9);
  scene.initial[0].velocity.x() = 0.5;  // without spin: K (18), and it never rolls
  EXPECT_NEAR(end(), 0.5 + kGravity * (std::sin(theta) - 0.1 * std::cos(theta)) * time, 1e-9);
}

TEST_P(BulletSlipTold, RollingFrictionBeginsWhereSlidingEndsUnlessTheSceneSaysOtherwise) {
  const double mu = 0.2, mu_r = 0.05, rate = 240, time = 0.1;  // of 0.146 s of sliding
  SubstrateContact ground = ground_with_friction(mu);
  ground.rolling = RollingFriction(mu_r);
  BodyState start = rolling_along_x(kRadius, 0, 1);
  start.angular_velocity.setZero();
  for (const bool while_sliding : {false, true}) {
    ground.rolling_while_sliding = while_sliding;
    const Scene scene = scene_of(steel_ball(kRadius), {start}, ground);
    const BodyState end =
        run(engine_, scene, settings(), rate, static_cast<std::size_t>(time * rate))
            .back()
            .bodies[0];
    EXPECT_NEAR(end.velocity.x(), 1 - mu * kGravity * time, 1e-9);
    // q R dω/dt = μ g − ρ g/R, where ρ = (1 + q) μ_r R acts.
    const double drive = (mu - (while_sliding ? 1.4 * mu_r : 0)) * kGravity;
    EXPECT_NEAR(kRadius * end.angular_velocity.y(), drive / 0.4 * time, 1e-9) << while_sliding;
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, BulletSlipTold, ::testing::Values("rigid", "multibody"),
                         [](const auto& param) { return std::string(param.param); });

}  // namespace
}  // namespace slipcheck
