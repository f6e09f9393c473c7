// Scenes by engines, of runs that are set by hand.

#include "report/rows/engine_matrix.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "records.h"
#include "report/charts/engine_charts.h"
#include "report/files/markdown.h"

namespace slipcheck {
namespace {

EngineRecord run_of(const std::string& engine, const std::string& profile, double worst) {
  EngineRecord run = testing::lottery_run(240, 4);
  run.engine = engine;
  run.profile = profile;
  run.errors.erase("i.sliding_time");
  Deviation& error = run.errors["i-j.effective_restitution"];
  error.max = worst * *error.tolerance;
  error.verdict = worst > 1 ? Verdict::deviates : Verdict::within;
  return run;
}

/// Two engines on two scenes: `a` is within in both under `physical`, in one under `default`; `b`
/// deviates, then crashes.
std::vector<SceneRecord> two_scenes() {
  std::vector<SceneRecord> scenes = {testing::lottery_scene(4), testing::lottery_scene(4)};
  scenes[0].scenario.name = "first";
  scenes[1].scenario.name = "second";
  scenes[0].runs = {run_of("a", "default", 0.5), run_of("a", "physical", 0.1),
                    run_of("b", "default", 20)};
  scenes[1].runs = {run_of("a", "default", 3), run_of("a", "physical", 0.9),
                    run_of("b", "default", 1)};
  scenes[1].runs[2].status = RunStatus::crashed;
  scenes[0].runs[0].steps = scenes[1].runs[0].steps = 240;  // a simulated second
  scenes[0].runs[0].cpu_seconds = 0.01;
  scenes[1].runs[0].cpu_seconds = 0.04;
  return scenes;
}

TEST(EngineMatrix, HasTheWorstPhaseOfEachMethodInEachScene) {
  const std::vector<SceneRecord> scenes = two_scenes();
  const EngineMatrix matrix = engine_matrix(scenes);
  ASSERT_EQ(matrix.methods.size(), 3u);
  EXPECT_EQ(matrix.methods[0].label(false), "a 3.24 default 240 Hz");
  ASSERT_EQ(matrix.rows.size(), 2u);
  EXPECT_DOUBLE_EQ(matrix.rows[0].cells[0].error, 0.5);
  EXPECT_DOUBLE_EQ(matrix.rows[0].cells[2].error, 20);
  EXPECT_TRUE(std::isinf(matrix.rows[1].cells[2].error));

  const TextTable table = matrix_table(matrix, "#scene-");
  EXPECT_EQ(table.rows[1][0].link, "#scene-2");
  EXPECT_EQ(table.rows[0][1].text, "0.5");
  EXPECT_EQ(table.rows[0][3].tone, Tone::bad);
  EXPECT_EQ(table.rows[1][3].text, "✗");
}

TEST(EngineMatrix, OfARunsObservablesTheWorstCounts) {
  EngineRecord run = run_of("a", "default", 0.5);
  Deviation& other = run.errors["i.sliding_time"] = run.errors["i-j.effective_restitution"];
  other.max = 3 * *other.tolerance;
  other.verdict = Verdict::deviates;
  EXPECT_DOUBLE_EQ(worst_phase(run), 3);
  other.verdict = Verdict::undecided;  // says nothing
  EXPECT_DOUBLE_EQ(worst_phase(run), 0.5);
}

TEST(EngineMatrix, ScoresCountVerdictsAndAverageCosts) {
  const std::vector<SceneRecord> scenes = two_scenes();
  const auto scores = scores_of(engine_matrix(scenes));
  EXPECT_EQ(scores[0].within, 1u);
  EXPECT_EQ(scores[0].deviates, 1u);
  EXPECT_DOUBLE_EQ(scores[0].median_error, 1.75);
  EXPECT_NEAR(scores[0].cost, 0.02, 1e-15);  // √(0.01·0.04)
  EXPECT_EQ(scores[1].within, 2u);
  EXPECT_EQ(scores[2].failed, 1u);
  const TextTable table = score_table(engine_matrix(scenes));
  EXPECT_EQ(table.rows.front()[0].text, "a 3.24 physical 240 Hz");
  EXPECT_EQ(table.rows.back()[0].text, "b 3.24 default 240 Hz");
}

TEST(EngineMatrix, SentencesComeFromItsNumbers) {
  const std::vector<SceneRecord> scenes = two_scenes();
  const auto findings = matrix_findings(engine_matrix(scenes));
  ASSERT_EQ(findings.size(), 3u);
  EXPECT_EQ(
      findings[0],
      "Best: a 3.24 physical 240 Hz is within all tolerances in 2 of the 2 scenes that it runs");
  EXPECT_EQ(
      findings[1],
      "Worst: b 3.24 default 240 Hz is within all tolerances in 0 of the 2 scenes that it runs");
  EXPECT_EQ(
      findings[2],
      "a 3.24 at 240 Hz: physical brings 1 scene within tolerances that default is not within, and "
      "loses 0");
}

TEST(EngineMatrix, NamesScenesInWhichNobodyIsWithinAndNotThoseInWhichNothingIsKnown) {
  std::vector<SceneRecord> scenes = two_scenes();
  for (EngineRecord& run : scenes[0].runs) run.errors.clear();  // nothing is judged
  for (EngineRecord& run : scenes[1].runs)
    run.errors["i-j.effective_restitution"].verdict = Verdict::deviates;
  const std::string sentence = "In 1 scene no engine is within all tolerances: second";
  EXPECT_EQ(std::ranges::count(matrix_findings(engine_matrix(scenes)), sentence), 1);
}

TEST(EngineMatrix, SaysHowManyEnsemblesHaveFewerPhases) {
  std::vector<SceneRecord> scenes = two_scenes();  // 5 ensembles that have come to their end
  scenes[0].runs[1].phases = 1;                    // has no other
  scenes[0].runs[2].phases = 2;
  EXPECT_EQ(matrix_findings(engine_matrix(scenes)).back(),
            "Of 4 ensembles of more than one phase 1 has fewer than 4");
}

TEST(EngineMatrix, LeavesOutWhatIsExpectedAndWhatIsRare) {
  std::vector<SceneRecord> scenes = two_scenes();
  scenes.push_back(scenes[0]);
  scenes.push_back(scenes[0]);
  scenes.push_back(scenes[0]);
  scenes[4].runs.push_back(run_of("rare", "default", 1));
  scenes[0].runs[1].expect.emplace();
  const EngineMatrix matrix = engine_matrix(scenes);
  EXPECT_EQ(matrix.methods.size(), 3u);
  EXPECT_EQ(matrix.rows[0].cells[1].run, nullptr);
  EXPECT_TRUE(engine_matrix({scenes[0]}).methods.empty());
}

TEST(EngineMatrix, WhatTheRunLacksIsFartherThanAnyNumber) {
  std::vector<SceneRecord> scenes = two_scenes();
  Deviation& error = scenes[0].runs[0].errors["i-j.effective_restitution"];
  error.max = testing::kNaN;
  error.verdict = Verdict::deviates;
  const EngineMatrix matrix = engine_matrix(scenes);
  EXPECT_TRUE(std::isinf(matrix.rows[0].cells[0].error));
  EXPECT_EQ(matrix_table(matrix).rows[0][1].text, "∞");
}

TEST(EngineMatrix, StandsInMarkdown) {
  const std::string text = engines_markdown(two_scenes());
  for (const char* part : {"- Best: a 3.24 physical 240 Hz", "| a 3.24 physical 240 Hz | 2 |",
                           "| first | 0.5 | 0.1 | 20 |", "| second | 3 | 0.9 | ✗ |"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  EXPECT_NE(engines_markdown({}).find("not two scenes"), std::string::npos);
}

TEST(EngineMatrix, TheChartHasALineForEachEngineAndProfile) {
  std::vector<SceneRecord> scenes = two_scenes();
  std::set<std::string> taken;
  const auto chart = engine_chart(engine_matrix(scenes), taken);
  ASSERT_TRUE(chart);
  ASSERT_EQ(chart->panels[0].curves.size(), 4u);  // and one tolerance
  const Curve& curve = chart->panels[0].curves[1];
  EXPECT_EQ(curve.label, "a 3.24 default");
  EXPECT_NEAR(curve.x[0], 0.02, 1e-15);
  EXPECT_DOUBLE_EQ(curve.y[0], 1.75);
}

}  // namespace
}  // namespace slipcheck
