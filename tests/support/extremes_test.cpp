#include "extremes.h"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace slipcheck::test {
namespace {

TEST(Extremes, AreTheLargestAndTheLeast) {
  EXPECT_EQ(largest_of(-3.0), -3);
  EXPECT_EQ(largest_of(-3.0, -1.0, -2.0), -1);
  EXPECT_EQ(least_of(3.0, 1.0, 2.0), 1);
  EXPECT_EQ(largest_of(0.0, 1e300), 1e300);
}

TEST(Extremes, OneNaNAnywhereFailsEveryExpectation) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  using Three = std::array<double, 3>;
  for (const auto& [a, b, c] : {Three{nan, 1, 2}, Three{1, nan, 2}, Three{2, 1, nan}}) {
    EXPECT_TRUE(std::isnan(largest_of(a, b, c)));
    EXPECT_TRUE(std::isnan(least_of(a, b, c)));
  }
  // As tests fold values: one frame of three is NaN.
  static double worst;
  worst = 0;
  for (const double error : {1e-9, nan, 1e-9}) worst = largest_of(worst, error);
  EXPECT_NONFATAL_FAILURE(EXPECT_LT(worst, 1), "nan");
  EXPECT_NONFATAL_FAILURE(EXPECT_GT(worst, -1), "nan");
  EXPECT_NONFATAL_FAILURE(EXPECT_NEAR(worst, 0, 1), "nan");
}

}  // namespace
}  // namespace slipcheck::test
