#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "studies/tuning/tuning_search.h"

namespace slipcheck {

struct TuningOptions {
  TuningSearchOptions search;
  std::size_t final_phases = 64;  ///< of the last comparison, >= 1
};

/// Settings on all phases of the last comparison.
struct TuningFinalist {
  std::string profile;  ///< of those to begin from; empty: found by the search
  Settings settings;
  std::vector<RunScore> runs;  ///< of all tasks, in the evaluator's order
  Score training;
  std::optional<Score> held_out;  ///< where there are such scenes
};

/// How a tuning ended.
struct TuningResult {
  /// The start first, then the profile that the search began from where it is another, then the
  /// best of the search, best first.
  std::vector<TuningFinalist> finalists;
  std::size_t chosen = 0;  ///< of the finalists, by the training scenes alone
  /// Of all that the training tasks have seen in the search: those than which nothing is both
  /// better and cheaper, the cheapest first.
  std::vector<TuningCandidate> front;
  std::size_t candidates = 0;  ///< that the training tasks have seen
  double evaluations = 0;      ///< as of TuningBudget
  bool converged = false;      ///< else the budget ended the search

  const TuningFinalist& best() const { return finalists[chosen]; }
  const TuningFinalist& start() const { return finalists.front(); }
  /// The search has found something better than all that it began from.
  bool improved() const { return best().profile.empty(); }
  /// The worst error on scenes that were not seen is more than twice that on those that were.
  bool overfitted() const;
};

/// Searches, then compares start and best on final phases, held-out scenes too. Throws
/// TuningInterrupted.
/// `start`: the start's name.
TuningResult tune(const TuningSpace& space, TuningEvaluator& evaluator,
                  const TuningOptions& options, const std::string& start = "start");

/// Those of the candidates than which none is both better (worst error) and cheaper, cheapest
/// first.
std::vector<TuningCandidate> pareto_front(std::vector<TuningCandidate> candidates);

}  // namespace slipcheck
