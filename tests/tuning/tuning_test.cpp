#include "studies/tuning/tuning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "../support/text_of.h"
#include "tuning_synthetic.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;
using test::synthetic_engine;
using test::synthetic_runs;
using test::synthetic_tasks;

struct Tuning : testing::Test {
  fs::path file = fs::path(testing::TempDir()) /
                  (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
                   std::to_string(getpid()) + ".journal");
  ~Tuning() override { fs::remove(file); }

  TuningResult tuned(const TuningRuns& runs, bool held_out = false, const Settings& start = {},
                     const TuningGoal& goal = {}) const {
    const TuningSpace space = tuning_space(synthetic_engine(), start);
    TuningJournal journal(file);
    TuningEvaluator evaluator(synthetic_tasks(held_out), "test", {}, 16, runs, journal, {});
    return tune(space, evaluator, {{goal, 1, {}}, 64});
  }
  std::string text() const { return test::text_of(file); }
  void write(const std::string& what) const { std::ofstream(file) << what; }
};

void expect_same(const TuningResult& a, const TuningResult& b) {
  EXPECT_EQ(a.chosen, b.chosen);
  EXPECT_EQ(a.candidates, b.candidates);
  EXPECT_EQ(a.evaluations, b.evaluations);
  ASSERT_EQ(a.finalists.size(), b.finalists.size());
  for (std::size_t k = 0; k < a.finalists.size(); ++k) {
    EXPECT_EQ(a.finalists[k].settings, b.finalists[k].settings);
    EXPECT_EQ(a.finalists[k].runs, b.finalists[k].runs);
  }
  ASSERT_EQ(a.front.size(), b.front.size());
  for (std::size_t k = 0; k < a.front.size(); ++k)
    EXPECT_EQ(a.front[k].settings, b.front[k].settings);
}

TEST_F(Tuning, AJournalCutAnywhereLeadsToTheSameResult) {
  const TuningResult whole = tuned(synthetic_runs(), true);
  const std::string journal = text();
  ASSERT_GT(journal.size(), 20000u);
  // Also within the head and in the middle of lines; 1009 is prime to the length of lines.
  for (std::size_t cut = 0; cut < journal.size();
       cut += cut < 60 ? 7 : journal.size() / 20 + 1009) {
    SCOPED_TRACE(cut);
    write(journal.substr(0, cut));
    expect_same(tuned(synthetic_runs(), true), whole);
    // And the journal is whole again: the cut line is gone, everything is there once.
    EXPECT_EQ(std::ranges::count(text(), '\n'), std::ranges::count(journal, '\n'));
    EXPECT_EQ(TuningJournal(file).size() + 1,
              static_cast<std::size_t>(std::ranges::count(journal, '\n')));
  }
}

TEST_F(Tuning, AnInterruptedOneGoesOnWhereItWas) {
  const TuningResult whole = tuned(synthetic_runs());
  const std::string journal = text();
  fs::remove(file);
  std::size_t allowed = 0, runs = 0;
  // Each session may run so many ensembles; the batch in which it stops keeps what had finished.
  const TuningRuns stopping = [&](const Settings& settings, std::size_t,
                                  std::span<const TuningTask* const> tasks) {
    std::vector<std::optional<RunScore>> scores;
    for (const TuningTask* task : tasks) {
      if (allowed > 0) {
        --allowed;
        ++runs;
        scores.push_back(test::synthetic_score(settings, *task));
      } else {
        scores.push_back(std::nullopt);
      }
    }
    return scores;
  };
  std::optional<TuningResult> result;
  std::size_t sessions = 0;
  for (; !result; ++sessions) {
    ASSERT_LT(sessions, 1000u);
    allowed = 37;
    try {
      result = tuned(stopping);
    } catch (const TuningInterrupted&) {
    }
  }
  EXPECT_GT(sessions, 5u);
  expect_same(*result, whole);
  // Nothing was run twice: one line for each run, and the head.
  EXPECT_EQ(runs + 1, static_cast<std::size_t>(std::ranges::count(journal, '\n')));
}

TEST_F(Tuning, AFinishedJournalAnswersEverything) {
  const TuningResult first = tuned(synthetic_runs());
  const TuningRuns none = [](const Settings&, std::size_t, std::span<const TuningTask* const>)
      -> std::vector<std::optional<RunScore>> { throw std::logic_error("was run"); };
  expect_same(tuned(none), first);
}

TEST_F(Tuning, WhatMissesTheGoalOnAllPhasesIsNotChosenHoweverCheap) {
  // Solver c takes half the time, and what it does wrong does not show in few phases.
  const auto is_c = [](const Settings& settings) {
    return test::chosen<std::string>(synthetic_engine(), settings, "solver") == "c";
  };
  const TuningRuns runs = [&](const Settings& settings, std::size_t phases,
                              std::span<const TuningTask* const> tasks) {
    std::vector<std::optional<RunScore>> scores;
    for (const TuningTask* task : tasks) {
      RunScore score = test::synthetic_score(settings, *task);
      if (is_c(settings) && phases == 64) score.deviation = 0.2;
      scores.push_back(score);
    }
    return scores;
  };
  const TuningResult result = tuned(runs, false, {}, {0.1});
  EXPECT_FALSE(is_c(result.best().settings));
  EXPECT_LE(result.best().training.worst, 1);
  EXPECT_GT(result.start().training.worst, 1);
}

