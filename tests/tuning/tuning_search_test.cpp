#include "studies/tuning/tuning_search.h"

#include <gtest/gtest.h>

#include <set>

#include "tuning_synthetic.h"

namespace slipcheck {
namespace {

using test::synthetic_engine;
using test::synthetic_runs;
using test::synthetic_tasks;

struct Searched {
  TuningCandidate best;
  std::vector<TuningCandidate> evaluated;
  bool converged = false;
  double spent = 0;
};

Searched search(const Settings& start, const TuningGoal& goal = {}, TuningBudget budget = {},
                const TuningRuns& runs = synthetic_runs(),
                const std::vector<std::string>& only = {}) {
  const TuningSpace space = tuning_space(synthetic_engine(), start, only);
  TuningJournal journal;
  TuningEvaluator evaluator(synthetic_tasks(), "test", {}, 16, runs, journal, budget);
  TuningSearch search(space, evaluator, {goal, 1, {}});
  const bool converged = search.run();
  return {search.best(), search.evaluated(), converged, evaluator.spent()};
}

TEST(TuningSearch, FindsTheKnownMinimum) {
  const Searched found = search({});
  EXPECT_TRUE(found.converged);
  // multi, threshold 1e-3, erp 0.3, warm and split: 0.5 is left. A coordinate is found to 1e-3,
  // which of threshold's six decades is 2 · 6e-3, of erp 8 · 1e-3; the objective to a share of
  // 1e-3.
  EXPECT_NEAR(found.best.score.worst, 0.5, 0.03);
  const Settings& settings = found.best.settings;
  EXPECT_EQ(settings.at("body"), Setting(std::string("multi")));
  EXPECT_EQ(settings.at("warm"), Setting(true));
  EXPECT_EQ(settings.at("split"), Setting(true));
  EXPECT_NEAR(std::log10(std::get<double>(settings.at("threshold"))), -3, 0.015);
  EXPECT_NEAR(std::get<double>(settings.at("erp")), 0.3, 0.004);
  // c is faster, but worse; b slower; idle does nothing.
  EXPECT_FALSE(settings.contains("solver"));
  EXPECT_FALSE(settings.contains("idle"));
}

TEST(TuningSearch, SettingsThatHelpOnlyTogetherAreFoundInPairs) {
  const Searched found = search({}, {}, {}, synthetic_runs(), {"warm", "split"});
  EXPECT_EQ(found.best.settings, (Settings{{"warm", true}, {"split", true}}));
}

TEST(TuningSearch, WhatDoesNotMatterReturnsToTheEnginesOwnValue) {
  const Searched found = search({{"idle", true}, {"fixed", 3.0}});
  EXPECT_FALSE(found.best.settings.contains("idle"));
  // Not the search's to change.
  EXPECT_EQ(found.best.settings.at("fixed"), Setting(3.0));
}

TEST(TuningSearch, ChangesOnlyTheSettingsThatAreNamed) {
  const Searched found = search({{"idle", true}}, {}, {}, synthetic_runs(), {"body"});
  EXPECT_EQ(found.best.settings, (Settings{{"idle", true}, {"body", std::string("multi")}}));
}

TEST(TuningSearch, WithinAnErrorItTakesTheCheapest) {
  // c costs half of a and 0.01 of deviation: within 10 % it pays, within 1 % it does not.
  const Searched wide = search({}, {.within = 0.10});
  EXPECT_EQ(wide.best.settings.at("solver"), Setting(std::string("c")));
  EXPECT_LE(wide.best.score.worst, 1);
  const Searched narrow = search({}, {.within = 0.01});
  EXPECT_FALSE(narrow.best.settings.contains("solver"));
  EXPECT_LE(narrow.best.score.worst, 1);
}

TEST(TuningSearch, OfEqualErrorsTheEnginesOwnValueIsKeptWhateverTheTimes) {
  // b's error is a's at twice the time, and at a thousandth.
  for (const double factor : {1.0, 5e-4}) {
    const TuningRuns timed = [&](const Settings& settings, std::size_t phases,
                                 std::span<const TuningTask* const> tasks) {
      auto scores = synthetic_runs()(settings, phases, tasks);
      if (settings.contains("solver"))
        for (auto& score : scores) score->cpu_seconds *= factor;
      return scores;
    };
    const Searched found = search({{"solver", std::string("b")}}, {}, {}, timed, {"solver"});
    EXPECT_TRUE(found.best.settings.empty());
  }
}

TEST(TuningSearch, BeginsFromTheBestProfile) {
  const Settings good{{"body", std::string("multi")}, {"warm", true}, {"split", true}};
  TuningSpace space = tuning_space(synthetic_engine(), {{"idle", true}});
  add_start(space, "bad", {{"warm", true}});
  add_start(space, "good", good);
  add_start(space, "same", good);
  ASSERT_EQ(space.others.size(), 2u);
  TuningJournal journal;
  TuningEvaluator evaluator(synthetic_tasks(), "test", {}, 16, synthetic_runs(), journal,
                            {.evaluations = 0});
  TuningSearch search(space, evaluator, {});
  search.run();
  EXPECT_EQ(search.origin(), good);
  EXPECT_EQ(search.best().settings, good);
  EXPECT_EQ(search.evaluated().front().settings, (Settings{{"idle", true}}));
}

TEST(TuningSpace, AProfileToBeginFromChangesTheNamedSettingsOnly) {
  TuningSpace space = tuning_space(synthetic_engine(), {{"idle", true}, {"warm", true}}, {"warm"});
  add_start(space, "other", {{"body", std::string("multi")}, {"split", true}}, {"warm"});
  ASSERT_EQ(space.others.size(), 1u);
  EXPECT_EQ(space.others[0].settings, (Settings{{"idle", true}}));
}

TEST(TuningSearch, WhatLosesEarlyIsNotRunAtTheHigherRates) {
  // Started from the optimum, every change for the worse costs two runs of four phases at 240 Hz.
  const Settings optimum{{"body", std::string("multi")},
                         {"erp", 0.3},
                         {"threshold", 1e-3},
                         {"warm", true},
                         {"split", true}};
  std::size_t slow = 0, fast = 0;
  const TuningRuns counted = [&](const Settings& settings, std::size_t phases,
                                 std::span<const TuningTask* const> tasks) {
    for (const TuningTask* task : tasks)
      if (settings != optimum && !settings.contains("idle") && !settings.contains("solver")) {
        EXPECT_EQ(phases, 4u);
        ++(task->rate == 240 ? slow : fast);
      }
    return synthetic_runs()(settings, phases, tasks);
  };
  const Searched found = search(optimum, {}, {}, counted);
  EXPECT_EQ(found.best.settings, optimum);
  EXPECT_GT(slow, 0u);
  EXPECT_EQ(fast, 0u);
}

TEST(TuningSearch, WhatDoesTheSameIsNotRunWithAllPhases) {
  // idle and b change no error: a quarter of the phases shows it.
  std::size_t few = 0;
  const TuningRuns counted = [&](const Settings& settings, std::size_t phases,
                                 std::span<const TuningTask* const> tasks) {
    if (!settings.empty() && settings != Settings{{"solver", std::string("c")}}) {
      EXPECT_EQ(phases, 4u);
      few += tasks.size();
    }
    return synthetic_runs()(settings, phases, tasks);
  };
  search({}, {}, {}, counted, {"idle", "solver"});
  // Two scenes at two rates for idle, for b and for both; idle with c is worse at 240 Hz.
  EXPECT_EQ(few, 3u * 4u + 2u);
}

TEST(TuningSearch, ABudgetEndsItWithTheBestSoFar) {
  const Searched whole = search({});
  const Searched some = search({}, {}, {.evaluations = 6});
  EXPECT_FALSE(some.converged);
  // The budget is looked at before each stage of a race, of at most one evaluation; pruning what
  // was found follows, at most 1.25 for each of the seven settings.
  EXPECT_GE(some.spent, 6);
  EXPECT_LT(some.spent, 7 + 7 * 1.25);
  EXPECT_LE(some.best.score.worst, some.evaluated.front().score.worst);
  EXPECT_GT(some.best.score.worst, whole.best.score.worst);
}

TEST(TuningSearch, WithoutABudgetTheStartIsAllThatIsSeen) {
  const Searched none = search({}, {}, {.evaluations = 0});
  EXPECT_FALSE(none.converged);
  EXPECT_EQ(none.evaluated.size(), 1u);
  EXPECT_TRUE(none.best.settings.empty());
  EXPECT_GT(none.best.score.worst, 0);
}

TEST(TuningSearch, TheSameSeedMakesTheSameSearch) {
  const auto order = [] {
    std::vector<Settings> seen;
    const TuningRuns noting = [&](const Settings& settings, std::size_t phases,
                                  std::span<const TuningTask* const> tasks) {
      seen.push_back(settings);
      return synthetic_runs()(settings, phases, tasks);
    };
    search({}, {}, {}, noting);
    return seen;
  };
  EXPECT_EQ(order(), order());
}

TEST(TuningSearch, AFailedRunIsWorseThanAnyErrorAndFewerFailuresAreBetter) {
  // multi loses all phases, single one of 16; erp 0 saves that one too.
  const TuningRuns failing = [](const Settings& settings, std::size_t,
                                std::span<const TuningTask* const> tasks) {
    std::vector<std::optional<RunScore>> scores;
    for (const TuningTask* task : tasks) {
      RunScore score = test::synthetic_score(settings, *task);
      const bool multi = settings.contains("body"), saved = settings.contains("erp");
      score.failed = multi ? 1 : saved ? 0 : 1. / 16;
      scores.push_back(score);
    }
    return scores;
  };
  const Searched found = search({{"body", std::string("multi")}}, {}, {}, failing, {"body", "erp"});
  EXPECT_FALSE(found.best.settings.contains("body"));
  EXPECT_TRUE(found.best.settings.contains("erp"));
  EXPECT_EQ(found.best.score.failed, 0);
}

}  // namespace
}  // namespace slipcheck
