// A minute on the plane: balls at rest and balls that roll stay on it and keep their speed.

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "../support/extremes.h"
#include "bullet_run.h"

namespace slipcheck {
namespace {

constexpr double kMinute = 60;  // [s]

class BulletLongRest : public ::testing::TestWithParam<std::tuple<const char*, double>> {};

TEST_P(BulletLongRest, BallsStayOnThePlaneAndKeepTheirSpeed) {
  const auto& [profile, rate] = GetParam();
  // Ways of their own: at rest, and out from a circle, so that they never meet.
  Scene scene =
      scene_of(steel_ball(kRadius), {rolling_along_x(kRadius, -0.5, 0)}, ground_with_friction(0.1));
  const double speeds[] = {0.001, 0.01, 0.02, 0.05, 0.1, 0.3};  // [m/s]
  double heading = 0;
  for (const double speed : speeds) {
    scene.bodies.push_back(scene.bodies[0]);
    scene.material.push_back(0);
    scene.initial.push_back(rolling_towards(kRadius, speed, heading, 0.05));
    heading += 22.5;
  }
  RemoteEngine engine(bullet_executable("double"));
  engine.configure(scene, shipped(profile), 1 / rate);
  engine.start(scene.initial);
  double off_plane = 0, off_velocity = 0;
  Frame last;
  engine.advance(static_cast<std::size_t>(kMinute * rate), [&](const Frame& frame) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const BodyState& body = frame.bodies[i];
      off_plane = test::largest_of(off_plane, std::abs(body.position.z() - kRadius));
      off_velocity =
          test::largest_of(off_velocity, (body.velocity - scene.initial[i].velocity).norm());
    }
    last = frame;
  });
  EXPECT_LT(off_plane, 1e-3 * kRadius);
  EXPECT_LT(off_velocity, 1e-6);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodyState& start = scene.initial[i];
    EXPECT_LT((last.bodies[i].position - start.position - kMinute * start.velocity).norm(), 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(ProfilesAndRates, BulletLongRest,
                         ::testing::Combine(::testing::Values("tuned", "fast"),
                                            ::testing::Values(60.0, 240.0)),
                         [](const auto& param) {
                           return std::string(std::get<0>(param.param)) + "_" +
                                  std::to_string(static_cast<int>(std::get<1>(param.param)));
                         });

}  // namespace
}  // namespace slipcheck