TEST_F(Tuning, ScenesThatItDidNotSeeShowOverfitting) {
  const TuningResult result = tuned(synthetic_runs(), true);
  ASSERT_TRUE(result.best().held_out);
  // 0.5 where it was fitted, 10 more on the scene held out.
  EXPECT_NEAR(result.best().training.worst, 0.5, 0.03);
  EXPECT_NEAR(result.best().held_out->worst, 10.5, 0.03);
  EXPECT_TRUE(result.overfitted());
  EXPECT_FALSE(tuned(synthetic_runs(), false).overfitted());
}

TEST_F(Tuning, TheStartStaysWhereNothingIsBetter) {
  const Settings optimum{{"body", std::string("multi")},
                         {"erp", 0.3},
                         {"threshold", 1e-3},
                         {"warm", true},
                         {"split", true}};
  const TuningResult result = tuned(synthetic_runs(), false, optimum);
  EXPECT_EQ(result.chosen, 0u);
  EXPECT_FALSE(result.improved());
  EXPECT_EQ(result.best().settings, optimum);
}

TEST_F(Tuning, TheSameSeedFindsTheSameWhateverTheTimes) {
  // Times of a loaded machine: any factor from 1/100 to 100, never the same.
  std::mt19937 random(std::random_device{}());
  std::uniform_real_distribution<> exponent(-2, 2);
  const TuningRuns scattering = [&](const Settings& settings, std::size_t phases,
                                    std::span<const TuningTask* const> tasks) {
    auto scores = synthetic_runs()(settings, phases, tasks);
    for (auto& score : scores) score->cpu_seconds *= std::pow(10, exponent(random));
    return scores;
  };
  const TuningResult first = tuned(scattering);
  for (int k = 0; k < 7; ++k) {
    fs::remove(file);
    const TuningResult again = tuned(scattering);
    EXPECT_EQ(again.best().settings, first.best().settings);
    EXPECT_EQ(again.evaluations, first.evaluations);
    EXPECT_EQ(again.candidates, first.candidates);
    ASSERT_EQ(again.finalists.size(), first.finalists.size());
    for (std::size_t n = 0; n < first.finalists.size(); ++n)
      EXPECT_EQ(again.finalists[n].settings, first.finalists[n].settings);
  }
}

TEST_F(Tuning, AProfileThatNothingBeatsIsChosenByItsName) {
  const Settings optimum{{"body", std::string("multi")},
                         {"erp", 0.3},
                         {"threshold", 1e-3},
                         {"warm", true},
                         {"split", true}};
  TuningSpace space = tuning_space(synthetic_engine(), {});
  add_start(space, "shipped", optimum);
  TuningJournal journal;
  TuningEvaluator evaluator(synthetic_tasks(), "test", {}, 16, synthetic_runs(), journal, {});
  const TuningResult result = tune(space, evaluator, {{{}, 1, {}}, 64}, "default");
  EXPECT_EQ(result.start().profile, "default");
  EXPECT_TRUE(result.start().settings.empty());
  EXPECT_FALSE(result.improved());
  EXPECT_EQ(result.best().profile, "shipped");
  EXPECT_EQ(result.best().settings, optimum);
}

TEST_F(Tuning, WhatWinsWithFewPhasesOnlyIsNotChosen) {
  // With 64 phases erp 0 turns out to be far worse than it looked with 16.
  const TuningRuns deceiving = [](const Settings& settings, std::size_t phases,
                                  std::span<const TuningTask* const> tasks) {
    std::vector<std::optional<RunScore>> scores;
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      RunScore score;
      const bool zero = settings.contains("erp") && settings.at("erp") == Setting(0.0);
      score.worst = zero ? (phases == 64 ? 50 : 1) : 2;
      score.simulated_seconds = score.cpu_seconds = 1;
      scores.push_back(score);
    }
    return scores;
  };
  const TuningResult result = tuned(deceiving);
  EXPECT_EQ(result.best().training.worst, 2);
}

TEST(ParetoFront, HoldsWhatNothingElseBeatsInBoth) {
  const auto candidate = [](double worst, double cost) {
    TuningCandidate made;
    made.score.worst = worst;
    made.score.cost = cost;
    return made;
  };
  const auto front = pareto_front(
      {candidate(5, 3), candidate(9, 1), candidate(4, 2), candidate(4, 4), candidate(1, 8)});
  ASSERT_EQ(front.size(), 3u);
  EXPECT_EQ(front[0].score.worst, 9);
  EXPECT_EQ(front[1].score.worst, 4);
  EXPECT_EQ(front[1].score.cost, 2);
  EXPECT_EQ(front[2].score.worst, 1);
}

}  // namespace
}  // namespace slipcheck
