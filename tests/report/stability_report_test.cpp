#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "report/charts/report_charts.h"
#include "report/files/stability_csv.h"
#include "report/html/html_stability.h"
#include "report/json/stability_json.h"
#include "report/rows/stability_rows.h"
#include "report/terminal/stability_table.h"
#include "study_records.h"
#include "text_search.h"

namespace slipcheck::testing {
namespace {

TableStyle of_width(int width) {
  TableStyle style;
  style.width = width;
  return style;
}

TEST(StabilityRows, CasesByMethodsWithTotals) {
  const std::vector<StabilityCase> cases = stability_cases();
  const StabilityOverview overview = overview_of(cases);
  ASSERT_EQ(overview.methods.size(), 3u);
  EXPECT_EQ(overview.methods[2].label(), "bullet double tuned");
  ASSERT_EQ(overview.rows.size(), 3u);
  EXPECT_EQ(overview.rate, 240);
  EXPECT_EQ(overview.rows[1].label, "mass-ratio-1e6");
  EXPECT_EQ(overview.rows[1].runs[1]->outcome, Outcome::crashed);
  EXPECT_EQ(overview.rows[2].runs[1], nullptr);
  EXPECT_EQ(overview.totals[2][static_cast<std::size_t>(Outcome::accurate)], 1u);
  EXPECT_EQ(overview.totals[2][static_cast<std::size_t>(Outcome::degraded)], 1u);
  EXPECT_EQ(overview.accurate, 2u);
  EXPECT_EQ(overview.refused, 1u);
  EXPECT_EQ(overview.failed, 0u);
}

TEST(StabilityRows, SeveralRatesAreRowsOfTheirOwn) {
  std::vector<StabilityCase> cases = stability_cases();
  cases[0].runs[1].record.rate = 60;
  const StabilityOverview overview = overview_of(cases);
  ASSERT_EQ(overview.rows.size(), 4u);
  EXPECT_FALSE(overview.rate);
  EXPECT_EQ(overview.rows[0].label, "speed-1e4 @ 60 Hz");
  EXPECT_EQ(overview.rows[0].runs[0], nullptr);
  EXPECT_EQ(overview.rows[0].runs[1], &cases[0].runs[1]);
  EXPECT_EQ(overview.rows[1].label, "speed-1e4 @ 240 Hz");
  EXPECT_EQ(overview.rows[1].runs[1], nullptr);
}

TEST(StabilityRows, SaysHowManyPhasesAndWhy) {
  EXPECT_EQ(words_of(stability_cases()[0].runs[1]),
            "tunnelled in 2 of 16 phases: i passes through j at 1.2 ms");
  EXPECT_EQ(words_of(stability_cases()[0].runs[2]), "accurate");
}

TEST(StabilityTable, WordsWhereThereIsRoomElseShortOnesWithALegend) {
  const std::string roomy = stability_table(stability_cases(), of_width(140));
  EXPECT_TRUE(contains(roomy, "bullet single default  bullet double default")) << roomy;
  EXPECT_EQ(count(roomy, "energy growing"), 2u) << roomy;  // the cell and the head of the totals
  const std::string brief = stability_table(stability_cases(), of_width(60));
  EXPECT_TRUE(contains(brief, "s def = bullet single default")) << brief;
  EXPECT_TRUE(contains(brief, "tunn = tunnelled")) << brief;
  const std::string letters = stability_table(stability_cases(), of_width(40));
  EXPECT_TRUE(contains(letters, "1 = bullet single default")) << letters;
  EXPECT_TRUE(contains(letters, "T = tunnelled")) << letters;
}

TEST(StabilityTable, SaysWhyTheReferenceRefuses) {
  const std::string text = stability_table(stability_cases(), of_width(100));
  EXPECT_TRUE(contains(text, "2 accurate, 1 refused with the reason, 0 failed")) << text;
  EXPECT_TRUE(contains(text, "the radius must be > 0 m, got 0")) << text;
  EXPECT_FALSE(contains(text, "signal 11")) << text;
  TableStyle all = of_width(100);
  all.all_observables = true;
  EXPECT_TRUE(
      contains(stability_table(stability_cases(), all), "crashed in 2 of 16 phases: signal 11"));
}

TEST(StabilityTable, MethodsThatShortHeadsConfuseHaveNumbers) {
  std::vector<StabilityCase> cases = stability_cases();
  for (StabilityCase& scene : cases)
    for (StabilityRun& run : scene.runs)
      if (run.record.profile == "tuned") run.record.profile = "defence";
  const std::string text = stability_table(cases, of_width(60));
  EXPECT_TRUE(contains(text, "1 = bullet single default")) << text;
  EXPECT_TRUE(contains(text, "tunn = tunnelled")) << text;  // the words are still short ones
}

TEST(LimitsTable, ShowsRangesTheoryAndIslands) {
  const std::string text = limits_table(limit_results(), of_width(100));
  for (const std::string part :
       {"Largest stable step, steel-pair", "10.00 ms … 12.10 ms", "energy growing",
        "bad all the same at 2.000 ms", "all from 10.00 µs to 1.000 s", "interrupted", "2/ω0",
        // √(10 · 10.201) = 10.1 µs, what theory says
        "10.10 µs", "1.0000", "exploded"})
    EXPECT_TRUE(contains(text, part)) << part << "\n" << text;
}

TEST(StabilityJson, HoldsEverythingAndNullWithAReason) {
  std::vector<StabilityCase> cases = stability_cases();
  StabilityGrid grid;
  grid.rates = {240};
  const nlohmann::ordered_json json = json_of(cases, grid, limit_results());
  EXPECT_EQ(json["schema"], "slipcheck-stability/1");
  EXPECT_EQ(json["criteria"]["energy"], 0.05);
  EXPECT_EQ(json["cases"].size(), 3u);
  EXPECT_EQ(json["totals"]["reference"]["refused"], 1);
  EXPECT_EQ(json["totals"]["bullet double tuned"]["degraded"], 1);
  EXPECT_EQ(json["cases"][2]["reference"]["outcome"], "refused");
  EXPECT_EQ(json["cases"][2]["reference"]["worst_uncertainty"], nullptr);
  EXPECT_TRUE(json["cases"][2]["reference"].contains("reason"));
  const auto& run = json["cases"][1]["runs"][1];
  EXPECT_EQ(run["outcome"], "crashed");
  EXPECT_EQ(run["why"], "signal 11");
  EXPECT_EQ(run["phases"]["crashed"], 2);
  EXPECT_EQ(run["phases"]["accurate"], 14);
  EXPECT_EQ(run["worst_error"], nullptr);
  EXPECT_TRUE(contains(run["reason"], "no error could be taken"));
  const auto& limits = json["limits"];
  ASSERT_EQ(limits.size(), 4u);
  EXPECT_EQ(limits[0]["good"], 0.01);
  EXPECT_EQ(limits[0]["islands"][0], 0.002);
  EXPECT_EQ(limits[1]["bad"], nullptr);
  EXPECT_EQ(limits[1]["reason"], "no value was found bad");
  EXPECT_FALSE(limits[1].contains("beyond"));
  EXPECT_NEAR(limits[3]["ratio_to_theory"].get<double>(), 1, 1e-12);  // rounding
  const auto& map = json["maps"][0];
  EXPECT_EQ(map["outcome"].size(), 2u);
  EXPECT_EQ(map["outcome"][1][2], "energy growing");
  EXPECT_EQ(map["worst_error"][1][0], nullptr);
  EXPECT_EQ(map["worst_error"][0][1], 0.03);
  EXPECT_EQ(map["reason"], "null where there is no error");
  EXPECT_EQ(map["theory"][1][0], 1);
}

TEST(StabilityCsv, ARowForTheReferenceAndEachRun) {
  std::vector<StabilityCase> cases = stability_cases();
  cases[0].runs[0].why = "a \"b\", c";
  const std::string csv = stability_csv(cases);
  EXPECT_EQ(count(csv, "\n"), 1u + 3u + 7u);
  const std::string header = csv.substr(0, csv.find('\n'));
  EXPECT_EQ(count(header, ","), 14u + kOutcomes);
  EXPECT_EQ(csv.find("speed-1e4,reference,,,,,,accurate,,1e-06,,,,,1e-05,"), header.size() + 1);
  EXPECT_TRUE(contains(csv, "\"a \"\"b\"\", c\""));
  EXPECT_TRUE(contains(csv, ",bullet,3.24,double,default,240,crashed,signal 11,,,,,,0.01,14,"));
  EXPECT_FALSE(contains(csv, "nan"));
}

TEST(StabilityCsv, LimitsAndMaps) {
  const std::string limits = limits_csv(limit_results().limits);
  EXPECT_EQ(count(limits, "\n"), 1u + 4u);
  EXPECT_TRUE(contains(limits,
                       "stable_step,bullet double default,bullet,3.24,double,default,steel-pair,"
                       "0.01,0.0121,1e-05,1,,,,energy growing,energy rises by 7 %,0.002,\n"))
      << limits;
  const std::string maps = maps_csv(limit_results().maps);
  EXPECT_EQ(count(maps, "\n"), 1u + 6u);
  EXPECT_TRUE(contains(maps, "speed [m/s],1,restitution [-],0,tunnelled,|e − e_ref|,0.5\n"));
  EXPECT_TRUE(contains(maps, "speed [m/s],0.01,restitution [-],1,NaN,|e − e_ref|,\n"));
}

ReportContent stability_content() {
  ReportContent content;
  content.cases = stability_cases();
  content.limits = limit_results();
  return content;
}

TEST(StabilityCharts, ACellForTheReferenceAndEachRunWithItsReason) {
  const std::vector<Chart> charts = report_charts(stability_content(), ChartExtent::all).all();
  ASSERT_EQ(charts.size(), 4u);  // the catalogue, limits on two scenes, a map
  EXPECT_EQ(charts[0].name, "stability-catalogue");
  EXPECT_EQ(charts[1].name, "limit-stable_step-steel-pair");
  EXPECT_EQ(charts[3].name, "map-speed-restitution-bullet-double-default");
  const auto& cells = charts[0].panels[0].cells;
  EXPECT_EQ(cells.size(), 3u + 7u);
  EXPECT_TRUE(std::ranges::any_of(
      cells, [](const MapCell& cell) { return cell.note.ends_with("signal 11"); }));
  const Panel& map = charts[3].panels[0];
  EXPECT_EQ(map.cells.size(), 6u);
  // The first column is x = 0.01 of 0.01, 0.1, 1; the lower row 0 of 0 and 1.
  EXPECT_NEAR(map.cells[0].x_high, std::sqrt(0.01 * 0.1), 1e-15);
  EXPECT_DOUBLE_EQ(map.cells[0].y_low, -0.5);
  EXPECT_EQ(map.curves[0].label, "where h v = R");
}

TEST(StabilityCharts, BarsChangeAtTheLimit) {
  const std::vector<Chart> charts = report_charts(stability_content(), ChartExtent::page).limits;
  const Panel& limits = charts[0].panels[0];
  // The first works up to √(10 · 12.1) = 11 ms of 10 µs to 1 s and gains energy beyond.
  ASSERT_GE(limits.cells.size(), 2u);
  EXPECT_EQ(limits.looks[limits.cells[0].look].label, "works");
  EXPECT_DOUBLE_EQ(limits.cells[0].x_low, 1e-5);
  EXPECT_NEAR(limits.cells[0].x_high, 0.011, 1e-15);
  EXPECT_EQ(limits.looks[limits.cells[1].look].label, "energy growing");
  EXPECT_DOUBLE_EQ(limits.cells[1].x_high, 1);
  // All of the range is good for the second: one bar.
  EXPECT_EQ(
      std::ranges::count_if(
          limits.cells, [](const MapCell& cell) { return cell.y_low > 0.5 && cell.y_high < 1.5; }),
      1);
  // 2/ω0 where theory puts it.
  EXPECT_EQ(charts[1].panels[0].curves[0].label, "theory");
  EXPECT_DOUBLE_EQ(charts[1].panels[0].curves[0].x[0], 1.01e-5);
}

TEST(StabilityCharts, WhatWasInterruptedIsNotDrawn) {
  ReportContent content;
  content.limits = limit_results();
  content.limits.limits.clear();
  content.limits.maps[0].outcome.pop_back();
  EXPECT_TRUE(report_charts(content, ChartExtent::all).all().empty());
}

TEST(StabilityPage, SaysEverything) {
  std::vector<StabilityCase> cases = stability_cases();
  cases[0].runs[0].why = "<b>&";
  ReportContent content;
  content.cases = cases;
  content.limits = limit_results();
  const std::string html =
      html_stability(content, report_charts(content, ChartExtent::page), StandingCharts());
  EXPECT_FALSE(contains(html, "<b>"));
  EXPECT_TRUE(contains(html, "&lt;b&gt;&amp;"));
  for (const std::string part : {"signal 11", "the radius must be", "bad all the same at 2.000 ms",
                                 "2/ω0", "creeps by more than 1.00 %", "1000 times as fast"})
    EXPECT_TRUE(contains(html, part)) << part;
  // Cases by methods, the reference first; E: energy growing.
  EXPECT_TRUE(
      contains(html,
               "<tr><th scope=\"row\"><a href=\"#case-1\">speed-1e4</a></th><td class=\"o0\">A</td>"
               "<td class=\"o3\">E</td>"));
  EXPECT_TRUE(contains(html, "<details id=\"case-1\"><summary>speed-1e4 "));
  // The map's upper row, of restitution 1.
  EXPECT_TRUE(
      contains(html,
               "<tr><th scope=\"row\">1</th><td class=\"o6\">N</td><td class=\"o0\">A</td><td "
               "class=\"o3\">E</td></tr>"));
  EXPECT_EQ(html_stability({}, {}, {}), "");
}

}  // namespace
}  // namespace slipcheck::testing
