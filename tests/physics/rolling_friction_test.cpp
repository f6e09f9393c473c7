#include "physics/contact/rolling_friction.h"

#include <gtest/gtest.h>

#include <cmath>

namespace slipcheck {
namespace {

TEST(RollingFriction, ConstantEverywhere) {
  const RollingFriction friction(0.01);
  EXPECT_EQ(friction(0), 0.01);
  EXPECT_EQ(friction(100), 0.01);
  EXPECT_EQ(friction.piece_below(3).lower_speed, 0);
  EXPECT_EQ(friction.piece_below(3).slope, 0);
}

TEST(RollingFriction, LinearBetweenItsPointsAndConstantOutside) {
  const RollingFriction friction({{0.1, 0.01}, {0.3, 0.03}, {0.5, 0.02}});
  EXPECT_EQ(friction(0), 0.01);
  EXPECT_DOUBLE_EQ(friction(0.2), 0.02);
  EXPECT_DOUBLE_EQ(friction(0.4), 0.025);
  EXPECT_EQ(friction(9), 0.02);
  EXPECT_DOUBLE_EQ(friction.largest_up_to(9), 0.03);
  EXPECT_DOUBLE_EQ(friction.largest_up_to(0.2), 0.02);
}

TEST(RollingFriction, APieceIsTheOneThatASlowingBodyIsIn) {
  const RollingFriction friction({{0.1, 0.01}, {0.3, 0.03}});
  const auto above = friction.piece_below(0.7);
  EXPECT_EQ(above.slope, 0);
  EXPECT_EQ(above.lower_speed, 0.3);
  const auto at_point = friction.piece_below(0.3);
  EXPECT_DOUBLE_EQ(at_point.slope, 0.1);
  EXPECT_EQ(at_point.lower_speed, 0.1);
  // A rounding error above the point: without this a run would never get below it.
  EXPECT_EQ(friction.piece_below(std::nextafter(0.3, 1)).lower_speed, 0.1);
  const auto below = friction.piece_below(0.1);
  EXPECT_EQ(below.slope, 0);
  EXPECT_EQ(below.lower_speed, 0);
}

}  // namespace
}  // namespace slipcheck
