#include "studies/precision/pareto.h"

#include <gtest/gtest.h>

#include <limits>

namespace slipcheck {
namespace {

using Front = std::vector<bool>;

TEST(Pareto, ByHand) {
  // 0 is the cheapest, 3 the best; 1 lies between; 2 is dearer and worse than 1.
  const std::vector<double> cost = {1, 2, 3, 4}, error = {0.5, 0.1, 0.2, 0.01};
  EXPECT_EQ(pareto_front(cost, error), (Front{true, true, false, true}));
}

TEST(Pareto, EqualPointsAreOnItTogether) {
  const std::vector<double> cost = {2, 1, 2, 1}, error = {0.1, 0.3, 0.1, 0.3};
  EXPECT_EQ(pareto_front(cost, error), (Front{true, true, true, true}));
}

TEST(Pareto, NoBetterForMoreIsNot) {
  const std::vector<double> cost = {1, 2, 1}, error = {0.1, 0.1, 0.2};
  EXPECT_EQ(pareto_front(cost, error), (Front{true, false, false}));
}

TEST(Pareto, WhatIsNotFiniteIsNever) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const std::vector<double> cost = {nan, 1, 0.5, 3}, error = {0, nan, infinite, 7};
  EXPECT_EQ(pareto_front(cost, error), (Front{false, false, false, true}));
  EXPECT_TRUE(pareto_front({}, {}).empty());
}

}  // namespace
}  // namespace slipcheck
