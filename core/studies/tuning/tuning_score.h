#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/compare/record.h"

namespace slipcheck {

/// An error that is larger counts as this many tolerances: far beyond, nothing is to be learnt.
inline constexpr double kLargestError = 1e4;

/// How one engine run, a scene at one rate, stands to the reference in its worst phase.
struct RunScore {
  double worst = 0;        ///< largest deviation over its tolerance, 0 … kLargestError
  std::string observable;  ///< whose it is, "i.sliding_time"
  double deviation = 0;    ///< largest deviation itself, as of Deviation; 0 … kLargestError
  /// Share of the phases that came to nothing or lack an observable, 0 … 1.
  double failed = 0;
  double cpu_seconds = 0;        ///< of the stepping
  double simulated_seconds = 0;  ///< that it stepped through, >= 0
  std::string reason;            ///< what failed, in how many phases, and why

  bool operator==(const RunScore&) const = default;
};

/// Which observables count: those with a tolerance in the scene, or those named here (without the
/// body's name), and then an error of 1 % (restitution: 0.01) counts as one where the scene has no
/// tolerance for it.
struct TuningObservables {
  std::vector<std::string> named;

  /// What stands for one error of this observable ("i.sliding_time") of a run; nothing where it
  /// does not count.
  std::optional<double> tolerance(const std::string& name, const Deviation& deviation) const;
};

/// The score of a finished run of `phases` phases, >= 1.
RunScore score_of(const EngineRecord& record, const TuningObservables& observables,
                  std::size_t phases);

/// What is wanted.
struct TuningGoal {
  /// Without: the least error. With: the least CPU time of those that deviate by no more than this
  /// (relative; absolute for restitution), > 0.
  std::optional<double> within;
};

/// Settings over several runs. An error is the deviation over the scene's tolerance, or over what
/// it must be `within`; a run that failed has 1 + (share of failed phases) times kLargestError.
struct Score {
  double worst = 0;           ///< of all runs
  double mean = 0;            ///< of the runs' worst phases
  double cost = 0;            ///< CPU time for a second of simulated time, mean over the runs [-]
  double failed = 0;          ///< largest share of failed phases, 0 … 1
  std::size_t worst_run = 0;  ///< whose `worst` is
};
Score score_of(std::span<const RunScore> runs, const TuningGoal& goal);

/// What the search makes small: the worst error, and with little weight the mean one, so that there
/// is a slope where the worst run does not change. Of a goal with `within`, 1 as soon as it is met.
double objective(const Score& score, const TuningGoal& goal);

/// The share by which CPU times must differ to count, as they scatter.
inline constexpr double kSameCost = 0.1;

/// Whether `a` is to be preferred: its objective is smaller by more than 0.1 %, or, with a goal
/// `within`, they are the same within that and `a` takes less CPU time by more than kSameCost.
/// Without, no time decides anything: the same errors make the same search.
bool is_better(const Score& a, const Score& b, const TuningGoal& goal);

}  // namespace slipcheck
