#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "studies/tuning/tuning_evaluator.h"
#include "studies/tuning/tuning_score.h"
#include "studies/tuning/tuning_space.h"

namespace slipcheck {

/// Settings that all training tasks have seen.
struct TuningCandidate {
  Settings settings;           ///< canonical
  std::vector<RunScore> runs;  ///< of the training tasks, in the evaluator's order
  Score score;
  std::vector<RunScore> few;  ///< the same with the few phases that a race begins with
};

struct TuningSearchOptions {
  TuningGoal goal;
  std::uint64_t seed = 1;
  /// Told of the start and of each improvement, with the step of the search ("one by one").
  std::function<void(const std::string& step, const TuningCandidate& best)> improved;
};

/// The search for the best settings, outward from the best of the start and the space's other
/// profiles:
///
/// 1. one by one: each candidate of each setting, in a seeded order, keeping what is better, until
///    nothing is; then pairs of candidates, as some settings help only together, and again.
/// 2. continuous: of the settings with a range, those that make the result better when varied alone
///    go to NLopt's Sbplx together (a subspace simplex: the worst case of many is not smooth), in
///    coordinates that are logarithms where the range is so; then 1. again.
/// 3. pruning: every setting returns to the engine's own value where that costs no more than 1 % of
///    the objective, so that the result says only what matters.
///
/// Settings race: a few phases first, the cheapest rates first, and what is already worse there
/// than the best so far on everything is not looked at further. Deterministic, given the answers.
class TuningSearch {
 public:
  static constexpr double kPruningCost = 0.01;  ///< of the objective

  /// Space and evaluator outlive the search.
  TuningSearch(const TuningSpace& space, TuningEvaluator& evaluator, TuningSearchOptions options);

  /// Searches until nothing improves or the budget is spent, and says which: true where nothing
  /// improves any more. Start and profiles are seen whatever the budget. Throws TuningInterrupted.
  bool run();

  const TuningCandidate& best() const { return best_; }
  /// From where the search went outward.
  const Settings& origin() const { return origin_; }
  /// Every candidate that all tasks have seen, in the order of their evaluation; the start first.
  const std::vector<TuningCandidate>& evaluated() const { return evaluated_; }

 private:
  /// What a race asks of settings with few phases.
  enum class Entry {
    free,       ///< nothing
    different,  ///< not to do the same as the best so far at no less cost
    gain,       ///< to be better than the best so far
  };
  struct Stage {
    std::size_t phases = 0;
    bool ends_few = false;           ///< the last one with few phases
    std::vector<std::size_t> tasks;  ///< of the training tasks, by place in training_
  };
  /// What settings came to: a score of all tasks, or a lower bound of its objective.
  struct Outcome {
    double objective = 0;
    bool whole = false;
    TuningCandidate candidate;
  };

  void make_stages();
  Outcome race(const Settings& settings, double limit, Entry entry);
  bool may_go_on(const TuningCandidate& candidate, const Stage& stage, Entry entry) const;
  bool consider(const Settings& settings, const std::string& step, Entry entry = Entry::different);
  void adopt(const TuningCandidate& candidate, const std::string& step);

  void search_discrete();
  bool try_single_moves();
  bool try_pairs_of_moves();
  bool search_continuous();
  std::vector<const SettingInfo*> settings_that_matter();
  void prune();

  /// Shuffled alike on every platform.
  template <class T>
  void shuffle(std::vector<T>& list);

  const TuningSpace* space_;
  TuningEvaluator* evaluator_;
  TuningSearchOptions options_;
  std::vector<std::size_t> training_;  ///< tasks
  std::vector<Stage> stages_;
  std::uint64_t random_;
  TuningCandidate best_;
  Settings origin_;
  std::vector<TuningCandidate> evaluated_;
};

}  // namespace slipcheck
