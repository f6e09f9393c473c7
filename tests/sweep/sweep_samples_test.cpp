#include "studies/sweep/sweep_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace slipcheck {
namespace {

TEST(SweepSamples, ALatinHypercubeHasOnePointInEachSlice) {
  constexpr std::size_t points = 50, dimensions = 3;
  const std::vector<double> cube = latin_hypercube(points, dimensions, 7);
  for (std::size_t d = 0; d < dimensions; ++d) {
    std::set<std::size_t> slices;
    for (std::size_t k = 0; k < points; ++k)
      slices.insert(static_cast<std::size_t>(cube[k * dimensions + d] * points));
    EXPECT_EQ(slices.size(), points);
    EXPECT_EQ(*slices.rbegin(), points - 1);
  }
}

/// The correlation of two coordinates in random order scatters by 1/√(N−1) around 0.
TEST(SweepSamples, CoordinatesOfALatinHypercubeKnowNothingOfEachOther) {
  constexpr std::size_t points = 1000, dimensions = 3;
  const std::vector<double> cube = latin_hypercube(points, dimensions, 3);
  for (std::size_t a = 0; a < dimensions; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      double sum = 0;
      for (std::size_t k = 0; k < points; ++k)
        sum += (cube[k * dimensions + a] - 0.5) * (cube[k * dimensions + b] - 0.5);
      const double correlation = 12 * sum / points;  // the variance in [0, 1) is 1/12
      EXPECT_LT(std::abs(correlation), 4 / std::sqrt(points - 1.0)) << a << " and " << b;
    }
}

TEST(SweepSamples, ASeedGivesItsPointsAgain) {
  EXPECT_EQ(latin_hypercube(20, 2, 1), latin_hypercube(20, 2, 1));
  EXPECT_NE(latin_hypercube(20, 2, 1), latin_hypercube(20, 2, 2));
}

/// The first points of Bratley and Fox, ACM Trans. Math. Softw. 14, 88 (1988), in Gray code order.
TEST(SweepSamples, SobolsFirstPoints) {
  const std::vector<double> expected = {0.5, 0.5, 0.75, 0.25, 0.25, 0.75, 0.375, 0.375};
  EXPECT_EQ(sobol_points(4, 2), expected);
}

/// Of 2^m - 1 points and the corner that is left out each of 2^m slices has one.
TEST(SweepSamples, SobolsPointsFillSlicesEvenly) {
  const std::vector<double> cube = sobol_points(63, 5);
  for (std::size_t d = 0; d < 5; ++d) {
    std::set<int> slices;
    for (std::size_t k = 0; k < 63; ++k)
      slices.insert(static_cast<int>(std::floor(cube[k * 5 + d] * 64)));
    EXPECT_EQ(slices.size(), 63u);
    EXPECT_EQ(*slices.begin(), 1);
  }
}

}  // namespace
}  // namespace slipcheck
