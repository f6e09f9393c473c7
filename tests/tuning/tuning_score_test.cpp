#include "studies/tuning/tuning_score.h"

#include <gtest/gtest.h>

#include <limits>

namespace slipcheck {
namespace {

using Status = EngineRecord::Status;

/// 16 phases at 240 Hz: the sliding time is off by 3 % of tolerated 1 %, e_eff by 0.02 of 0.005;
/// the restitution has no tolerance.
EngineRecord record() {
  EngineRecord record;
  record.rate = 240;
  record.status = Status::ok;
  record.steps = 480;
  record.cpu_seconds = 0.01;
  record.phases = 16;
  const auto add = [&](const std::string& name, double error, std::optional<double> tolerance) {
    record.observables[name].values.assign(16, 1);
    record.errors[name].max = error;
    record.errors[name].tolerance = tolerance;
  };
  add("i.sliding_time", 0.03, 0.01);
  add("i-j.effective_restitution", 0.02, 0.005);
  add("i-j.restitution", 0.5, std::nullopt);
  return record;
}

TEST(TuningScore, IsTheWorstErrorInTolerances) {
  const RunScore score = score_of(record(), {}, 16);
  EXPECT_DOUBLE_EQ(score.worst, 4);
  EXPECT_EQ(score.observable, "i-j.effective_restitution");
  EXPECT_DOUBLE_EQ(score.deviation, 0.03);
  EXPECT_EQ(score.failed, 0);
  EXPECT_DOUBLE_EQ(score.simulated_seconds, 2);
  EXPECT_EQ(score.cpu_seconds, 0.01);
}

TEST(TuningScore, CountsTheObservablesThatAreNamedToo) {
  // Without a tolerance 0.01 is one error: 0.5 is 50.
  EXPECT_DOUBLE_EQ(score_of(record(), {{"restitution"}}, 16).worst, 50);
  EXPECT_DOUBLE_EQ(score_of(record(), {{"sliding_time"}}, 16).worst, 3);
}

TEST(TuningScore, TellsTheShareOfPhasesThatLackAnObservable) {
  EngineRecord some = record();
  some.observables["i.sliding_time"].missing = 4;
  EXPECT_DOUBLE_EQ(score_of(some, {}, 16).failed, 0.25);
  EngineRecord none = record();
  none.observables.erase("i.sliding_time");
  none.errors["i.sliding_time"].max = std::numeric_limits<double>::quiet_NaN();
  none.errors["i.sliding_time"].reason = "no run of the engine shows it";
  EXPECT_EQ(score_of(none, {}, 16).failed, 1);
  EXPECT_EQ(score_of(none, {}, 16).reason,
            "i.sliding_time fails in all phases: no run of the engine shows it");
  // What does not count may be missing.
  EngineRecord other = record();
  other.observables.erase("i-j.restitution");
  EXPECT_EQ(score_of(other, {}, 16).failed, 0);
}

TEST(TuningScore, WhatOnlyTheEngineShowsIsAFailureOfThosePhases) {
  EngineRecord jumping = record();
  jumping.observables["i.jump_height"].values.assign(16, 1);
  jumping.observables["i.jump_height"].missing = 13;
  jumping.errors["i.jump_height"].max = std::numeric_limits<double>::quiet_NaN();
  jumping.errors["i.jump_height"].tolerance = 0.01;
  EXPECT_DOUBLE_EQ(score_of(jumping, {}, 16).failed, 3. / 16);
  EXPECT_EQ(score_of(jumping, {}, 16).reason, "i.jump_height fails in 18.8 % of the phases");
}

TEST(TuningScore, ARunThatFailedTellsHowFarItCame) {
  EngineRecord crashed = record();
  crashed.status = Status::crashed;
  crashed.phases = 4;
  crashed.reason = "killed by signal 9";
  EXPECT_DOUBLE_EQ(score_of(crashed, {}, 16).failed, 0.75);
  EXPECT_EQ(score_of(crashed, {}, 16).reason, "crashed: killed by signal 9");
  crashed.phases = 16;
  EXPECT_DOUBLE_EQ(score_of(crashed, {}, 16).failed, 1. / 16);
}

RunScore run(double worst, double deviation, double cpu = 1, double failed = 0) {
  return {worst, "x", deviation, failed, cpu, 2, ""};
}

TEST(TuningScore, OfSeveralRunsTheWorstCountsAndTheMeanBesides) {
  const std::vector<RunScore> runs = {run(1, 0.1, 1), run(4, 0.2, 3), run(1, 0.3, 2)};
  const Score score = score_of(runs, {});
  EXPECT_EQ(score.worst, 4);
  EXPECT_EQ(score.worst_run, 1u);
  EXPECT_EQ(score.mean, 2);
  EXPECT_EQ(score.cost, 1);  // (1 + 3 + 2)/2 s/s over three runs
  EXPECT_GT(objective(score, {}), 4);
  EXPECT_LT(objective(score, {}), 4.1);
  const Score within = score_of(runs, {.within = 0.1});
  EXPECT_NEAR(within.worst, 3, 1e-12);
  EXPECT_EQ(within.worst_run, 2u);
}

TEST(TuningScore, AFailedRunIsWorseThanTheLargestError) {
  const std::vector<RunScore> large = {run(kLargestError, kLargestError)};
  const std::vector<RunScore> failed = {run(0, 0, 1, 1. / 16)};
  const std::vector<RunScore> worse = {run(0, 0, 1, 1)};
  for (const TuningGoal& goal : {TuningGoal{}, TuningGoal{0.05}}) {
    EXPECT_TRUE(is_better(score_of(large, goal), score_of(failed, goal), goal));
    EXPECT_TRUE(is_better(score_of(failed, goal), score_of(worse, goal), goal));
  }
}

TEST(TuningScore, CostDecidesWithinAGoalOnlyAndByMoreThanItsScatter) {
  const auto score = [](double worst, double cost) {
    Score made;
    made.worst = made.mean = worst;
    made.cost = cost;
    return made;
  };
  EXPECT_FALSE(is_better(score(1, 1e-6), score(1, 1), {}));
  EXPECT_FALSE(is_better(score(1.1, 0.1), score(1, 1), {}));
  EXPECT_TRUE(is_better(score(0.9, 10), score(1, 1), {}));
  // Within the wanted error all errors are equal.
  EXPECT_TRUE(is_better(score(0.9, 0.85), score(0.1, 1), {0.05}));
  EXPECT_FALSE(is_better(score(0.9, 0.95), score(0.1, 1), {0.05}));
}

}  // namespace
}  // namespace slipcheck
