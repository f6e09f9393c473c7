#include "report/charts/plot_axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace slipcheck {
namespace {

std::vector<std::string> labels_of(const PlotAxis& axis) {
  std::vector<std::string> labels;
  for (const PlotAxis::Tick& tick : axis.ticks())
    if (!tick.label.empty()) labels.push_back(tick.label);
  return labels;
}

using Labels = std::vector<std::string>;

TEST(PlotAxis, RoundTicksAreFewRoundAndInside) {
  std::mt19937_64 random(1);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (int n = 0; n < 10000; ++n) {
    const double size = std::pow(10.0, 12 * uniform() - 6);
    const double low = size * (4 * uniform() - 2), high = low + size * (0.1 + uniform());
    const std::vector<double> ticks = round_ticks(low, high);
    ASSERT_GE(ticks.size(), 3u) << low << ", " << high;
    ASSERT_LE(ticks.size(), 8u) << low << ", " << high;
    const double step = ticks[1] - ticks[0];
    ASSERT_GE(ticks.front(), low - 1e-8 * step);
    ASSERT_LE(ticks.back(), high + 1e-8 * step);
    // None is left out at either end.
    ASSERT_LT(ticks.front() - low, step * (1 + 1e-8));
    ASSERT_LT(high - ticks.back(), step * (1 + 1e-8));
    const double leading = step / std::pow(10.0, std::floor(std::log10(step * (1 + 1e-9))));
    ASSERT_LT(std::min({std::abs(leading - 1), std::abs(leading - 2), std::abs(leading - 5)}), 1e-6)
        << step;
  }
}

TEST(PlotAxis, LinearLabelsHaveTheDecimalsTheirDistanceNeeds) {
  EXPECT_EQ(labels_of(PlotAxis({"x", false, 0, 1}, {})),
            (Labels{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(labels_of(PlotAxis({"x", false, -10, 5}, {})),
            (Labels{"−10", "−8", "−6", "−4", "−2", "0", "2", "4"}));
  EXPECT_EQ(labels_of(PlotAxis({"x", false, 0.895, 0.905}, {})),
            (Labels{"0.896", "0.898", "0.900", "0.902", "0.904"}));
  EXPECT_EQ(labels_of(PlotAxis({"x", false, 0, 4e6}, {})),
            (Labels{"0", "1e+06", "2e+06", "3e+06", "4e+06"}));
}

TEST(PlotAxis, LogarithmicLabelsArePowersOfTenWithMinorTicksBetween) {
  const PlotAxis decades({"v", true, 1e-3, 1e4}, {});
  EXPECT_EQ(labels_of(decades),
            (Labels{"10^{−3}", "0.01", "0.1", "1", "10", "100", "1000", "10^{4}"}));
  EXPECT_EQ(decades.ticks().size(), 7 * 9 + 1u);
  // Few decades leave room for 2 and 5, many for every second power alone.
  EXPECT_EQ(labels_of(PlotAxis({"v", true, 0.9, 21}, {})), (Labels{"1", "2", "5", "10", "20"}));
  EXPECT_EQ(labels_of(PlotAxis({"v", true, 1e-10, 1}, {})),
            (Labels{"10^{−10}", "10^{−8}", "10^{−6}", "10^{−4}", "0.01", "1"}));
}

TEST(PlotAxis, RangeOfTheDataLeavesOutWhatCannotBeShown) {
  const PlotAxis linear({"x"}, {1, NAN, 3, INFINITY});
  EXPECT_DOUBLE_EQ(linear.low(), 1 - 0.04 * 2);
  EXPECT_DOUBLE_EQ(linear.high(), 3 + 0.04 * 2);
  const PlotAxis logarithmic({"x", true}, {0, -1, 0.1, 10});
  EXPECT_NEAR(logarithmic.low(), std::pow(10, -1 - 0.04 * 2), 1e-15);
  EXPECT_NEAR(logarithmic.high(), std::pow(10, 1 + 0.04 * 2), 1e-13);
  const PlotAxis half({"x", false, 0}, {1, 3});
  EXPECT_EQ(half.low(), 0);
  EXPECT_DOUBLE_EQ(half.high(), 3 + 0.04 * 2);
}

TEST(PlotAxis, EveryRangeHasAWidth) {
  for (const bool logarithmic : {false, true})
    for (const std::vector<double>& values :
         {std::vector<double>{}, std::vector<double>{2, 2}, std::vector<double>{0}}) {
      const PlotAxis axis({"x", logarithmic}, values);
      EXPECT_GT(axis.high(), axis.low());
      EXPECT_TRUE(std::isfinite(axis.fraction(2)));
    }
}

TEST(PlotAxis, FractionsAreEvenInTheLogarithm) {
  const PlotAxis axis({"x", true, 0.1, 10}, {});
  EXPECT_DOUBLE_EQ(axis.fraction(0.1), 0);
  EXPECT_DOUBLE_EQ(axis.fraction(1), 0.5);
  EXPECT_DOUBLE_EQ(axis.fraction(10), 1);
  EXPECT_TRUE(std::isnan(axis.fraction(0)));
  EXPECT_TRUE(std::isnan(axis.fraction(-1)));
  EXPECT_DOUBLE_EQ(PlotAxis({"x", false, -1, 1}, {}).fraction(0.5), 0.75);
}

}  // namespace
}  // namespace slipcheck
