#include "studies/precision/convergence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace slipcheck {
namespace {

using Kind = Convergence::Kind;

const std::vector<double> kSteps = {1 / 60.0, 1 / 240.0, 1e-3, 1 / 4000.0, 1 / 16000.0};

Convergence of(const std::vector<double>& errors, const ErrorFloor& floor = {1e-9, 0},
               const std::vector<double>& knobs = kSteps) {
  return convergence_of(std::span(knobs).first(errors.size()), errors, floor);
}

std::vector<double> at_steps(const std::function<double(double)>& error) {
  std::vector<double> errors;
  for (const double h : kSteps) errors.push_back(error(h));
  return errors;
}

TEST(Convergence, PurePowersHaveTheirOrder) {
  for (const double p : {0.5, 1.0, 1.5, 2.0, 4.0}) {
    const Convergence found = of(at_steps([&](double h) { return 3 * std::pow(h, p); }), {0, 0});
    EXPECT_EQ(found.kind, Kind::converges) << p;
    EXPECT_NEAR(found.order, p, 1e-12);  // rounding of logarithms
    EXPECT_NEAR(found.order_error, 0, 1e-12);
    EXPECT_DOUBLE_EQ(found.coarsest, 3 * std::pow(1 / 60.0, p));
    EXPECT_DOUBLE_EQ(found.finest, 3 * std::pow(1 / 16000.0, p));
    EXPECT_EQ(found.largest, found.coarsest);
  }
}

TEST(Convergence, ScatterGoesIntoTheError) {
  // ln error = 2 ln h ± 0.3 on steps that halve: x = −2 … 2 in ln 2, residuals r about the line. By
  // hand: Σ x r = 0.3 (−2 + 1 + 0 + 1 − 2)… with signs + − + − + it is 0, so the order stays 2;
  // the mean residual is 0.06, χ² = 0.09·5 − 5·0.06² = 0.432, σ_p = √(0.432/3/10)/ln 2.
  std::vector<double> knobs, errors;
  for (int k = 0; k < 5; ++k) {
    knobs.push_back(std::exp2(-k));
    errors.push_back(std::exp2(-2 * k) * std::exp(k % 2 == 0 ? 0.3 : -0.3));
  }
  const Convergence found = of(errors, {0, 0}, knobs);
  EXPECT_EQ(found.kind, Kind::converges);
  EXPECT_NEAR(found.order, 2, 1e-12);
  EXPECT_NEAR(found.order_error, std::sqrt(0.432 / 30) / std::log(2), 1e-12);
}

TEST(Convergence, FallsToTheNoiseAndStaysThere) {
  const ErrorFloor floor{1e-5, 0};
  const Convergence found = of({1e-2, 2.5e-3, 6e-4, 8e-6, 9e-6}, floor);
  EXPECT_EQ(found.kind, Kind::converges);
  // Through the three above the noise: nearly order 1.
  EXPECT_NEAR(found.order, 1, 0.05);
  // All of it at once, and only one point tells: no order.
  const Convergence at_once = of({1e-2, 1e-6, 2e-6, 1e-6, 0}, floor);
  EXPECT_EQ(at_once.kind, Kind::converges);
  EXPECT_TRUE(std::isnan(at_once.order));
}

TEST(Convergence, StopsFallingAboveTheNoise) {
  // The order of the coarse half does not help.
  const Convergence found = of(at_steps([](double h) { return h + 3e-3; }));
  EXPECT_EQ(found.kind, Kind::does_not_converge);
  EXPECT_EQ(of({1e-1, 2e-2, 5e-3, 5.1e-3, 5.05e-3}).kind, Kind::does_not_converge);
  // The same plateau does not matter where the tolerance is 6.
  EXPECT_EQ(of({1e-1, 2e-2, 5e-3, 5.1e-3, 5.05e-3}, {1e-9, 6e-3}).kind, Kind::converges);
}

TEST(Convergence, ConstantWithScatterDoesNotConverge) {
  // Bullet's default: e_eff is off by what its phase makes it.
  EXPECT_EQ(of({0.102, 0.135, 0.136, 0.135, 0.134}).kind, Kind::does_not_converge);
  EXPECT_EQ(of({0.14, 0.143, 0.12, 0.1, 0.13}).kind, Kind::does_not_converge);
  EXPECT_EQ(of({0.3, 0.05, 0.2, 0.02, 0.12}).kind, Kind::does_not_converge);
}

TEST(Convergence, AnOrderWithinTwoOfItsStandardErrorsIsNone) {
  // As in ScatterGoesIntoTheError: ln error = −k p ln 2 ± s has the order p and σ_p =
  // √(0.432/30)/ln 2 · s/0.3. The ends have the same sign, and so have those of the last three:
  // only σ_p tells.
  for (const double s : {0.3, 1.2}) {
    const double sigma = std::sqrt(0.432 / 30) / std::log(2) * s / 0.3;
    for (const double share : {1.6, 1.9, 2.1, 3.0}) {
      const double p = share * sigma;
      if (p <= 0.26) continue;  // no order at all
      std::vector<double> knobs, errors;
      for (int k = 0; k < 5; ++k) {
        knobs.push_back(std::exp2(-k));
        errors.push_back(std::exp2(-k * p) * std::exp(k % 2 == 0 ? s : -s));
      }
      EXPECT_EQ(of(errors, {0, 0}, knobs).kind,
                share > 2 ? Kind::converges : Kind::does_not_converge)
          << s << ' ' << share;
    }
  }
}

TEST(Convergence, GrowthDoesNotConverge) {
  EXPECT_EQ(of(at_steps([](double h) { return 1e-6 / h; })).kind, Kind::does_not_converge);
  // Nor where it first falls: rounding that adds up.
  const Convergence found = of({1e-2, 1e-3, 1e-4, 4e-4, 1.6e-3}, {1e-5, 0});
  EXPECT_EQ(found.kind, Kind::does_not_converge);
  // Also from below the noise.
  EXPECT_EQ(of({1e-7, 1e-6, 1e-6, 4e-5, 2e-4}, {1e-5, 0}).kind, Kind::does_not_converge);
}

TEST(Convergence, ZerosAndNoiseAreExact) {
  EXPECT_EQ(of({0, 0, 0, 0, 0}, {0, 0}).kind, Kind::exact);
  const Convergence found = of({3e-10, 9e-10, 1e-12, 0, 8e-10});
  EXPECT_EQ(found.kind, Kind::exact);
  EXPECT_EQ(found.largest, 9e-10);
  EXPECT_TRUE(std::isnan(found.order));
  // A single point can be exact too: events have no knob.
  EXPECT_EQ(of({1e-15}, {1e-11, 0}, {0}).kind, Kind::exact);
}

TEST(Convergence, ANegligiblePlateauIsExactAndAFallThereStillFalls) {
  const ErrorFloor floor{1e-9, 5e-6};
  EXPECT_EQ(of({3e-7, 2.9e-7, 3.1e-7, 3e-7, 3e-7}, floor).kind, Kind::exact);
  const Convergence falling = of(at_steps([](double h) { return 2e-5 * h; }), floor);
  EXPECT_EQ(falling.kind, Kind::converges);
  EXPECT_NEAR(falling.order, 1, 1e-12);
}

TEST(Convergence, TooFewPointsTellNothing) {
  EXPECT_EQ(of({}).kind, Kind::unknown);
  EXPECT_EQ(of({0.1}).kind, Kind::unknown);
  EXPECT_EQ(of({0.1, 0.01}).kind, Kind::unknown);
  EXPECT_EQ(of({0.1, kNotObserved, kNotObserved, 0.01}).kind, Kind::unknown);
  EXPECT_EQ(of({0.1, 0.01}).finest, 0.01);
  EXPECT_EQ(of({1e-7, 3e-7}, {1e-9, 5e-6}).kind, Kind::exact);
}

TEST(Convergence, WhatIsNotThereIsLeftOut) {
  const Convergence found =
      of({kNotObserved, 1 / 240.0, 1e-3, kNotObserved, 1 / 16000.0}, {1e-9, 0});
  EXPECT_EQ(found.kind, Kind::converges);
  EXPECT_NEAR(found.order, 1, 1e-12);
  EXPECT_DOUBLE_EQ(found.coarsest, 1 / 240.0);
}

TEST(Convergence, InWords) {
  Convergence found;
  found.kind = Kind::converges;
  EXPECT_EQ(words_of(found), "converges at once");
  found.order = 1.004;
  EXPECT_EQ(words_of(found), "order 1.00");
  found.order_error = 0.018;
  EXPECT_EQ(words_of(found), "order 1.00 ± 0.02");
  found.kind = Kind::does_not_converge;
  EXPECT_EQ(words_of(found), "does not converge");
  found.kind = Kind::exact;
  found.largest = 3.1e-7;
  EXPECT_EQ(words_of(found), "exact to 3e-07");
  EXPECT_EQ(words_of({}), "too few points tell");
}

}  // namespace
}  // namespace slipcheck
