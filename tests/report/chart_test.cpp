#include "report/charts/chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "report/charts/gnuplot_script.h"
#include "report/charts/heat_colours.h"
#include "report/charts/plot_text.h"
#include "report/files/csv.h"
#include "report/rows/outcome_look.h"
#include "text_search.h"

namespace slipcheck {
namespace {

using testing::contains;
using testing::count;

Panel one_curve(std::vector<double> x, std::vector<double> y) {
  return {"a < b", {"x", false, 0, 10}, {"y", false, 0, 10}, {{"curve", {}, x, y}}};
}

/// The first block of a chart's data.
std::string first_block(const Chart& chart) {
  const std::string data = gnuplot_script(chart).data + "\n";
  return data.substr(0, data.find("\n\n"));
}

TEST(PlotText, AFormulaRaisesAndLowers) {
  EXPECT_EQ(gnuplot_text("t_{col}/t^s"), "'t_{col}/t^{s}'");
  EXPECT_EQ(gnuplot_text("10^{−3} ζ_0"), "'10^{−3} ζ_{0}'");
  EXPECT_EQ(plain_plot_text("t_{col}/t^s"), "t_col/t^s");
  EXPECT_EQ(html_plot_text("v_{rel} t^s<ε^N"), "v<sub>rel</sub> t<sup>s</sup>&lt;ε<sup>N</sup>");
  EXPECT_LT(plot_text_width("10^{−3}"), plot_text_width("10−3"));
}

TEST(PlotText, ALiteralIsNoFormula) {
  const std::string name = "a_b^c{d}\\e";
  EXPECT_EQ(html_plot_text(plot_literal(name)), name);
  EXPECT_EQ(plain_plot_text(plot_literal(name)), name);
  EXPECT_EQ(gnuplot_text(plot_literal(name)), "'a\\_b\\^c\\{d\\}\\\\e'");
}

TEST(PlotText, QuotesAndKeepsNoControls) {
  EXPECT_EQ(gnuplot_text("it's `date` \"x\"\n\x01 @a & ~b"),
            "'it''s `date` \"x\" \uFFFD \\@a \\& \\~b'");
}

TEST(ChartRange, OfTheDataLeavesOutWhatCannotBeShown) {
  const AxisRange linear = x_range({"", {}, {}, {{"", {}, {1, NAN, 3, INFINITY}, {1, 1, 1, 1}}}});
  EXPECT_DOUBLE_EQ(linear.low, 1 - 0.04 * 2);
  EXPECT_DOUBLE_EQ(linear.high, 3 + 0.04 * 2);
  const AxisRange logarithmic =
      x_range({"", {"x", true}, {}, {{"", {}, {0, -1, 0.1, 10}, {1, 1, 1, 1}}}});
  EXPECT_NEAR(logarithmic.low, std::pow(10, -1 - 0.04 * 2), 1e-15);
  EXPECT_NEAR(logarithmic.high, std::pow(10, 1 + 0.04 * 2), 1e-13);
  const AxisRange half = x_range({"", {"x", false, 0}, {}, {{"", {}, {1, 3}, {1, 1}}}});
  EXPECT_EQ(half.low, 0);
  EXPECT_DOUBLE_EQ(half.high, 3 + 0.04 * 2);
  // What is not shown along x says nothing of y.
  EXPECT_LT(y_range({"", {"x", false, 0, 2}, {}, {{"", {}, {1, 3}, {1, 100}}}}).high, 2);
}

TEST(ChartRange, EveryOneHasAWidth) {
  for (const bool logarithmic : {false, true})
    for (const std::vector<double>& values :
         {std::vector<double>{}, std::vector<double>{2, 2}, std::vector<double>{0}}) {
      const AxisRange range = x_range({"", {"x", logarithmic}, {}, {{"", {}, values, values}}});
      EXPECT_GT(range.high, range.low);
      EXPECT_TRUE(std::isfinite(range.fraction(2, logarithmic)));
    }
}

TEST(ChartRange, FractionsAreEvenInTheLogarithm) {
  const AxisRange decades{0.1, 10};
  EXPECT_DOUBLE_EQ(decades.fraction(0.1, true), 0);
  EXPECT_DOUBLE_EQ(decades.fraction(1, true), 0.5);
  EXPECT_TRUE(std::isnan(decades.fraction(0, true)));
  EXPECT_TRUE(std::isnan(decades.fraction(-1, true)));
  const AxisRange even{-1, 1};
  EXPECT_DOUBLE_EQ(even.fraction(0.5, false), 0.75);
}

TEST(ChartRange, CellsFillTheAxes) {
  EXPECT_EQ(cell_borders({1, 2, 3}, false), (std::vector<double>{0.5, 1.5, 2.5, 3.5}));
  const std::vector<double> borders = cell_borders({1, 10}, true);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(borders[k], std::pow(10, static_cast<double>(k) - 0.5), 1e-12);
  EXPECT_EQ(cell_borders({4}, false), (std::vector<double>{3.5, 4.5}));
  Panel map;
  map.colours = ColourMap{{1, 2, 3}, {1, 10}, std::vector<double>(6, 0.0), "z"};
  map.y.logarithmic = true;
  EXPECT_EQ(x_range(map), (AxisRange{0.5, 3.5}));
  Panel rows;
  rows.y.names = {"a", "b"};
  EXPECT_EQ(y_range(rows), (AxisRange{-0.5, 1.5}));
}

TEST(OutcomeLook, TellsAllApartWithoutColours) {
  std::set<std::string> letters, words, fills;
  for (std::size_t k = 0; k < kOutcomes; ++k) {
    const OutcomeLook& look = look_of(static_cast<Outcome>(k));
    letters.insert(look.letter);
    words.insert(look.brief);
    fills.insert(look.fill);
  }
  EXPECT_EQ(letters.size(), kOutcomes);
  EXPECT_EQ(words.size(), kOutcomes);
  EXPECT_EQ(fills.size(), kOutcomes);
}

TEST(RunLook, TellsTwelveApartWithoutColours) {
  std::set<std::pair<Line, Marker>> looks;
  for (std::size_t k = 0; k < 12; ++k) looks.emplace(look_of_run(k).line, look_of_run(k).marker);
  EXPECT_EQ(looks.size(), 12u);
}

TEST(GnuplotScript, WhatIsNotANumberLeavesAGap) {
  const Chart chart{"c", "", "", {one_curve({0, 1, 2}, {1, NAN, INFINITY})}};
  EXPECT_EQ(first_block(chart), "# curve\n0 1\n1 NaN\n2 NaN");
}

TEST(GnuplotScript, WhatIsBeyondIsAtTheEdgeWhereThatIsAskedFor) {
  Panel panel = one_curve({-1, 5}, {5, 1e300});
  panel.curves[0].at_edge = true;
  EXPECT_EQ(first_block({"c", "", "", {panel}}), "# curve\n0 5\n5 10");
}

TEST(GnuplotScript, MarkersAreThoseAskedFor) {
  Panel panel = one_curve({0, 1, 2, 3, 4}, {0, 1, 2, 3, 4});
  panel.curves[0].look = {Ink::blue, Line::none, Marker::circle};
  panel.curves[0].marker_every = 2;
  panel.curves[0].marker_first = 1;
  EXPECT_EQ(first_block({"c", "", "", {panel}}), "# curve\n1 1\n3 3");
}

TEST(GnuplotScript, OneLegendForAllPanels) {
  Panel cells;
  cells.looks = {{"good", "A", "#0072b2", "#ffffff"}, {"absent", "B", "#000000", "#ffffff"}};
  cells.cells = {{0, 1, 0, 1, 0, ""}};
  const std::string script =
      gnuplot_script({"c", "", "", {one_curve({0, 1}, {0, 1}), one_curve({0, 1}, {1, 0}), cells}})
          .script;
  EXPECT_EQ(count(script, "set label 'curve'"), 1u);
  EXPECT_EQ(count(script, "set label 'good'"), 1u);
  EXPECT_FALSE(contains(script, "set label 'absent'"));
}

TEST(GnuplotScript, EqualNeighboursOfAMapAreOneRectangle) {
  Panel map;
  map.colours = ColourMap{{1, 2}, {1, 2}, {-1, 1, 0.3, 0.3}, "z"};
  // The lower row, then the upper; the middles of the first, the last and the 42nd of 64 levels.
  EXPECT_EQ(first_block({"c", "", "", {map}}),
            "# z\n0.5 0.5 0.5 1.5 0.5 1.5 -0.984375\n1.5 0.5 1.5 2.5 0.5 1.5 0.984375\n"
            "0.5 1.5 0.5 2.5 1.5 2.5 0.296875");
  map.colours->z[0] = NAN;
  EXPECT_FALSE(contains(first_block({"c", "", "", {map}}), "-0.98"));
}

TEST(HeatColours, GoFromVermilionToBlueOrBack) {
  EXPECT_EQ(heat_level(-3), 0);
  EXPECT_EQ(heat_level(3), 63);
  EXPECT_DOUBLE_EQ(heat_share(0), 0.5 / 64);
  EXPECT_TRUE(heat_palette(false).starts_with("0 '#a03c00'"));
  EXPECT_TRUE(heat_palette(false).ends_with("'#005492'"));
  EXPECT_TRUE(heat_palette(true).starts_with("0 '#005492'"));
}

TEST(Csv, HeaderThenARowForEachIndex) {
  Table table;
  table.add("v [cm/s]", {1, 0.1, 1.0 / 3});
  table.add("e, \"e_n\"", {-1e-20, NAN, INFINITY});
  table.add("short", {7});
  EXPECT_EQ(csv_text(table),
            "v [cm/s],\"e, \"\"e_n\"\"\",short\n1,-1e-20,7\n0.1,,\n0.333333333333,,\n");
  EXPECT_EQ(table["short"], std::vector<double>{7});
}

}  // namespace
}  // namespace slipcheck
