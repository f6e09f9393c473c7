#include "physics/motion/substrate_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../support/extremes.h"
#include "physics/numbers.h"

namespace slipcheck {
namespace {

SubstrateMotion oscillation() {
  return SubstrateMotion::oscillation({0.1, -0.03}, 5, std::numbers::pi / 3);
}

/// At rest at (1, 0) until 0.5 s, then 2 m/s along x, 1 m/s along −y, at rest from 2 s on.
SubstrateMotion table() {
  return SubstrateMotion::table({{0.5, {1, 0}}, {1, {2, 0}}, {2, {2, -1}}});
}

TEST(SubstrateMotion, StillStaysWhereItIs) {
  const SubstrateMotion motion;
  EXPECT_TRUE(motion.is_still());
  EXPECT_EQ(motion.position(3), Vector3::Zero());
  EXPECT_EQ(motion.velocity(3), Vector3::Zero());
  EXPECT_EQ(motion.acceleration(3), Vector3::Zero());
  EXPECT_EQ(motion.largest_speed(), 0);
  EXPECT_EQ(motion.next_kink(0), kNever);
}

TEST(SubstrateMotion, WhatNeverMovesIsStill) {
  EXPECT_TRUE(SubstrateMotion::constant(Vector2::Zero()).is_still());
  EXPECT_TRUE(SubstrateMotion::oscillation(Vector2::Zero(), 5, 1).is_still());
}

TEST(SubstrateMotion, ConstantVelocity) {
  const SubstrateMotion motion = SubstrateMotion::constant({0.3, -0.4});
  EXPECT_FALSE(motion.is_still());
  EXPECT_TRUE(motion.is_uniform_between_kinks());
  EXPECT_EQ(motion.position(2), Vector3(0.6, -0.8, 0));
  EXPECT_EQ(motion.velocity(-7), Vector3(0.3, -0.4, 0));
  EXPECT_EQ(motion.acceleration(2), Vector3::Zero());
  EXPECT_DOUBLE_EQ(motion.largest_speed(), 0.5);
  EXPECT_EQ(motion.largest_acceleration(), 0);
  EXPECT_EQ(motion.next_kink(0), kNever);
}

TEST(SubstrateMotion, OscillationIsTheSineWithItsPhase) {
  const SubstrateMotion motion = oscillation();
  EXPECT_FALSE(motion.is_uniform_between_kinks());
  // sin(60°) at t = 0; a quarter of a period later cos(60°).
  EXPECT_NEAR(motion.position(0).x(), 0.1 * std::sqrt(0.75), 1e-16);
  EXPECT_NEAR(motion.position(0.05).y(), -0.03 * 0.5, 1e-16);
  EXPECT_EQ(motion.next_kink(0), kNever);
}

TEST(SubstrateMotion, VelocitiesAndAccelerationsAreTheDifferencesOfPositions) {
  const double h = 1e-5;
  for (const SubstrateMotion& motion :
       {oscillation(), SubstrateMotion::constant({0.3, -0.4}), table()}) {
    for (double t : {-0.4, 0.013, 0.7, 1.3, 2.7}) {
      const Vector3 velocity = (motion.position(t + h) - motion.position(t - h)) / (2 * h);
      const Vector3 acceleration = (motion.velocity(t + h) - motion.velocity(t - h)) / (2 * h);
      // Central differences: h² ω²/6 of the largest value, and rounding ε x/h.
      EXPECT_LE((motion.velocity(t) - velocity).norm(), 1e-7 * 3.3) << t;
      EXPECT_LE((motion.acceleration(t) - acceleration).norm(), 1e-7 * 103) << t;
    }
  }
}

TEST(SubstrateMotion, OscillationReachesItsLargestSpeedAndAcceleration) {
  const SubstrateMotion motion = oscillation();
  double speed = 0, acceleration = 0;
  for (int n = 0; n <= 20000; ++n) {
    speed = test::largest_of(speed, motion.velocity(1e-5 * n).norm());
    acceleration = test::largest_of(acceleration, motion.acceleration(1e-5 * n).norm());
  }
  // The extreme lies between two samples at most ω h/2 = 1.6e-4 rad away: half of its square.
  EXPECT_NEAR(speed / motion.largest_speed(), 1, 1.3e-8);
  EXPECT_NEAR(acceleration / motion.largest_acceleration(), 1, 1.3e-8);
  EXPECT_NEAR(motion.largest_speed(), 2 * std::numbers::pi * 5 * std::hypot(0.1, 0.03), 1e-15);
}

TEST(SubstrateMotion, TableIsLinearBetweenItsPointsAndAtRestOutside) {
  const SubstrateMotion motion = table();
  EXPECT_TRUE(motion.is_uniform_between_kinks());
  EXPECT_EQ(motion.position(-1), Vector3(1, 0, 0));
  EXPECT_EQ(motion.velocity(0.49), Vector3::Zero());
  EXPECT_EQ(motion.position(0.75), Vector3(1.5, 0, 0));
  EXPECT_EQ(motion.velocity(0.75), Vector3(2, 0, 0));
  EXPECT_EQ(motion.position(1.5), Vector3(2, -0.5, 0));
  EXPECT_EQ(motion.velocity(1.5), Vector3(0, -1, 0));
  EXPECT_EQ(motion.position(9), Vector3(2, -1, 0));
  EXPECT_EQ(motion.velocity(9), Vector3::Zero());
  EXPECT_EQ(motion.largest_speed(), 2);
  EXPECT_EQ(motion.largest_acceleration(), 0);
}

TEST(SubstrateMotion, AtAKinkTheVelocityIsTheOneAfterIt) {
  const SubstrateMotion motion = table();
  EXPECT_EQ(motion.velocity(0.5), Vector3(2, 0, 0));
  EXPECT_EQ(motion.velocity(1), Vector3(0, -1, 0));
  EXPECT_EQ(motion.velocity(2), Vector3::Zero());
}

TEST(SubstrateMotion, KinksComeOneAfterTheOther) {
  const SubstrateMotion motion = table();
  EXPECT_EQ(motion.next_kink(-kNever), 0.5);
  EXPECT_EQ(motion.next_kink(0.5), 1);
  EXPECT_EQ(motion.next_kink(1.2), 2);
  EXPECT_EQ(motion.next_kink(2), kNever);
}

TEST(SubstrateMotion, APointOnAStraightLineIsNoKink) {
  const SubstrateMotion motion =
      SubstrateMotion::table({{0, {0, 0}}, {1, {1, 0}}, {2, {2, 0}}, {4, {2, 0}}, {5, {2, 0}}});
  EXPECT_EQ(motion.next_kink(0), 2);
  EXPECT_EQ(motion.next_kink(2), kNever);
}

TEST(SubstrateMotion, ATableOfOnePointIsAtRestThere) {
  const SubstrateMotion motion = SubstrateMotion::table({{1, {2, 3}}});
  EXPECT_EQ(motion.position(0), Vector3(2, 3, 0));
  EXPECT_EQ(motion.position(2), Vector3(2, 3, 0));
  EXPECT_EQ(motion.velocity(1), Vector3::Zero());
  EXPECT_EQ(motion.largest_speed(), 0);
  EXPECT_EQ(motion.next_kink(0), kNever);
}

}  // namespace
}  // namespace slipcheck
