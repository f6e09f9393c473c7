#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "report/files/check_files.h"
#include "report/terminal/check_table.h"

namespace slipcheck {
namespace {

using Statistic = Change::Statistic;

constexpr const char* kRun = "bullet double default 240 Hz";

Change moved(const std::string& observable, Statistic statistic, double before, double after,
             double allowed, Direction direction) {
  Change change;
  change.scene = "pair";
  change.part = kRun;
  change.observable = observable;
  change.statistic = statistic;
  change.before = before;
  change.after = after;
  change.allowed = allowed;
  change.direction = direction;
  return change;
}

/// A scene whose restitution has moved in an engine and whose reference has moved by 1e-8; one in
/// which all is as it was.
CheckReport pair_report() {
  CheckReport report{"results/baselines", 16, {}};
  SceneCheck& pair = report.scenes.emplace_back();
  pair.scene = "pair";
  pair.parts = {{"reference", 1e-6, ""}, {kRun, 2e-3, ""}, {"bullet single fast 60 Hz", 0, "gone"}};
  pair.compared = 20;
  pair.reference_time_ratio = 1;
  pair.engine_time_ratio = 2;
  pair.versions = {"bullet 3.24, now 3.25"};
  Change reference =
      moved("i.sliding_time", Statistic::value, 0.02, 0.0200000002, 2e-11, Direction::moved);
  reference.part = "reference";
  pair.changes = {reference,
                  moved("i-j.restitution", Statistic::median, 0.9, 0.95, 0.01, Direction::worse),
                  moved("i-j.restitution", Statistic::max, 0.9, 1.1, 0.01, Direction::worse),
                  moved("i.sliding_time", Statistic::min, 0.0276, 0.0272, 2e-4, Direction::better)};
  SceneCheck& still = report.scenes.emplace_back();
  still.scene = "still";
  still.parts = {{"reference", 1e-6, ""}, {kRun, 2e-3, ""}};
  still.compared = 10;
  still.reference_time_ratio = 1;
  still.engine_time_ratio = 8;
  return report;
}

TEST(CheckRows, TotalsCountAndTakeGeometricMeans) {
  const CheckTotals totals = totals_of(pair_report());
  EXPECT_EQ(totals.moved_scenes, 1u);
  EXPECT_EQ(totals.runs, 3u);
  EXPECT_EQ(totals.better, 1u);
  EXPECT_EQ(totals.worse, 2u);
  EXPECT_EQ(totals.neither, 1u);
  EXPECT_EQ(totals.compared, 30u);
  EXPECT_DOUBLE_EQ(totals.engine_time_ratio, 4);  // √(2·8)
  EXPECT_EQ(check_verdict(pair_report()),
            "1 of 2 scenes has moved: 4 changes (2 worse, 1 better, 1 neither better nor worse)");
}

TEST(CheckRows, OfEachRunTheMostSevereChangeIsShown) {
  const auto rows = change_rows(pair_report().scenes[0], false);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].statistic, "max");  // 0.2 of 0.01; the median is 0.05 of it
  EXPECT_EQ(rows[1].before, "0.900");
  EXPECT_EQ(rows[1].now, "1.100");
  EXPECT_EQ(rows[1].allowed, "± 0.010");
  EXPECT_EQ(rows[1].others, 2u);
  const auto all = change_rows(pair_report().scenes[0], true);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[3].before, "27.60");
  EXPECT_EQ(all[3].now, "27.20 ms");
  EXPECT_EQ(all[3].direction.text, "better");
}

TEST(CheckRows, AChangeThatGatesGoesBeforeOneThatDoesNot) {
  SceneCheck scene = pair_report().scenes[0];
  Change verdict = moved("", Statistic::verdict, NAN, NAN, NAN, Direction::worse);
  verdict.was = "within";
  verdict.is = "deviates";
  verdict.gates = false;
  scene.changes = {verdict, scene.changes[1]};
  EXPECT_EQ(change_rows(scene, false).at(0).statistic, "median");
  scene.changes = {verdict};
  EXPECT_EQ(change_rows(scene, false).at(0).now, "deviates");
  scene.changes[0].statistic = Statistic::value;
  EXPECT_TRUE(change_rows(scene, false).empty());
}

TEST(CheckRows, AMoveThatFourDigitsHideHasThemAll) {
  const auto rows = change_rows(pair_report().scenes[0], false);
  EXPECT_EQ(rows[0].before, "0.02");
  EXPECT_EQ(rows[0].now, "0.0200000002 s");
}

TEST(CheckRows, MessagesHaveSceneRunObservableAndBothValues) {
  const CheckReport report = pair_report();
  const auto& changes = report.scenes[0].changes;
  EXPECT_EQ(change_message(changes[0]),
            "pair, reference: i.sliding_time value was 0.02 s, is 0.0200000002 s, allowed 0.02000 "
            "ns");
  EXPECT_EQ(change_message(changes[1]),
            "pair, bullet double default 240 Hz: i-j.restitution median was 0.9, is 0.95, allowed "
            "0.01000: worse");
  Change missing = moved("i.sliding_time", Statistic::missing, 0, 3, NAN, Direction::worse);
  EXPECT_EQ(change_message(missing),
            "pair, bullet double default 240 Hz: i.sliding_time missing was 0, is 3 phases: worse");
  Change status;
  status.scene = "pair";
  status.part = kRun;
  status.statistic = Statistic::status;
  status.was = "ok";
  status.is = "crashed";
  status.note = "signal 11";
  EXPECT_EQ(change_message(status),
            "pair, bullet double default 240 Hz: status was ok, is crashed (signal 11)");
}

