#include "harness/compare/power_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "../support/refusal.h"
#include "series.h"

namespace slipcheck {
namespace {

TEST(PowerLaw, IsExactOnPointsOfALaw) {
  const std::vector<double> x = {0.1, 0.4, 1, 3, 70};
  std::vector<double> y, error;
  for (double value : x) {
    y.push_back(2.5e-3 * std::pow(value, 1.72));
    error.push_back(0.1 * y.back() * value);
  }
  // Rounding of logarithms of up to 13, some ulps.
  for (const PowerLaw& law : {fit_power_law(x, y), fit_power_law(x, y, error)}) {
    EXPECT_NEAR(law.exponent[0], 1.72, 1e-13);
    EXPECT_NEAR(law.factor, 2.5e-3, 1e-15);
    EXPECT_NEAR(law({10}), 2.5e-3 * std::pow(10, 1.72), 1e-12);
  }
  EXPECT_LT(fit_power_law(x, y, error).chi2_per_degree, 1e-24);
  EXPECT_TRUE(std::isnan(fit_power_law(x, y).chi2_per_degree));
}

TEST(PowerLaw, HasTheErrorsOfAStraightLine) {
  // With ln x = −1, 0, 1, 2 and relative errors s: σ_p = s/√Σ(X − 1/2)² = s/√5, and of ln c, at
  // X = 0 beside the middle 1/2, s √(1/4 + 1/20).
  std::vector<double> x, y, error;
  for (int k = -1; k <= 2; ++k) {
    x.push_back(std::exp(k));
    y.push_back(3 * std::exp(-0.6 * k));
    error.push_back(0.02 * y.back());
  }
  const PowerLaw law = fit_power_law(x, y, error);
  EXPECT_NEAR(law.exponent[0], -0.6, 1e-14);
  EXPECT_NEAR(law.exponent_error[0], 0.02 / std::sqrt(5.0), 1e-14);
  EXPECT_NEAR(law.factor_error, 3 * 0.02 * std::sqrt(0.3), 1e-14);
}

TEST(PowerLaw, WeighsPointsByTheirErrors) {
  // Three points X = 0, 1, 1 with ln y = 0, 0, 1 and relative errors 1, 1, 2: the two at 1 count as
  // their weighted mean 1/5 of weight 5/4, so p = 1/5. χ² = (1/5)² + (4/5)²/4 = 1/5, with one
  // degree of freedom. σ_p² = 1 + 4/5.
  const double e = std::exp(1.0);
  const PowerLaw law =
      fit_power_law({1, e, e}, std::vector<double>{1, 1, e}, std::vector<double>{1, 1, 2 * e});
  EXPECT_NEAR(law.exponent[0], 0.2, 1e-14);
  EXPECT_NEAR(law.chi2_per_degree, 0.2, 1e-14);
  EXPECT_NEAR(law.exponent_error[0], std::sqrt(1.8), 1e-14);
  // Errors a tenth of that are too small: χ² = 20, and the exponent's error grows by √20.
  const PowerLaw tight = fit_power_law({1, e, e}, std::vector<double>{1, 1, e},
                                       std::vector<double>{0.1, 0.1, 0.2 * e});
  EXPECT_NEAR(tight.chi2_per_degree, 20, 1e-12);
  EXPECT_NEAR(tight.exponent_error[0], 0.1 * std::sqrt(1.8 * 20), 1e-13);
}

TEST(PowerLaw, WithoutErrorsTheScatterGivesThem) {
  // X = −1, 0, 1 and ln y = 1, −2, 1: p = 0, ln c = 0, Σ of squares 6 with one degree of freedom;
  // σ_p² = 6/2, σ_ln c² = 6/3.
  const double e = std::exp(1.0);
  const PowerLaw law = fit_power_law({1 / e, 1, e}, std::vector<double>{e, 1 / (e * e), e});
  EXPECT_NEAR(law.exponent[0], 0, 1e-14);
  EXPECT_NEAR(law.factor, 1, 1e-14);
  EXPECT_NEAR(law.exponent_error[0], std::sqrt(3.0), 1e-13);
  EXPECT_NEAR(law.factor_error, std::sqrt(2.0), 1e-13);
}

TEST(PowerLaw, OfTwoVariables) {
  std::vector<std::vector<double>> x(2);
  std::vector<double> y;
  for (double v : {0.5, 1.0, 2.0, 3.0})
    for (double n : {27.0, 40.0, 60.0, 90.0}) {
      x[0].push_back(v);
      x[1].push_back(n);
      y.push_back(0.4 * std::pow(v, 1.5) * std::pow(n, -0.71));
    }
  const PowerLaw law = fit_power_law(x, y);
  EXPECT_NEAR(law.exponent[0], 1.5, 1e-13);
  EXPECT_NEAR(law.exponent[1], -0.71, 1e-13);
  EXPECT_NEAR(law.factor, 0.4, 1e-12);
  EXPECT_NEAR(law({2, 27}), y[8], 1e-13);
}

TEST(PowerLaw, TwoPointsHaveNoScatter) {
  const PowerLaw law = fit_power_law({1, 2}, std::vector<double>{1, 8});
  EXPECT_NEAR(law.exponent[0], 3, 1e-14);
  EXPECT_TRUE(std::isnan(law.exponent_error[0]));
  // With errors of 1 % of both: √2 · 0.01/ln 2.
  const PowerLaw known =
      fit_power_law({1, 2}, std::vector<double>{1, 8}, std::vector<double>{0.01, 0.08});
  EXPECT_NEAR(known.exponent_error[0], 0.01 * std::sqrt(2.0) / std::log(2.0), 1e-14);
}

TEST(PowerLaw, ItsErrorsAreThoseOfManyFits) {
  // 4000 sets of 12 points with errors of 3 %: the exponents' deviations over their errors have
  // variance 1, to 4 · √(2/4000) = 0.09. Where χ² is above 1 the error is widened: it then is too
  // large by up to the scatter of √χ², 1/√20, so that the variance may fall by some 10 %.
  test::Normal normal(3);
  std::vector<double> x, error;
  for (int k = 0; k < 12; ++k) x.push_back(std::pow(1.3, k));
  double variance = 0;
  for (int set = 0; set < 4000; ++set) {
    std::vector<double> y;
    error.clear();
    for (double value : x) {
      y.push_back(std::pow(value, 1.5) * (1 + 0.03 * normal()));
      error.push_back(0.03 * std::pow(value, 1.5));
    }
    const PowerLaw law = fit_power_law(x, y, error);
    variance += std::pow((law.exponent[0] - 1.5) / law.exponent_error[0], 2) / 4000;
  }
  EXPECT_GT(variance, 0.8);
  EXPECT_LT(variance, 1.09);
}

std::string message(const std::vector<double>& x, const std::vector<double>& y,
                    const std::vector<double>& error = {}) {
  return test::refusal_of<std::invalid_argument>([&] { fit_power_law(x, y, error); });
}

TEST(PowerLaw, RefusesWhatHasNoLogarithmOrNoLaw) {
  EXPECT_EQ(message({1}, {1}), "power law: 1 points for 2 unknowns");
  EXPECT_EQ(message({1, 2, 3}, {1, 2}), "power law: x has 3 values for 2 points");
  EXPECT_EQ(message({1, 2}, {1, -0.5}), "power law: y must be > 0 and finite, got -0.5");
  EXPECT_EQ(message({0, 2}, {1, 2}), "power law: x must be > 0 and finite, got 0");
  EXPECT_EQ(message({1, 2}, {1, 2}, {0.1, 0}), "power law: error must be > 0 and finite, got 0");
  EXPECT_EQ(message({2, 2}, {1, 3}), "power law: the variables must vary, each on its own");
}

}  // namespace
}  // namespace slipcheck
