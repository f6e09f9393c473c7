#include "convert/combine_rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace slipcheck {
namespace {

using enum CombineRule;

TEST(CombineRules, AreTheirFormulas) {
  EXPECT_NEAR(combined(product, 0.5, 0.8), 0.4, 1e-15);
  EXPECT_EQ(combined(minimum, 0.5, 0.8), 0.5);
  EXPECT_EQ(combined(maximum, 0.5, 0.8), 0.8);
  EXPECT_NEAR(combined(average, 0.5, 0.8), 0.65, 1e-15);
  EXPECT_NEAR(combined(geometric_mean, 0.2, 0.8), 0.4, 1e-15);
  EXPECT_NEAR(combined(harmonic_mean, 0.2, 0.8), 0.32, 1e-15);
  EXPECT_EQ(combined(harmonic_mean, 0, 0), 0);
}

TEST(CombineRules, TheOtherBodysCoefficientGivesThePairs) {
  for (const CombineRule rule : {product, minimum, maximum, average, geometric_mean, harmonic_mean})
    for (const double own : {0.1, 0.3, 0.9})
      for (const double pair : {0.0, 0.15, 0.3, 0.5})
        if (const auto other = other_of_pair(rule, own, pair)) {
          EXPECT_GE(*other, 0);
          EXPECT_NEAR(combined(rule, own, *other), pair, 1e-15);
        }
}

TEST(CombineRules, SomePairsCannotBeHad) {
  EXPECT_FALSE(other_of_pair(minimum, 0.3, 0.5));
  EXPECT_FALSE(other_of_pair(maximum, 0.5, 0.3));
  EXPECT_FALSE(other_of_pair(average, 0.7, 0.3));
  EXPECT_FALSE(other_of_pair(harmonic_mean, 0.2, 0.4));
  EXPECT_FALSE(other_of_pair(product, 0, 0.4));
}

TEST(CombineRules, BothAlikeGiveThePairs) {
  for (const CombineRule rule :
       {product, minimum, maximum, average, geometric_mean, harmonic_mean}) {
    const double both = both_of_pair(rule, 0.3);
    EXPECT_NEAR(combined(rule, both, both), 0.3, 1e-15);
  }
}

TEST(CombineRules, EnginesAreSorted) {
  EXPECT_TRUE(std::ranges::is_sorted(engine_rules(), {}, &EngineRules::engine));
}

}  // namespace
}  // namespace slipcheck