TEST(CheckTable, TellsWhatHasMovedAndWhatIsOnlyTold) {
  const std::string text = check_table(pair_report(), {.width = 120});
  EXPECT_NE(text.find("✗ pair"), std::string::npos) << text;
  EXPECT_NE(text.find("0.900 → 1.100"), std::string::npos) << text;
  EXPECT_NE(text.find("another engine version than the baseline's: bullet 3.24, now 3.25"),
            std::string::npos);
  EXPECT_NE(text.find("never judged: reference × 1.00, engines × 4.00"), std::string::npos);
  EXPECT_EQ(text.find("still"), std::string::npos);
}

TEST(CheckTable, ManyOfOneSceneAreCounted) {
  CheckReport report = pair_report();
  for (int k = 0; k < 20; ++k) {
    Change change = moved("i.sliding_time", Statistic::median, 1, 2, 0.1, Direction::worse);
    change.part = "engine " + std::to_string(k);
    report.scenes[0].changes.push_back(change);
  }
  EXPECT_NE(check_table(report, {}).find("… and 10 more (--all)"), std::string::npos);
  EXPECT_EQ(check_table(report, {.all_observables = true}).find("--all"), std::string::npos);
}

TEST(CheckTable, GreenIsShort) {
  CheckReport report = pair_report();
  report.scenes.erase(report.scenes.begin());
  EXPECT_TRUE(check_table(report, {}).starts_with("✓ nothing has moved\n"));
}

TEST(CheckJUnit, HasATestForEachRunAndTheReference) {
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(junit_xml(test_outcomes(pair_report())).c_str()));
  const auto tests = document.select_nodes("//testcase");
  ASSERT_EQ(tests.size(), 5u);
  const auto failures = document.select_nodes("//failure");
  ASSERT_EQ(failures.size(), 2u);
  const std::string message = failures[1].node().attribute("message").value();
  EXPECT_NE(message.find("pair, bullet double default 240 Hz: i-j.restitution max was 0.9, is 1.1"),
            std::string::npos);
  EXPECT_NE(message.find("and 2 more [baseline: bullet 3.24, now 3.25]"), std::string::npos)
      << message;
  EXPECT_EQ(document.select_nodes("//skipped").size(), 1u);
}

TEST(CheckJUnit, WhatHasNoBaselineFails) {
  const CheckReport report{"b", 16, {scene_without_baseline("new")}};
  const auto outcomes = test_outcomes(report);
  ASSERT_EQ(outcomes.size(), 1u);
  EXPECT_EQ(outcomes[0].kind, TestOutcome::Kind::failed);
  EXPECT_EQ(outcomes[0].message,
            "new, scene: presence was no baseline, is scene (it has no baseline; slipcheck check "
            "--update "
            "makes one)");
}

TEST(CheckJson, KeepsEveryDigitAndNoDate) {
  const auto json = json_of(pair_report());
  EXPECT_EQ(json["schema"], "slipcheck-check/1");
  EXPECT_EQ(json["verdict"], "moved");
  const auto& change = json["scenes"][0]["changes"][0];
  EXPECT_EQ(change["part"], "reference");
  EXPECT_EQ(change["before"], 0.02);
  EXPECT_EQ(change["now"], 0.0200000002);
  EXPECT_EQ(change["allowed"], 2e-11);
  EXPECT_EQ(json["scenes"][1]["verdict"], "unchanged");
  EXPECT_EQ(json.dump(), json_of(pair_report()).dump());
}

/// A page's part and a comment: red scenes first, whatever their place.
TEST(CheckRows, WhatHasMovedStandsFirst) {
  CheckReport report = pair_report();
  std::ranges::reverse(report.scenes);
  const Moved moved = moved_since(report);
  EXPECT_NE(moved.finding.find("Since results/baselines: 1 of 2 scenes has moved"),
            std::string::npos)
      << moved.finding;
  EXPECT_NE(moved.finding.find("ensembles of 16"), std::string::npos);
  ASSERT_FALSE(moved.table.rows.empty());
  bool green = false;
  for (const auto& row : moved.table.rows) {
    ASSERT_EQ(row.size(), moved.table.columns.size());
    const bool is_green = row[0].text.starts_with("✓");
    EXPECT_FALSE(green && !is_green) << row[0].text;
    green = is_green;
  }
  EXPECT_TRUE(moved.table.rows[0][0].text.starts_with("✗ "));
}

TEST(CheckMarkdown, FitsAComment) {
  CheckReport report = pair_report();
  const SceneCheck pair = report.scenes[0];
  for (int k = 0; k < 300; ++k) report.scenes.push_back(pair);
  const std::string text = markdown_of(report);
  EXPECT_LE(text.size(), 8000u);
  EXPECT_NE(text.find("more rows; there is no room for them here"), std::string::npos);
  EXPECT_NE(text.find("now 3.25"), std::string::npos);
  const std::string small = markdown_of(pair_report());
  EXPECT_TRUE(small.starts_with("## ✗ Slipcheck: 1 of 2 scenes has moved")) << small;
  EXPECT_EQ(small.find("no room"), std::string::npos);
}

}  // namespace
}  // namespace slipcheck
