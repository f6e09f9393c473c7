#include "report/rows/store_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../support/refusal.h"
#include "report/charts/store_charts.h"

namespace slipcheck {
namespace {

/// Runs over a number and a word, and the outcome that this gives, with a tolerance of 0.005.
template <class Outcome>
QueryResult runs_of(const std::vector<double>& numbers, const std::vector<std::string>& words,
                    const Outcome& outcome) {
  QueryResult result;
  result.columns = {{"rate", "Hz"}, {"engine", ""}, {"i-j.error", ""}, {"i-j.tolerance", ""}};
  for (const double number : numbers)
    for (const std::string& word : words)
      result.rows.push_back({number, word, outcome(number, word), 0.005});
  result.found = result.rows.size();
  return result;
}

/// Four outcomes 1, 3 | 7, 9: SS_within = 2 + 2 of n − k = 2, SS_total = 40 of n − 1 = 3, so
/// ε² = 1 − 2/(40/3) = 0.85; of the other parameter's halves 1, 7 | 3, 9 they are 36 and 40,
/// 1 − 18/(40/3) < 0, which is none.
TEST(StoreView, SaysWhatTellsMost) {
  const auto outcome = [](double rate, const std::string& engine) -> SqliteValue {
    return 0.005 * ((rate == 60 ? 1.0 : 7.0) + (engine == "b" ? 2.0 : 0.0));
  };
  QueryResult result = runs_of({60, 240}, {"a", "b"}, outcome);
  const StoreView view = view_of("pair", result, 2);
  EXPECT_TRUE(view.in_tolerances);
  EXPECT_FALSE(view.logarithmic);
  EXPECT_EQ(view.outcome, "i-j.error [tolerances]");
  ASSERT_EQ(view.parameters.size(), 2u);
  EXPECT_EQ(view.parameters[0].name, "rate [Hz]");
  EXPECT_NEAR(view.parameters[0].effect, 0.85, 1e-14);  // rounding
  EXPECT_EQ(view.parameters[1].effect, 0);
  EXPECT_EQ(view.parameters[1].levels, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(store_finding(view),
            "4 runs of pair; i-j.error [tolerances]: 5 in the median, 9 at most, within one in 1 "
            "of 4. Of its scatter 85 % goes with rate [Hz].");
  const TextTable table = effects_table(view);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0][6].text, "60");
  EXPECT_EQ(table.rows[0][8].text, "240");
  EXPECT_EQ(table.rows[0][7].value, 8);
}

/// What does not show the outcome is counted, and no number of it is made up.
TEST(StoreView, CountsRunsWithout) {
  const auto outcome = [](double rate, const std::string& engine) -> SqliteValue {
    if (engine == "b" && rate == 60) return std::monostate();
    return rate * 1e-6;
  };
  QueryResult result = runs_of({60, 120, 240}, {"a", "b"}, outcome);
  const StoreView view = view_of("pair", result, 2);
  EXPECT_EQ(view.without, 1u);
  EXPECT_TRUE(std::isnan(view.values[1]));
  EXPECT_NE(store_finding(view).find("1 run without"), std::string::npos);
  const std::vector<Chart> charts = store_charts(view);
  ASSERT_EQ(charts.size(), 3u);
  const ColourMap& map = *charts[0].panels[0].colours;
  std::size_t empty = 0;
  for (const double z : map.z) empty += std::isnan(z) ? 1 : 0;
  EXPECT_EQ(empty, 1u);
  std::size_t lines = 0;
  for (const Curve& curve : charts[2].panels[0].curves)
    for (const double x : curve.x) lines += std::isnan(x) ? 1 : 0;
  EXPECT_EQ(lines, 5u);
}

/// Zeros of a quantity over decades stand at the least that is more; 17 numbers lie in twelfths.
TEST(StoreView, DecadesAndRanges) {
  std::vector<double> rates;
  for (int k = 0; k <= 16; ++k) rates.push_back(60 * std::pow(2, k / 2.0));
  QueryResult result = runs_of(rates, {"a"}, [&](double rate, const std::string&) -> SqliteValue {
    return rate == 60 ? 0.0 : 0.005 * rate * rate;
  });
  const StoreView view = view_of("pair", result, 2);
  EXPECT_TRUE(view.logarithmic);
  EXPECT_EQ(view.values[0], view.values[1]);
  ASSERT_EQ(view.parameters.size(), 1u);  // one engine is no parameter
  const SweptParameter& rate = view.parameters[0];
  EXPECT_TRUE(rate.logarithmic);
  ASSERT_EQ(rate.levels.size(), 12u);
  EXPECT_EQ(rate.level.front(), 0u);
  EXPECT_EQ(rate.level.back(), 11u);
  EXPECT_EQ(rate.level[8], 6u);  // 960 Hz, the middle of 60 to 15360: the twelfth above it
  for (std::size_t k = 1; k < rate.level.size(); ++k) EXPECT_GE(rate.level[k], rate.level[k - 1]);
  EXPECT_GT(rate.effect, 0.9);  // it is nothing but the rate
}

TEST(StoreView, RefusesWhatHasNoNumber) {
  const auto nothing = [](double, const std::string&) -> SqliteValue { return std::monostate(); };
  const QueryResult result = runs_of({60, 240}, {"a"}, nothing);
  EXPECT_EQ(test::refusal_of<BadQuery>([&] { view_of("pair", result, 2); }),
            "must be a column with numbers in the runs that are asked for, got i-j.error");
  QueryResult none = result;
  none.rows.clear();
  EXPECT_EQ(test::refusal_of<BadQuery>([&] { view_of("pair", none, 2); }),
            "must find a run: these filters find none");
}

}  // namespace
}  // namespace slipcheck
