// A plane that is tilted, which Bullet is told by the direction of gravity.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bullet_run.h"

namespace slipcheck {
namespace {

constexpr double kTiltRadius = 0.05;

/// One ball at rest on a plane tilted by θ [degrees], downhill along −y.
Scene tilted(double degrees, double mu, double mu_r) {
  const double theta = degrees * std::numbers::pi / 180;
  SubstrateContact ground = ground_with_friction(mu);
  ground.rolling = RollingFriction(mu_r);
  Scene scene = scene_of(steel_ball(kTiltRadius), {rolling_along_x(kTiltRadius, 0, 0)}, ground);
  scene.gravity = kGravity * std::cos(theta);
  scene.downhill = {0, -kGravity * std::sin(theta)};
  return scene;
}

struct Case {
  const char* precision;
  double tolerance;  // relative, of the speed after 300 steps: rounding of each, 6e-8 in single
};

class BulletTilt : public ::testing::TestWithParam<Case> {
 protected:
  /// Downhill velocity after 0.3 s at 1 kHz.
  double speed(const Scene& scene) {
    const auto frames = run(engine_, scene, kDefault, 1000, 300);
    EXPECT_NEAR(frames.back().bodies[0].velocity.x(), 0, 1e-6);
    EXPECT_NEAR(frames.back().bodies[0].position.z(), kTiltRadius, 1e-3 * kTiltRadius);
    return -frames.back().bodies[0].velocity.y();
  }
  RemoteEngine engine_{bullet_executable(GetParam().precision)};
};

TEST_P(BulletTilt, K24ASolidSphereRollsDownWithFiveSeventhsOfGSinTheta) {
  for (const double degrees : {1.0, 5.0, 15.0}) {
    const Scene scene = tilted(degrees, 0.5, 0);
    const double exact = 5.0 / 7 * -scene.downhill.y() * 0.3;
    EXPECT_NEAR(speed(scene) / exact, 1, GetParam().tolerance) << degrees;
    const auto frames = run(engine_, scene, kDefault, 1000, 300);
    const double slip = slip_velocity(frames.back().bodies[0], kTiltRadius).norm();
    EXPECT_LT(slip, GetParam().tolerance) << degrees;  // of 1 m/s
  }
}

TEST_P(BulletTilt, K18ASteepSlopeMakesItSlide) {
  // μ < (2/7) tan θ: v̇ = g (sin θ − μ cos θ).
  const Scene scene = tilted(30, 0.1, 0);
  const double exact = (-scene.downhill.y() - 0.1 * scene.gravity) * 0.3;
  EXPECT_NEAR(speed(scene) / exact, 1, GetParam().tolerance);
}

TEST_P(BulletTilt, K16RollingFrictionBrakesAndHoldsIt) {
  const Scene scene = tilted(5, 0.5, 0.02);
  const double exact = (5.0 / 7 * -scene.downhill.y() - 0.02 * scene.gravity) * 0.3;
  EXPECT_NEAR(speed(scene) / exact, 1, GetParam().tolerance);
  // (5/7) sin θ < μ_r cos θ.
  EXPECT_LT(std::abs(speed(tilted(1, 0.5, 0.02))), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Precisions, BulletTilt,
                         ::testing::Values(Case{"double", 1e-11}, Case{"single", 2e-5}),
                         [](const auto& param) { return std::string(param.param.precision); });

TEST(BulletTiltSettings, GravityIsReadBack) {
  RemoteEngine engine(bullet_executable("double"));
  const Scene scene = tilted(5, 0.5, 0);
  const Applied applied = engine.configure(scene, kDefault, 1e-3);
  EXPECT_EQ(std::get<double>(applied.settings.at("gravity")), scene.gravity);
  EXPECT_EQ(std::get<double>(applied.settings.at("downhill_x")), 0);
  EXPECT_EQ(std::get<double>(applied.settings.at("downhill_y")), scene.downhill.y());
  const Applied level = engine.configure(tilted(0, 0.5, 0), kDefault, 1e-3);
  EXPECT_EQ(level.settings.count("downhill_x"), 0u);
}

}  // namespace
}  // namespace slipcheck
