// Rolling and drilling friction through the exact maps of the default profile, and what Bullet
// makes of them by itself.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../support/extremes.h"
#include "bullet_run.h"

namespace slipcheck {
namespace {

/// Deceleration over a second, in μ_r g.
double deceleration_ratio(RemoteEngine& engine, const Scene& scene, double mu_r, double rate) {
  const auto frames = run(engine, scene, kDefault, rate, static_cast<std::size_t>(rate));
  const double before = scene.initial[0].velocity.norm();
  const double after = frames.back().bodies[0].velocity.norm();
  return (before - after) / (mu_r * scene.gravity);
}

struct Case {
  const char* precision;
  double tolerance;  // rounding of a second's steps: single adds them up at 6e-8 of v each
};

class BulletRolling : public ::testing::TestWithParam<Case> {
 protected:
  RemoteEngine engine_{bullet_executable(GetParam().precision)};
};

TEST_P(BulletRolling, DeceleratesWithMuRG) {
  SubstrateContact ground = ground_with_friction(0.1);
  ground.rolling = RollingFriction(0.01);
  for (const double radius : {0.002, 0.05}) {
    for (const double rate : {240.0, 1000.0}) {
      const Scene scene = scene_of(steel_ball(radius), {rolling_towards(radius, 1, 0)}, ground);
      EXPECT_NEAR(deceleration_ratio(engine_, scene, 0.01, rate), 1, GetParam().tolerance)
          << radius << " m, " << rate << " Hz";
    }
  }
}

TEST_P(BulletRolling, DeceleratesWithMuRGThoughTheImpulseIsCut) {
  // R = 0.5 cm in CGS numbers: m g dt = 67 at 60 Hz, of which Bullet counts 1.
  SubstrateContact ground = ground_with_friction(0.1);
  ground.rolling = RollingFriction(0.01);
  const Sphere ball = {0.5, 7.85 * 4 / 3 * std::numbers::pi * 0.125, 0.4};
  Scene scene = scene_of(ball, {rolling_towards(0.5, 30, 0)}, ground);
  scene.gravity = 981;
  for (const double rate : {60.0, 240.0, 1000.0, 10000.0}) {
    EXPECT_NEAR(deceleration_ratio(engine_, scene, 0.01, rate), 1, GetParam().tolerance) << rate;
  }
}

TEST_P(BulletRolling, SpinsDownByItsDrillingLength) {
  for (const double radius : {0.002, 0.05}) {
    SubstrateContact ground = ground_with_friction(0.1);
    ground.drilling_length = 0.01 * radius;
    BodyState state;
    state.position = Vector3(0, 0, radius);
    state.angular_velocity = Vector3(0, 0, 100);
    const Sphere ball = steel_ball(radius);
    const auto frames = run(engine_, scene_of(ball, {state}, ground), kDefault, 1000, 200);
    // I dω/dt = −L m g.
    const double rate = ground.drilling_length * ball.mass * kGravity / ball.moment_of_inertia();
    const double lost = 100 - frames.back().bodies[0].angular_velocity.z();
    EXPECT_NEAR(lost / (0.2 * rate), 1, GetParam().tolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(Precisions, BulletRolling,
                         ::testing::Values(Case{"double", 1e-6}, Case{"single", 2e-3}),
                         [](const auto& param) { return param.param.precision; });

TEST(BulletRollingFacts, ATableOverTheSpeedIsFollowed) {
  SubstrateContact ground = ground_with_friction(0.1);
  ground.rolling = RollingFriction({{0, 0.01}, {1, 0.02}});
  RemoteEngine engine(bullet_executable("double"));
  const Scene scene = scene_of(steel_ball(0.01), {rolling_along_x(0.01, 0, 0.8)}, ground);
  const auto frames = run(engine, scene, kDefault, 1000, 2000);
  // dv/dt = −g (a + b v) with a = 0.01, b = 0.01 s/m: v + a/b decays with b g.
  const double exact = (0.8 + 1) * std::exp(-0.01 * kGravity * 2.0) - 1;
  // Each of the points that a sphere keeps has the coefficient of the time it was made, up to 0.2
  // rad of rolling ago: 2 ms at 0.8 m/s, so that μ_r is late by 2 ms b dv/dt, 2e-5 of itself.
  EXPECT_NEAR(frames.back().bodies[0].velocity.x(), exact, 1e-3);
}

// A point of contact is renewed in place only while the sphere turns by less than the margin,
// √3·0.02 rad, in a step; faster, the old point stays as a second one, an angle θ = v dt/R behind.
// There it rises at v θ and is θ² R/2 off the plane already, so the row that keeps it from closing
// more than its gap, v_n >= −gap/dt, is idle while v θ + v θ/2 > g dt: v² > (2/3) g R. Between the
// two speeds it carries weight, behind the centre, and rolling without friction becomes uneven:
// a cycle of two steps. A sphere at 2 cm/s even doubles its speed.
TEST(BulletRollingFacts, BetweenTwoSpeedsRollingIsUnsteady) {
  RemoteEngine engine(bullet_executable("double"));
  const double rate = 240;
  for (const double radius : {0.002, 0.05}) {
    const double low = std::sqrt(3) * 0.02 * radius * rate;
    const double high = std::sqrt(2.0 / 3 * kGravity * radius);
    const auto largest_slip = [&](double v) {
      const Scene scene =
          scene_of(steel_ball(radius), {rolling_along_x(radius, 0, v)}, ground_with_friction(0.1));
      double largest = 0;
      for (const Frame& frame : run(engine, scene, kDefault, rate, 240)) {
        largest = test::largest_of(largest, slip_velocity(frame.bodies[0], radius).norm());
      }
      return largest;
    };
    // Steady rolling slips by rounding only, 1e-15; uneven rolling by 1e-4 m/s and more.
    EXPECT_LT(largest_slip(0.99 * low), 1e-12);
    EXPECT_GT(largest_slip(1.01 * low), 1e-5);
    EXPECT_GT(largest_slip(0.98 * high), 1e-5);
    EXPECT_LT(largest_slip(1.02 * high), 1e-12);
  }
}

TEST(BulletRollingFacts, DiagonalHeadingsAreBrakedTooMuch) {
  // Two axes with a limit each: the torque is √2 times as large along a diagonal.
  SubstrateContact ground = ground_with_friction(0.1);
  ground.rolling = RollingFriction(0.01);
  RemoteEngine engine(bullet_executable("double"));
  const Scene scene = scene_of(steel_ball(0.05), {rolling_towards(0.05, 1, 45)}, ground);
  // The last of the 1000 steps may be one in which an axis lags by its own limit.
  EXPECT_NEAR(deceleration_ratio(engine, scene, 0.01, 1000), std::numbers::sqrt2, 2e-3);
}

}  // namespace
}  // namespace slipcheck
