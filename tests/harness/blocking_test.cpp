#include "harness/observe/blocking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "series.h"

namespace slipcheck {
namespace {

constexpr int kSeries = 400;

struct Ensemble {
  double covered = 0;   ///< fraction of the 95 % intervals that hold the true mean
  double variance = 0;  ///< mean of SE², over the true variance of the mean
  double time = 0;      ///< mean correlation time
  int plateaus = 0;     ///< of kSeries
};

Ensemble ensemble(std::size_t n, double rho) {
  Ensemble sum;
  for (int seed = 0; seed < kSeries; ++seed) {
    const auto x = test::correlated(n, rho, static_cast<std::uint64_t>(seed) + 1);
    const BlockedMean seen = blocked_mean(x);
    sum.plateaus += seen.plateau;
    if (std::abs(seen.mean) <= seen.half_width95()) sum.covered += 1.0 / kSeries;
    sum.variance += seen.standard_error * seen.standard_error / kSeries;
    sum.time += seen.correlation_time / kSeries;
  }
  sum.variance /= test::variance_of_mean(n, rho);
  return sum;
}

TEST(Blocking, FindsTheErrorOfACorrelatedSeries) {
  for (double rho : {0.0, 0.5, 0.9, 0.98}) {
    const Ensemble seen = ensemble(8192, rho);
    EXPECT_GE(seen.plateaus, 0.99 * kSeries) << rho;
    // Binomial scatter of the coverage is √(0.95 · 0.05/400) = 0.011, four of them; the bias of the
    // error (below) takes up to 0.02 from it.
    EXPECT_NEAR(seen.covered, 0.95, 0.045) << rho;
    // The criterion leaves a bias of the size of the scatter of one estimate, √(2B/n) with
    // B = (2 n g²)^(1/3): 0.08 without correlation, 0.4 for g = 99.
    const double g = (1 + rho) / (1 - rho);
    const double scatter = std::sqrt(2 * std::cbrt(2 * 8192 * g * g) / 8192);
    EXPECT_NEAR(seen.variance, 1, scatter) << rho;
    EXPECT_NEAR(seen.time, 0.5 * g, 0.5 * g * scatter) << rho;
  }
}

TEST(Blocking, CoversTheMeanOfShortSeries) {
  // Fewer blocks scatter more, which Student's factor makes up for, and the smallest block size
  // that passes is the one whose error came out low.
  for (std::size_t n : {64u, 256u}) EXPECT_NEAR(ensemble(n, 0).covered, 0.95, 0.05) << n;
  EXPECT_NEAR(ensemble(2000, 0.9).covered, 0.93, 0.045);
}

TEST(Blocking, SaysWhereASeriesIsTooShortForItsCorrelation) {
  // 500 samples of correlation time 99.5: hardly more than two independent ones.
  EXPECT_LT(ensemble(500, 0.99).plateaus, 0.05 * kSeries);
}

TEST(Blocking, AnticorrelatedSamplesTellMore) {
  const BlockedMean seen = blocked_mean(test::correlated(40000, -0.5, 7));
  // ½ (1 + ρ)/(1 − ρ) = 1/6; scatter √(2B/n) with B = 21 is 3 %, three of them.
  EXPECT_NEAR(seen.correlation_time, 1.0 / 6, 0.1 / 6);
  EXPECT_EQ(seen.effective_samples, 40000);
}

TEST(Blocking, ShortSeriesHaveAMeanWithoutAnError) {
  std::vector<double> x(31);
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = static_cast<double>(k % 2);
  const BlockedMean seen = blocked_mean(x);
  EXPECT_DOUBLE_EQ(seen.mean, 15.0 / 31);
  EXPECT_TRUE(std::isnan(seen.standard_error));
  EXPECT_TRUE(std::isnan(seen.half_width95()));
  EXPECT_FALSE(seen.plateau);
  EXPECT_EQ(seen.samples, 31u);
  x.push_back(1);
  EXPECT_FALSE(std::isnan(blocked_mean(x).standard_error));
}

TEST(Blocking, AConstantSeriesHasNoErrorAndNothingHasNoMean) {
  const BlockedMean constant = blocked_mean(std::vector<double>(1000, 0.1));
  EXPECT_EQ(constant.mean, 0.1);
  EXPECT_EQ(constant.standard_error, 0);
  EXPECT_TRUE(constant.plateau);
  EXPECT_TRUE(std::isnan(blocked_mean({}).mean));
}

TEST(Blocking, ACycleIsNoMoreCertainThanOneSample) {
  // Blocks of whole cycles do not scatter at all; one sample more moves the mean by up to σ/n.
  std::vector<double> x(1000);
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = k % 2 == 0 ? 1 : -1;
  // σ² = n/(n − 1) here.
  EXPECT_NEAR(blocked_mean(x).standard_error, std::sqrt(1000.0 / 999) / 1000, 1e-15);
}

TEST(Blocking, WhatIsNotFiniteStaysSo) {
  std::vector<double> x(100, 1.0);
  x[50] = std::numeric_limits<double>::quiet_NaN();
  const BlockedMean seen = blocked_mean(x);
  EXPECT_TRUE(std::isnan(seen.mean));
  EXPECT_TRUE(std::isnan(seen.standard_error));
  EXPECT_FALSE(seen.plateau);
}

TEST(Blocking, HalfWidthIsStudentsOfOneDegreeOfFreedomLessThanBlocks) {
  // t of 5, 9 and 29 degrees, Abramowitz and Stegun, table 26.10.
  const std::pair<std::size_t, double> factors[] = {{6, 2.571}, {10, 2.262}, {30, 2.045}};
  for (const auto& [blocks, factor] : factors) {
    BlockedMean mean;
    mean.standard_error = 2;
    mean.blocks = blocks;
    EXPECT_NEAR(mean.half_width95(), 2 * factor, 0.002) << blocks;
  }
}

TEST(Blocking, StudentsFactorAsInTables) {
  // Abramowitz and Stegun, table 26.10; the series is cut off, 0.3 % at 3 degrees.
  EXPECT_NEAR(student_factor95(3), 3.182, 0.01);
  EXPECT_NEAR(student_factor95(7), 2.365, 0.001);
  EXPECT_NEAR(student_factor95(30), 2.042, 0.001);
  EXPECT_NEAR(student_factor95(1000000), 1.960, 0.001);
}

}  // namespace
}  // namespace slipcheck
