#include "physics/safe_root.h"

#include <gtest/gtest.h>

#include "physics/fall_time.h"

namespace slipcheck {
namespace {

TEST(SafeRoot, AStepEndsWhereTheBoundIsZero) {
  EXPECT_DOUBLE_EQ(step_to_bound(3, 2, 2), 3);   // 3 + 2 τ − τ² = (3 − τ)(1 + τ)
  EXPECT_DOUBLE_EQ(step_to_bound(3, -2, 2), 1);  // 3 − 2 τ − τ² = (1 − τ)(3 + τ)
  EXPECT_DOUBLE_EQ(step_to_bound(3, -2, 0), 1.5);
  EXPECT_EQ(step_to_bound(3, 2, 0), kNever);
  EXPECT_EQ(step_to_bound(3, 0, 0), kNever);
}

TEST(SafeRoot, FindsTheFirstNumberOfWhichAConditionHolds) {
  EXPECT_EQ(first_true(0, 1, [](double x) { return x >= 0.3; }), 0.3);
  EXPECT_EQ(first_true(0, 1, [](double) { return false; }), 1);
}

TEST(FallTime, IsThatOfAParabola) {
  EXPECT_DOUBLE_EQ(fall_time(1.25, 0, 10), 0.5);  // h = ½ g t²
  EXPECT_DOUBLE_EQ(fall_time(0, 5, 10), 1);       // v t = ½ g t²
  EXPECT_DOUBLE_EQ(fall_time(10, -5, 10), 1);     // 10 − 5 − 5
  EXPECT_DOUBLE_EQ(fall_time(10, 5, 10), 2);      // 10 + 10 − 20
  EXPECT_DOUBLE_EQ(fall_time(1, -2, 0), 0.5);
  EXPECT_EQ(fall_time(1, 2, 0), kNever);
  EXPECT_EQ(fall_time(1, 0, 0), kNever);
  EXPECT_EQ(fall_time(0, 0, 10), kNever);
  // From 1 nm with 1 km/s down no digits are lost: h/v (1 − g h/(2 v²) + …).
  EXPECT_DOUBLE_EQ(fall_time(1e-9, -1e3, 10), 1e-12 * (1 - 5e-15));
}

}  // namespace
}  // namespace slipcheck
