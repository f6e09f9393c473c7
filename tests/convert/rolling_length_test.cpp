#include "convert/rolling_length.h"

#include <gtest/gtest.h>

namespace slipcheck {
namespace {

// A solid sphere slows by (5/7)(ρ/R) g: measured in Bullet 3.24 with a ratio of 1.0000.
TEST(RollingLength, OfASolidSphereIsSevenFifthsOfMuR) {
  const Sphere ball{0.01, 0.03, 0.4};
  EXPECT_NEAR(rolling_length(ball, 0.02), 7.0 / 5 * 0.02 * 0.01, 1e-18);
  EXPECT_NEAR(rolling_coefficient(ball, 2.8e-4), 0.02, 1e-16);
}

// q = 2/3.
TEST(RollingLength, OfAShellIsFiveThirds) {
  const Sphere shell{0.3, 1, 2.0 / 3};
  EXPECT_NEAR(rolling_length(shell, 0.01), 5.0 / 3 * 0.01 * 0.3, 1e-17);
}

}  // namespace
}  // namespace slipcheck
