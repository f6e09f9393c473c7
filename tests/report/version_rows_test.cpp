// What changed between two versions of an engine, of values that are set by hand.

#include "report/rows/version_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "records.h"
#include "report/json/versions_json.h"

namespace slipcheck {
namespace {

const char* const kE = "i-j.effective_restitution";  // its tolerance is 0.005
const char* const kTime = "i.sliding_time";          // 1 % of 27.78 ms

/// The lottery's run, and one whose effective restitution is right in every phase.
VersionComparison cured_lottery() {
  VersionComparison comparison{"rapier", "0.19.3", "0.21.0", {}};
  SceneRecord& scene = comparison.scenes.emplace_back(testing::lottery_scene());
  scene.runs = {testing::lottery_run(240, 8), testing::lottery_run(240, 8)};
  EngineRecord& after = scene.runs[1];
  EnsembleValue& e = after.observables[kE];
  for (double& value : e.values) value = 0.358;
  e.min = e.median = e.max = 0.358;
  after.errors[kE].max = 0.358 - 5.0 / 14;
  return comparison;
}

TEST(VersionRows, TheLargestMoveOfTheDistributionCounts) {
  const VersionComparison comparison = cured_lottery();
  const auto changes = version_changes(comparison);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].observable, kE);
  EXPECT_NEAR(changes[0].moved, (0.498 - 0.358) / 0.005, 1e-9);  // of the worst phase
  EXPECT_NEAR(changes[0].error_before, 0.141 / 0.005, 1e-12);
  EXPECT_NEAR(changes[0].error_after, (0.358 - 5.0 / 14) / 0.005, 1e-9);
  const VersionTotals totals = totals_of(comparison, changes);
  EXPECT_EQ(totals.runs, 1u);
  EXPECT_EQ(totals.compared, 2u);
  EXPECT_EQ(totals.better, 1u);
  EXPECT_EQ(totals.worse, 0u);
  EXPECT_EQ(totals.failed, 0u);
}

TEST(VersionRows, TheOrderOfThePhasesDoesNotCount) {
  VersionComparison comparison = cured_lottery();
  SceneRecord& scene = comparison.scenes[0];
  scene.runs[1] = scene.runs[0];
  std::ranges::reverse(scene.runs[1].observables[kE].values);
  EXPECT_TRUE(version_changes(comparison).empty());
}

TEST(VersionRows, WhatMovesByLessThanTheThresholdIsNotTold) {
  VersionComparison comparison = cured_lottery();
  SceneRecord& scene = comparison.scenes[0];
  scene.runs[1] = scene.runs[0];
  for (double& value : scene.runs[1].observables[kTime].values) value += 0.09 * 0.01 * 0.1 / 3.6;
  EXPECT_TRUE(version_changes(comparison).empty());
  comparison.threshold = 0.08;
  ASSERT_EQ(version_changes(comparison).size(), 1u);
  EXPECT_NEAR(version_changes(comparison)[0].moved, 0.09, 1e-9);
}

TEST(VersionRows, APhaseThatShowsNoneHasMovedWithoutLimit) {
  VersionComparison comparison = cured_lottery();
  SceneRecord& scene = comparison.scenes[0];
  scene.runs[1] = scene.runs[0];
  scene.runs[1].observables[kTime].values[3] = NAN;
  scene.runs[1].observables[kTime].missing = 1;
  const auto changes = version_changes(comparison);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_TRUE(std::isinf(changes[0].moved));
}

TEST(VersionRows, ARunThatFailsInOneOfTheTwoComesFirst) {
  VersionComparison comparison = cured_lottery();
  comparison.scenes.push_back(comparison.scenes[0]);
  SceneRecord& scene = comparison.scenes[1];
  scene.scenario.name = "other";
  scene.runs[1] = testing::failed_run(RunStatus::unstable, "a state is not finite");
  const auto changes = version_changes(comparison);
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_EQ(changes[0].scene->scenario.name, "other");
  EXPECT_EQ(changes[0].observable, "");
  EXPECT_EQ(totals_of(comparison, changes).failed, 1u);
  const TextTable table = version_table(comparison, changes, 10);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0][5].text, "unstable: a state is not finite");
  EXPECT_EQ(table.rows[1][4].text, "0.3580 … 0.4280 … 0.4980");
  EXPECT_EQ(table.rows[1][5].text, "0.3580");
  EXPECT_EQ(version_table(comparison, changes, 1).rows.size(), 1u);
}

TEST(VersionRows, WhatNeitherCanRunIsNoChange) {
  VersionComparison comparison = cured_lottery();
  comparison.scenes[0].runs.assign(2, testing::failed_run(RunStatus::skipped, "no periodic"));
  EXPECT_TRUE(version_changes(comparison).empty());
  EXPECT_EQ(totals_of(comparison, {}).runs, 0u);
  EXPECT_EQ(totals_of(comparison, {}).compared, 0u);
  EXPECT_NE(version_finding(comparison, {}).find("nothing could be compared"), std::string::npos);
}

TEST(VersionRows, TheFileHasBothDistributions) {
  const VersionComparison comparison = cured_lottery();
  const auto file = json_of(comparison, version_changes(comparison));
  EXPECT_EQ(file["schema"], "slipcheck-versions/1");
  ASSERT_EQ(file["changes"].size(), 1u);
  const auto& change = file["changes"][0];
  EXPECT_EQ(change["observable"], kE);
  EXPECT_EQ(change["before"]["values"].size(), 8u);
  EXPECT_EQ(change["after"]["max"], 0.358);
  EXPECT_EQ(change["reference"], 5.0 / 14);
}

}  // namespace
}  // namespace slipcheck
