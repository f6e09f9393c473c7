#include "studies/stability/limit_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace slipcheck {
namespace {

using GoodEnd = LimitRange::GoodEnd;

/// Runs a search to its end; `count` is the number of trials.
FoundLimit search(const LimitRange& range, const std::function<bool(double)>& is_good,
                  std::size_t* count = nullptr) {
  LimitSearch search(range);
  const std::size_t most = search.most_trials_left();
  std::size_t tried = 0;
  while (!search.is_done()) {
    std::vector<Trial> trials;
    for (const double value : search.wanted()) {
      EXPECT_GE(value, range.low);
      EXPECT_LE(value, range.high);
      const bool good = is_good(value);
      trials.push_back({good, good ? Outcome::accurate : Outcome::exploded, good ? "" : "bang"});
    }
    tried += trials.size();
    search.tell(trials);
    EXPECT_LE(tried + search.most_trials_left(), most);
  }
  EXPECT_EQ(search.most_trials_left(), 0u);
  if (count) *count = tried;
  return search.found();
}

TEST(LimitSearch, EnclosesASharpBorderFromEitherSide) {
  for (const double border : {1.3e-5, 0.02, 0.0999, 0.7}) {
    const FoundLimit largest =
        search({1e-5, 1, GoodEnd::low, 3, 1.01}, [&](double value) { return value <= border; });
    ASSERT_TRUE(largest.good && largest.bad) << border;
    EXPECT_LE(*largest.good, border);
    EXPECT_GT(*largest.bad, border);
    EXPECT_LE(*largest.bad / *largest.good, 1.01);
    EXPECT_TRUE(largest.islands.empty() && largest.strays.empty());
    EXPECT_EQ(largest.beyond.outcome, Outcome::exploded);
    EXPECT_EQ(largest.beyond.why, "bang");

    const FoundLimit least =
        search({1e-5, 1, GoodEnd::high, 3, 1.01}, [&](double value) { return value >= border; });
    ASSERT_TRUE(least.good && least.bad) << border;
    EXPECT_GE(*least.good, border);
    EXPECT_LT(*least.bad, border);
    EXPECT_LE(*least.good / *least.bad, 1.01);
  }
}

TEST(LimitSearch, TakesTheTrialsThatThirdsNeed) {
  // 6 decades by 3 are 19 values. An interval of 10^(1/3) = 1.01^77 takes 4 cuts into three.
  std::size_t count = 0;
  search(
      {1e-6, 1, GoodEnd::low, 3, 1.01}, [](double value) { return value < 1e-3 * 1.5; }, &count);
  EXPECT_EQ(count, 19u + 2 * 4);
}

TEST(LimitSearch, TheWholeRangeGoodOrBad) {
  const FoundLimit all = search({1, 100, GoodEnd::low}, [](double) { return true; });
  EXPECT_EQ(all.good, 100);
  EXPECT_FALSE(all.bad);
  EXPECT_TRUE(all.islands.empty());
  const FoundLimit none = search({1, 100, GoodEnd::high}, [](double) { return false; });
  EXPECT_FALSE(none.good);
  EXPECT_EQ(none.bad, 100);  // the good end: what should be the easiest
  EXPECT_EQ(none.beyond.outcome, Outcome::exploded);
  EXPECT_TRUE(none.islands.empty() && none.refusal.empty());
}

/// The scan's values are 1, 10, …, 1e6.
const LimitRange kDecades{1, 1e6, GoodEnd::low, 1, 1.1};

TEST(LimitSearch, ABadStretchNearTheGoodEndIsAnIsland) {
  const FoundLimit found =
      search(kDecades, [](double value) { return value < 3e4 && !(value > 5 && value < 50); });
  ASSERT_TRUE(found.good && found.bad);
  EXPECT_LE(*found.good, 3e4);
  EXPECT_GE(*found.bad, 3e4);
  ASSERT_EQ(found.islands.size(), 1u);
  EXPECT_NEAR(found.islands[0], 10, 1e-12);
  EXPECT_TRUE(found.strays.empty());
}

TEST(LimitSearch, AHoleEndsTheGoodRegionWhereThatIsTheLongerPart) {
  // Good at 1, 10, 100, 1e3 and at 1e5, 1e6.
  const FoundLimit found =
      search(kDecades, [](double value) { return value < 2e3 || value > 5e4; });
  EXPECT_LE(*found.good, 2e3);
  EXPECT_GT(*found.bad, 2e3);
  EXPECT_TRUE(found.islands.empty());
  ASSERT_EQ(found.strays.size(), 2u);
  EXPECT_NEAR(found.strays[0], 1e5, 1e-7);
  EXPECT_NEAR(found.strays[1], 1e6, 1e-6);
}

TEST(LimitSearch, OneLuckyValueIsNoLimit) {
  const FoundLimit found =
      search(kDecades, [](double value) { return value < 200 || (value > 9e4 && value < 1.1e5); });
  EXPECT_LE(*found.good, 200);
  ASSERT_EQ(found.strays.size(), 1u);
  EXPECT_NEAR(found.strays[0], 1e5, 1e-7);
}

TEST(LimitSearch, OfEquallyLongRegionsTheOneAtTheGoodEndCounts) {
  const FoundLimit found = search(kDecades, [](double value) { return value < 20 || value > 5e4; });
  EXPECT_LE(*found.good, 20);
  EXPECT_EQ(found.strays.size(), 2u);
}

TEST(LimitSearch, WithinASectionTheFirstBadValueCounts) {
  // The scan has 1 good and 10 bad; the first thirds are 2.15 bad and 4.64 good.
  const FoundLimit found = search({1, 10, GoodEnd::low, 1, 1.1}, [](double value) {
    return value < 1.5 || (value > 4 && value < 5);
  });
  EXPECT_LE(*found.good, 1.5);
  EXPECT_GE(*found.bad, 1.5);
  EXPECT_LE(*found.bad / *found.good, 1.1);
  ASSERT_EQ(found.strays.size(), 1u);
  EXPECT_NEAR(found.strays[0], std::pow(10, 2.0 / 3), 1e-12);
}

TEST(LimitSearch, OnlyRefusalsHaveNoAnswer) {
  LimitSearch refused(kDecades), partly(kDecades);
  std::vector<Trial> trials(7, {false, Outcome::refused, "not installed"});
  refused.tell(trials);
  EXPECT_TRUE(refused.is_done());
  EXPECT_EQ(refused.found().refusal, "not installed");
  EXPECT_FALSE(refused.found().good);

  trials[0] = trials[1] = {true, Outcome::accurate, ""};
  partly.tell(trials);
  EXPECT_FALSE(partly.is_done());
  EXPECT_EQ(partly.found().refusal, "");
  EXPECT_EQ(partly.found().beyond.outcome, Outcome::refused);
  EXPECT_EQ(partly.found().beyond.why, "not installed");
}

TEST(LimitSearch, WhatIsFoundMeanwhileIsTheScans) {
  LimitSearch search(kDecades);
  EXPECT_FALSE(search.found().good || search.found().bad);
  std::vector<Trial> trials(7, {false, Outcome::crashed, "gone"});
  trials[0].good = true;
  search.tell(trials);
  EXPECT_EQ(search.found().good, 1);
  EXPECT_NEAR(*search.found().bad, 10, 1e-12);
}

}  // namespace
}  // namespace slipcheck
