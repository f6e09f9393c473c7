#include "studies/tuning/tuning_score.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenario/observable_key.h"

namespace slipcheck {
namespace {

/// What the mean error weighs beside the worst one.
constexpr double kMeanShare = 0.02;
/// Objectives that differ by less, relatively, are the same.
constexpr double kSameObjective = 1e-3;
/// Stands for one error where the scene says nothing: 1 %, or 0.01 of a restitution.
constexpr double kDefaultTolerance = 0.01;

std::string failure_text(const std::string& what, double failed, const std::string& why) {
  const std::string phases = failed >= 1 ? "all" : fmt::format("{:.3g} % of the", 100 * failed);
  return fmt::format("{} fails in {} phases{}{}", what, phases, why.empty() ? "" : ": ", why);
}

double error_of(const RunScore& run, const TuningGoal& goal) {
  if (run.failed > 0) return kLargestError * (1 + run.failed);
  return goal.within ? std::min(run.deviation / *goal.within, kLargestError) : run.worst;
}

}  // namespace

std::optional<double> TuningObservables::tolerance(const std::string& name,
                                                   const Deviation& deviation) const {
  if (named.empty()) return deviation.tolerance;
  if (std::ranges::count(named, observable_key(name).bare()) == 0) return std::nullopt;
  return deviation.tolerance.value_or(kDefaultTolerance);
}

RunScore score_of(const EngineRecord& record, const TuningObservables& observables,
                  std::size_t phases) {
  RunScore score;
  score.cpu_seconds = record.cpu_seconds;
  score.simulated_seconds = static_cast<double>(record.steps) / record.rate;
  if (record.status != EngineRecord::Status::ok) {
    score.failed =
        1 - std::min(static_cast<double>(record.phases) / static_cast<double>(phases), 1.0);
    // The last one may have failed after all of its steps.
    score.failed = std::max(score.failed, 1 / static_cast<double>(phases));
    score.reason = fmt::format("{}: {}", name_of(record.status), record.reason);
    return score;
  }
  for (const auto& [name, deviation] : record.errors) {
    const auto tolerance = observables.tolerance(name, deviation);
    if (!tolerance || deviation.is_zero || deviation.verdict == Verdict::undecided) continue;
    const auto seen = record.observables.find(name);
    const double missing =
        seen == record.observables.end()
            ? 1
            : static_cast<double>(seen->second.missing) /
                  static_cast<double>(std::max<std::size_t>(seen->second.values.size(), 1));
    // Without a number, but shown: by the engine alone, or where the reference is zero.
    const double failed = std::isnan(deviation.max) && missing < 1 ? 1 - missing : missing;
    if (failed > score.failed) {
      score.failed = failed;
      score.reason = failure_text(name, failed, deviation.reason);
    }
    if (std::isnan(deviation.max)) continue;
    const double error = *tolerance > 0      ? deviation.max / *tolerance
                         : deviation.max > 0 ? kLargestError
                                             : 0;
    score.deviation = std::max(score.deviation, std::min(deviation.max, kLargestError));
    if (score.observable.empty() || error > score.worst) {
      score.worst = std::min(error, kLargestError);
      score.observable = name;
    }
  }
  return score;
}

Score score_of(std::span<const RunScore> runs, const TuningGoal& goal) {
  Score score;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const double error = error_of(runs[k], goal);
    if (error > score.worst) score.worst_run = k;
    score.worst = std::max(score.worst, error);
    score.mean += error;
    score.failed = std::max(score.failed, runs[k].failed);
    if (runs[k].simulated_seconds > 0)
      score.cost += runs[k].cpu_seconds / runs[k].simulated_seconds;
  }
  if (!runs.empty()) {
    score.mean /= static_cast<double>(runs.size());
    score.cost /= static_cast<double>(runs.size());
  }
  return score;
}

double objective(const Score& score, const TuningGoal& goal) {
  if (goal.within && score.worst <= 1) return 1;
  return score.worst + kMeanShare * score.mean;
}

bool is_better(const Score& a, const Score& b, const TuningGoal& goal) {
  const double left = objective(a, goal), right = objective(b, goal);
  if (std::abs(left - right) > kSameObjective * std::max(left, right)) return left < right;
  return goal.within && a.cost < (1 - kSameCost) * b.cost;
}

}  // namespace slipcheck
