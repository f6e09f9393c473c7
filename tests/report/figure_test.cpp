#include "report/charts/figure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "report/charts/plot_text.h"
#include "report/files/csv.h"

namespace slipcheck {
namespace {

std::size_t count(const std::string& text, const std::string& piece) {
  std::size_t found = 0;
  for (auto at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++found;
  return found;
}

/// What stands between two pieces of a text.
std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const auto begin = text.find(before);
  if (begin == std::string::npos) return "not found";
  const auto first = begin + before.size();
  return text.substr(first, text.find(after, first) - first);
}

LineChart one_curve(std::vector<double> x, std::vector<double> y, Look look = {}) {
  LineChart chart;
  chart.title = "a < b";
  chart.x = {"x", false, 0, 10};
  chart.y = {"y", false, 0, 10};
  chart.curves.push_back({"curve", look, std::move(x), std::move(y)});
  return chart;
}

/// What the curve in the frame 0 … 100 by 0 … 100 px is drawn with.
std::string path_of(const LineChart& chart) {
  const std::string svg = line_chart_svg(chart, {0, 0, 100, 100}, "clip");
  return between(svg, "stroke-linejoin=\"round\">\n<path d=\"", "\"");
}

TEST(PlotText, RaisesAndLowersAndComesBackToTheLine) {
  EXPECT_EQ(plot_text("a<b"), "a&lt;b");
  EXPECT_EQ(plain_plot_text("t_{col}/t^s"), "t_col/t^s");
  EXPECT_EQ(html_plot_text("v_{rel} t^s<ε^N"), "v<sub>rel</sub> t<sup>s</sup>&lt;ε<sup>N</sup>");
  for (const char* text : {"u_i^f [cm/s]", "t^s", "10^{−3}", "e_{eff} = 1", "ζ_0^"}) {
    // The shifts, in units of the text's own size, add up to where the last piece stands.
    const std::string svg = plot_text(text);
    double height = 0;
    for (auto at = svg.find("dy=\""); at != std::string::npos; at = svg.find("dy=\"", at + 1)) {
      const bool is_small = between(svg.substr(at), "em\"", ">") == " font-size=\"72%\"";
      height += std::stod(svg.substr(at + 4)) * (is_small ? 0.72 : 1);
    }
    const bool ends_raised = std::string(text) == "t^s" || std::string(text) == "10^{−3}";
    EXPECT_NEAR(height, ends_raised ? -0.38 : 0, 0.002) << text;  // three digits a shift
  }
  EXPECT_LT(plot_text_width("10^{−3}"), plot_text_width("10−3"));
}

TEST(PlotText, ALiteralIsNoFormula) {
  const std::string name = "a_b^c{d}\\e";
  EXPECT_EQ(plot_text(plot_literal(name)), name);
  EXPECT_EQ(html_plot_text(plot_literal(name)), name);
  EXPECT_EQ(plain_plot_text(plot_literal(name)), name);
}

TEST(LineChart, PointsAreWhereTheAxesPutThem) {
  EXPECT_EQ(path_of(one_curve({0, 5, 10}, {0, 2.5, 10})), "M0.00 100.00L50.00 75.00L100.00 0.00");
}

TEST(LineChart, WhatIsNotANumberLeavesAGap) {
  EXPECT_EQ(path_of(one_curve({0, 1, 2, 3, 4}, {1, 1, NAN, 1, 1})),
            "M0.00 90.00L10.00 90.00M30.00 90.00L40.00 90.00");
  LineChart logarithmic = one_curve({1, 2, 3}, {1, 0, 10});
  logarithmic.y = {"y", true, 1, 10};
  EXPECT_EQ(path_of(logarithmic), "M10.00 100.00M30.00 0.00");
}

TEST(LineChart, WhatIsFarOutsideStaysNear) {
  // Renderers overflow on coordinates without bounds.
  EXPECT_EQ(path_of(one_curve({0, 10}, {0, 1e300})), "M0.00 100.00L100.00 -1900.00");
}

TEST(LineChart, MarkersAreThoseAskedForInsideTheFrame) {
  Look look{Ink::blue, Line::none, Marker::circle};
  LineChart chart = one_curve({0, 1, 2, 3, 4, 5}, {1, 2, 3, 40, 5, 6}, look);
  const auto markers = [&] {
    return count(line_chart_svg(chart, {0, 0, 100, 100}, "clip"), "a2.7 2.7 0 1 0 5.4");
  };
  EXPECT_EQ(markers(), 5u);
  chart.curves[0].marker_every = 2;
  EXPECT_EQ(markers(), 3u);
  chart.curves[0].marker_first = 1;
  EXPECT_EQ(markers(), 2u);
}

TEST(HeatMap, ColoursGoFromVermilionOverWhiteToBlue) {
  EXPECT_EQ(heat_colour(-3), heat_colour(0));
  EXPECT_EQ(heat_colour(3), heat_colour(1));
  EXPECT_EQ(heat_colour(0), "#a03c00");
  EXPECT_EQ(heat_colour(0.5), "#fafaf7");
  EXPECT_EQ(heat_colour(1), "#005492");
}

TEST(HeatMap, CellsFillTheFrameAndEqualNeighboursAreOne) {
  HeatMap map;
  map.x = {"x", true};
  map.y = {"y"};
  map.x_values = {1, 10};
  map.y_values = {1, 2};
  map.z = {-1, 1, 0.3, 0.3};  // the lower row, then the upper
  const std::string svg = heat_map_svg(map, {0, 0, 100, 100});
  EXPECT_NE(svg.find("M0.00 50.00h50.00v50.00h-50.00z"), std::string::npos);
  EXPECT_NE(svg.find("M50.00 50.00h50.00v50.00h-50.00z"), std::string::npos);
  EXPECT_NE(svg.find("M0.00 0.00h100.00v50.00h-100.00z"), std::string::npos);
  map.z[0] = NAN;
  EXPECT_EQ(heat_map_svg(map, {0, 0, 100, 100}).find("M0.00 50.00h50.00v50"), std::string::npos);
}

TEST(HeatMap, CanShowSmallAsBlueAndSayWhatIsMissing) {
  HeatMap map;
  map.x = {"x"};
  map.y = {"y"};
  map.x_values = {1, 2};
  map.y_values = {1, 2};
  map.z = {-1, 1, 0, NAN};
  map.missing = "none";
  const std::string cell = "\" d=\"M0.00 50.00h50.00";  // of the lowest value
  const auto colour = [&](const std::string& svg) { return svg.substr(svg.find(cell) - 7, 7); };
  std::string svg = heat_map_svg(map, {0, 0, 100, 100});
  EXPECT_EQ(colour(svg), heat_colour(0.5 / 64));  // the first of 64 levels
  EXPECT_EQ(count(svg, ">none</text>"), 1u);
  EXPECT_NE(svg.find("x=\"75.00\" y=\"29.00\">none"), std::string::npos);
  map.low_is_blue = true;
  svg = heat_map_svg(map, {0, 0, 100, 100});
  EXPECT_EQ(colour(svg), heat_colour(1 - 0.5 / 64));
}

TEST(Figure, OneLegendForAllPanelsAndIdsOfItsOwn) {
  FigureDrawing drawing;
  drawing.panels = {one_curve({0, 1}, {0, 1}), one_curve({0, 1}, {1, 0})};
  const std::string svg = figure_svg(drawing, "K5", "t^s & s", "what it shows");
  EXPECT_EQ(count(svg, ">curve</text>"), 1u);
  EXPECT_EQ(count(svg, "id=\"K5-plot-1\""), 1u);
  EXPECT_EQ(count(svg, "url(#K5-plot-2)"), 1u);
  EXPECT_NE(svg.find("<title id=\"K5-title\">t^s &amp; s</title>"), std::string::npos);
  EXPECT_NE(svg.find("<desc>what it shows</desc>"), std::string::npos);
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
