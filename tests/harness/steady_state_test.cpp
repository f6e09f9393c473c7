#include "harness/observe/steady_state.h"

#include <gtest/gtest.h>

#include <cmath>

#include "series.h"

namespace slipcheck {
namespace {

constexpr int kSeries = 200;

/// AR(1) noise of variance 1 on amplitude · e^(−k/time).
std::vector<double> relaxing(std::size_t n, double amplitude, double time, double rho,
                             std::uint64_t seed) {
  auto x = test::correlated(n, rho, seed);
  for (std::size_t k = 0; k < n; ++k) x[k] += amplitude * std::exp(-static_cast<double>(k) / time);
  return x;
}

TEST(SteadyState, DropsARelaxationAndLittleMore) {
  int reached = 0;
  double left = 0, dropped = 0;
  for (std::uint64_t seed = 1; seed <= kSeries; ++seed) {
    const std::vector<std::vector<double>> series = {relaxing(2000, 20, 50, 0.5, seed)};
    const SteadyState state = steady_state(series);
    reached += state.reached;
    const auto d = static_cast<double>(state.dropped);
    dropped += d / kSeries;
    // What is left of the relaxation in the mean of the rest: Σ e^(−k/50) = 50 e^(−d/50).
    left += 20 * 50 * std::exp(-d / 50) / (2000 - d) / kSeries;
  }
  EXPECT_GE(reached, 0.97 * kSeries);
  // Less than the statistical error of the mean that is left, √(3/1850) = 0.040.
  EXPECT_LT(left, 0.04);
  // It takes 150 samples until the rest, 20 e^(−3) = 1, is like the noise; 300 until 0.05.
  EXPECT_GT(dropped, 100);
  EXPECT_LT(dropped, 400);
}

TEST(SteadyState, AStationarySeriesLosesLittle) {
  int reached = 0;
  double dropped = 0;
  for (std::uint64_t seed = 1; seed <= kSeries; ++seed) {
    const std::vector<std::vector<double>> series = {test::correlated(2000, 0.5, seed)};
    const SteadyState state = steady_state(series);
    reached += state.reached;
    dropped += static_cast<double>(state.dropped) / kSeries;
  }
  // Three standard errors: 0.3 % false alarms, and what a truncation at the limit adds.
  EXPECT_GE(reached, 0.95 * kSeries);
  EXPECT_LT(dropped, 0.1 * 2000);
}

TEST(SteadyState, ADriftIsNotSteady) {
  // The halves of what is left differ by a quarter of the drift at least, 1.5 to 2.5 here; their
  // errors are √(3/500) = 0.08.
  for (std::uint64_t seed = 1; seed <= kSeries; ++seed) {
    auto x = test::correlated(2000, 0.5, seed);
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += 6 * static_cast<double>(k) / 2000;
    const std::vector<std::vector<double>> series = {x};
    EXPECT_FALSE(steady_state(series).reached) << seed;
    EXPECT_FALSE(is_steady(x)) << seed;
  }
}

TEST(SteadyState, ARelaxationLongerThanTheSeriesIsNotSteady) {
  for (std::uint64_t seed = 1; seed <= kSeries; ++seed) {
    const std::vector<std::vector<double>> series = {relaxing(1000, 20, 1000, 0.5, seed)};
    EXPECT_FALSE(steady_state(series).reached) << seed;
  }
}

TEST(SteadyState, OfSeveralTheSlowestDecides) {
  const auto quick = relaxing(2000, 20, 5, 0, 1), slow = relaxing(2000, 20, 80, 0, 2);
  const std::vector<std::vector<double>> both = {slow, quick};
  EXPECT_GT(mser5_truncation(slow), mser5_truncation(quick));
  EXPECT_EQ(steady_state(both).dropped, mser5_truncation(slow));
  std::vector<double> drift(2000);
  for (std::size_t k = 0; k < drift.size(); ++k) drift[k] = static_cast<double>(k);
  const std::vector<std::vector<double>> with_drift = {quick, drift};
  EXPECT_FALSE(steady_state(with_drift).reached);
}

TEST(SteadyState, AStepIsCutOffWhereItIs) {
  // 10 for 100 samples, then alternating 0 and 1: every batch of the steady part is alike to 0.2.
  std::vector<double> x(1000);
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = k < 100 ? 10 : static_cast<double>(k % 2);
  EXPECT_EQ(mser5_truncation(x), 100u);
  EXPECT_TRUE(steady_state(std::vector<std::vector<double>>{x}).reached);
  EXPECT_FALSE(is_steady(x));
}

TEST(SteadyState, TooShortIsNotReached) {
  const std::vector<std::vector<double>> series = {test::correlated(60, 0, 1)};
  EXPECT_FALSE(steady_state(series).reached);
  EXPECT_FALSE(steady_state({}).reached);
  EXPECT_FALSE(steady_state(std::vector<std::vector<double>>{{}}).reached);
}

TEST(SteadyState, WhatRepeatsItselfIsSteady) {
  EXPECT_TRUE(is_steady(std::vector<double>(100, 0.1)));
  std::vector<double> cycle(999);
  for (std::size_t k = 0; k < cycle.size(); ++k) cycle[k] = static_cast<double>(k % 3);
  EXPECT_TRUE(is_steady(cycle));
}

}  // namespace
}  // namespace slipcheck
