#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "report/charts/category_map.h"
#include "report/charts/figure.h"
#include "report/rows/outcome_look.h"
#include "text_search.h"

namespace slipcheck {
namespace {

using testing::contains;
using testing::count;

/// 2 × 2 cells in a frame of 100 × 100 px: the lower row accurate and crashed, the upper one NaN
/// and accurate.
CategoryMap four_cells() {
  CategoryMap map;
  map.title = "a < b";
  map.x = {"x", true};
  map.y = {"y"};
  map.x_values = {1, 100};
  map.y_values = {1, 2};
  map.cells = {Outcome::accurate, Outcome::crashed, Outcome::not_finite, Outcome::accurate};
  return map;
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

TEST(OutcomeMap, CellsFillTheFrameFromBelow) {
  const std::string svg = category_map_svg(four_cells(), {0, 0, 100, 100}, "clip");
  const auto cell = [&](const char* x, const char* y, Outcome outcome) {
    return contains(svg, std::string("<rect x=\"") + x + "\" y=\"" + y +
                             "\" width=\"50.00\" height=\"50.00\" fill=\"" + look_of(outcome).fill +
                             "\"");
  };
  EXPECT_TRUE(cell("0.00", "50.00", Outcome::accurate)) << svg;
  EXPECT_TRUE(cell("50.00", "50.00", Outcome::crashed));
  EXPECT_TRUE(cell("0.00", "0.00", Outcome::not_finite));
  EXPECT_TRUE(cell("50.00", "0.00", Outcome::accurate));
}

TEST(OutcomeMap, CellsSayTheirNotesEscaped) {
  CategoryMap map = four_cells();
  map.notes = {"", "<b>&", "", "\"x\""};
  const std::string svg = category_map_svg(map, {0, 0, 100, 100}, "clip");
  EXPECT_EQ(count(svg, "<title>"), 2u);
  EXPECT_TRUE(contains(svg, "<title>&lt;b&gt;&amp;</title>"));
  EXPECT_TRUE(contains(svg, ">a &lt; b</text>"));
}

TEST(OutcomeMap, TheoryIsWhereTheAxesPutIt) {
  CategoryMap map = four_cells();
  EXPECT_FALSE(contains(category_map_svg(map, {0, 0, 100, 100}, "clip"), "clip"));
  // The cells of x = 1 and 100 reach from 0.1 to 1000, those of y = 1 and 2 from 0.5 to 2.5.
  map.line = {{0.1, 0.5}, {10, 1.5}, {-1, 1}, {1000, 2.5}, {1, 1e9}};
  const std::string svg = category_map_svg(map, {0, 0, 100, 100}, "clip");
  EXPECT_TRUE(contains(svg, "M0.00 100.00L50.00 50.00M100.00 0.00L25.00 -1900.00")) << svg;
}

TEST(OutcomeMap, ItsFigureNamesWhatOccursOnce) {
  CategoryMap map = four_cells();
  map.line = {{1, 1}, {10, 2}};
  map.line_label = "2/ω0";
  FigureDrawing drawing;
  drawing.panels = {map, map};
  const std::string svg = figure_svg(drawing, "m", "maps", "");
  EXPECT_EQ(count(svg, ">accurate</text>"), 1u);
  EXPECT_EQ(count(svg, ">NaN</text>"), 1u);
  EXPECT_EQ(count(svg, ">crashed</text>"), 1u);
  EXPECT_EQ(count(svg, ">2/ω0</text>"), 1u);
  EXPECT_FALSE(contains(svg, ">tunnelled</text>"));
  EXPECT_EQ(count(svg, "id=\"m-plot-2\""), 1u);
}

}  // namespace
}  // namespace slipcheck
