#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/engine.h"
#include "studies/tuning/tuning_journal.h"
#include "studies/tuning/tuning_score.h"

namespace slipcheck {

/// A scene at a rate.
struct TuningTask {
  std::string scene;   ///< its name
  std::string sha256;  ///< of its file
  double rate = 0;     ///< [Hz], > 0
  bool held_out = false;

  std::size_t scene_index = 0;  ///< among those that are there to run
};

/// Runs an engine with these settings on tasks, each as an ensemble of `phases`; the scores in the
/// order of the tasks, nothing where the user interrupted it.
using TuningRuns = std::function<std::vector<std::optional<RunScore>>(
    const Settings& settings, std::size_t phases, std::span<const TuningTask* const> tasks)>;

/// As much as may be spent.
struct TuningBudget {
  /// Evaluations of all training tasks with the phases of the search, >= 0; fewer tasks or phases
  /// count as the share that they are.
  double evaluations = 500;
  /// Wall time of the runs, also of those that the journal already had [s], > 0.
  double seconds = std::numeric_limits<double>::infinity();
};

/// The user asked to stop; what had finished is in the journal.
class TuningInterrupted : public std::runtime_error {
 public:
  TuningInterrupted() : std::runtime_error("interrupted") {}
};

/// Thrown in the middle of a search that has spent its budget.
class TuningBudgetSpent : public std::runtime_error {
 public:
  TuningBudgetSpent() : std::runtime_error("the budget is spent") {}
};

/// Answers what settings come to, from the journal where it is there. The same answers make the
/// same search: what has been spent counts answers from the journal as if they were new.
class TuningEvaluator {
 public:
  /// `identity`: what besides settings, task, phases and observables an answer depends on: programs
  /// and versions. `phases`: of the search, >= 1. The journal outlives the evaluator.
  TuningEvaluator(std::vector<TuningTask> tasks, std::string identity,
                  const TuningObservables& observables, std::size_t phases, TuningRuns runs,
                  TuningJournal& journal, const TuningBudget& budget);

  const std::vector<TuningTask>& tasks() const { return tasks_; }
  std::size_t phases() const { return phases_; }

  /// The scores of these tasks (by index), in their order. Throws TuningInterrupted, and
  /// TuningBudgetSpent where the budget was spent before and is heeded.
  std::vector<RunScore> evaluate(const Settings& settings, std::size_t phases,
                                 std::span<const std::size_t> tasks);

  /// Whether a spent budget ends evaluate(); at first it does not.
  void heed_budget(bool heed) { heeds_budget_ = heed; }

  double spent() const { return spent_; }  ///< in evaluations
  const TuningBudget& budget() const { return budget_; }
  std::size_t runs() const { return counted_.size(); }  ///< ensembles, each counted once

 private:
  std::string question(const Settings& settings, std::size_t phases, const TuningTask& task) const;
  void count(const std::string& question, const TuningTask& task, std::size_t phases,
             double seconds);

  std::vector<TuningTask> tasks_;
  std::string identity_;
  TuningObservables observables_;
  std::size_t phases_;
  TuningRuns runs_;
  TuningJournal* journal_;
  TuningBudget budget_;
  bool heeds_budget_ = false;
  double whole_ = 0;  ///< an evaluation's rate times phases
  double spent_ = 0, seconds_ = 0;
  std::set<std::string> counted_;
};

}  // namespace slipcheck
