// Blocks, cylinders and cues in the bundled scenes, against closed forms. g = 9.81 m/s². What the
// exact phases leave is rounding.

#include <gtest/gtest.h>

#include <cmath>

#include "bundled_scenes.h"

namespace slipcheck {
namespace {

using test::play;
using test::Played;

constexpr double kStandardG = 9.81;
constexpr double kLost = 1e-12;

TEST(SportScene, ABlockStopsAfterVSquaredOverTwoMuG) {
  const Played scene = play("block-stops");
  const double a = 0.3 * kStandardG;
  EXPECT_NEAR(scene["block.stopping_time"], 2 / a, kLost);
  EXPECT_NEAR(scene["block.stopping_distance"], 4 / (2 * a), kLost);
  EXPECT_NEAR(scene["block.sliding_time"], 2 / a, kLost);
  EXPECT_NEAR(scene["block.sliding_distance"], 4 / (2 * a), kLost);
  EXPECT_EQ(scene.vector("block.rolling_velocity"), Vector3::Zero());
}

TEST(SportScene, ABlockThatComesToRestOnASlopeStaysThere) {
  const Played scene = play("block-on-ramp-holds");
  const double theta = 25 * M_PI / 180;
  const double a = kStandardG * (std::sin(theta) + 0.4 * std::cos(theta));
  EXPECT_NEAR(scene["block.stopping_time"], 1.5 / a, kLost);
  EXPECT_NEAR(scene["block.stopping_distance"], 1.5 * 1.5 / (2 * a), kLost);
  EXPECT_NEAR(scene["block.final_position.y"], 1.5 * 1.5 / (2 * a), kLost);
  EXPECT_EQ(scene.vector("block.final_velocity"), Vector3::Zero());
}

TEST(SportScene, ABlockSlipsWhereTheSlopeIsBeyondStaticFriction) {
  const Played scene = play("block-on-ramp-slips");
  const double theta = 30 * M_PI / 180;
  const double a = kStandardG * (std::sin(theta) - 0.4 * std::cos(theta));
  EXPECT_NEAR(scene["block.final_velocity.y"], -a, kLost);
  EXPECT_NEAR(scene["block.final_position.y"], -a / 2, kLost);
  EXPECT_EQ(scene.vector("block.final_angular_velocity"), Vector3::Zero());
}

TEST(SportScene, ACylinderRollsWithTwoThirdsOfTheSlope) {
  const Played scene = play("cylinder-rolls");
  const double a = 2.0 / 3 * kStandardG * std::sin(20 * M_PI / 180);
  EXPECT_NEAR(scene["roller.final_velocity.y"], -a, kLost);
  EXPECT_NEAR(scene["roller.final_position.y"], -a / 2, kLost);
  EXPECT_NEAR(scene["roller.final_angular_velocity.x"], a / 0.02, 1e-10);
}

TEST(SportScene, ACylinderLosesAThirdOfItsSpeedBeforeItRolls) {
  const Played scene = play("cylinder-slide-to-roll");
  const double time = 1 / (3 * 0.2 * kStandardG);
  EXPECT_NEAR(scene["roller.sliding_time"], time, kLost);
  EXPECT_NEAR(scene["roller.sliding_distance"], (1 + 2.0 / 3) / 2 * time, kLost);
  EXPECT_NEAR(scene["roller.rolling_velocity.x"], 2.0 / 3, kLost);
}

/// What the cue of both shots gives a ball that it strikes 2/5 R off its centre [m/s]: J/m with
/// J = (1 + e) V/(1/M + 1/m + (2/5)²/((2/5) m)).
double struck_speed() {
  const double V = 2, M = 0.54, m = 0.17, e = 0.73;
  return (1 + e) * V / (m / M + 1 + 0.4);
}

/// Rolling velocities of the two balls after a central impact at v with the cue ball's spin RΩ. The
/// substrate's friction leaves 5 v + 2 RΩ of each as it is, in slides, hops and landings alike; the
/// balls rub by μ P_n at their surfaces' slip |RΩ|, which turns both the same way.
struct Parted {
  double cue, object;
};
Parted part(double v, double spin) {
  const double e = 0.95, mu = 9.951e-3 + 0.108 * std::exp(-1.088 * std::abs(spin));
  const double rub = -std::copysign(2.5 * mu * (1 + e) / 2 * v, spin);
  return {(5 * (1 - e) / 2 * v + 2 * (spin + rub)) / 7, (5 * (1 + e) / 2 * v + 2 * rub) / 7};
}

constexpr double kBall = 0.05715, kWay = 0.3 - kBall, kCloth = 0.2, kRolling = 0.01;

TEST(SportScene, AFollowShotRollsOnAfterTheObjectBall) {
  const Played scene = play("follow-shot");
  const double v0 = struck_speed();
  const double v = std::sqrt(v0 * v0 - 2 * kRolling * kStandardG * kWay);  // it rolls at once
  const Parted after = part(v, v);
  EXPECT_NEAR(scene["cue.rolling_velocity.x"], after.cue, 1e-9);
  EXPECT_NEAR(scene["object.rolling_velocity.x"], after.object, 1e-9);
  EXPECT_GT(after.cue, 0.2 * v);
}

TEST(SportScene, ADrawShotComesBack) {
  const Played scene = play("draw-shot");
  const double v0 = struck_speed(), a = kCloth * kStandardG;
  const double v = std::sqrt(v0 * v0 - 2 * a * kWay);
  const double time = (v0 - v) / a;
  const Parted after = part(v, -v0 + 2.5 * a * time);
  EXPECT_NEAR(scene["cue.rolling_velocity.x"], after.cue, 1e-9);
  EXPECT_NEAR(scene["object.rolling_velocity.x"], after.object, 1e-9);
  EXPECT_LT(after.cue, 0);
}

}  // namespace
}  // namespace slipcheck
