#include "report/rows/version_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "report/rows/comparison_rows.h"
#include "report/rows/phase_spread.h"
#include "report/rows/quantity.h"
#include "report/rows/selection.h"

namespace slipcheck {
namespace {

using RunPair = std::pair<const EngineRecord*, const EngineRecord*>;

std::vector<RunPair> run_pairs(const SceneRecord& scene) {
  std::vector<RunPair> pairs;
  const std::size_t half = scene.runs.size() / 2;
  for (std::size_t k = 0; k < half; ++k) pairs.emplace_back(&scene.runs[k], &scene.runs[half + k]);
  return pairs;
}

bool is_ok(const EngineRecord& run) { return run.status == RunStatus::ok; }

/// Nothing to hold against each other: neither of the two has run.
bool are_skipped(const RunPair& pair) {
  return pair.first->status == RunStatus::skipped && pair.second->status == RunStatus::skipped;
}

std::vector<double> sorted_finite(const RunSpread& spread) {
  std::vector<double> values;
  for (const double value : spread.values)
    if (std::isfinite(value)) values.push_back(value);
  std::ranges::sort(values);
  return values;
}

/// The largest difference of two values that have as many below them; infinite where there are more
/// of the one.
double largest_move(const RunSpread& before, const RunSpread& after) {
  const std::vector<double> one = sorted_finite(before), other = sorted_finite(after);
  if (one.size() != other.size()) return INFINITY;
  double largest = 0;
  for (std::size_t k = 0; k < one.size(); ++k)
    largest = std::max(largest, std::abs(one[k] - other[k]));
  return largest;
}

const RunSpread* spread_of(const PhaseSpread& spread, const EngineRecord* run) {
  const auto found = std::ranges::find(spread.runs, run, &RunSpread::run);
  return found == spread.runs.end() ? nullptr : &*found;
}

/// In tolerances; NaN without.
double worst_error(const EngineRecord& run, const std::string& observable) {
  const auto found = run.errors.find(observable);
  if (found == run.errors.end() || !found->second.tolerance) return NAN;
  return found->second.max / *found->second.tolerance;
}

VersionChange change_in(const SceneRecord& scene, const RunPair& pair, const PhaseSpread& spread) {
  VersionChange change{&scene, pair.first, pair.second, spread.name};
  change.error_before = worst_error(*pair.first, spread.name);
  change.error_after = worst_error(*pair.second, spread.name);
  const RunSpread* before = spread_of(spread, pair.first);
  const RunSpread* after = spread_of(spread, pair.second);
  const double tolerance = (spread.high - spread.low) / 2;
  if (before && after)
    change.moved = tolerance > 0 ? largest_move(*before, *after) / tolerance : INFINITY;
  else
    change.moved = before || after ? INFINITY : 0;
  return change;
}

/// What has a tolerance, and what looks just the same, as two bodies do that mirror each other.
struct Told {
  PhaseSpread spread;
  std::vector<std::string> twins;
};

std::vector<Told> told_spreads(const SceneRecord& scene) {
  std::vector<Told> told;
  for (const std::string& name : shown_observables(scene, false)) {
    auto spread = phase_spread(scene, name);
    if (!spread) continue;
    const auto twin = std::ranges::find_if(
        told, [&](const Told& other) { return look_alike(other.spread, *spread); });
    if (twin == told.end())
      told.push_back({std::move(*spread), {}});
    else
      twin->twins.push_back(name);
  }
  return told;
}

/// Every value that has a tolerance, moved or not.
std::vector<VersionChange> all_changes(const VersionComparison& comparison) {
  std::vector<VersionChange> changes;
  for (const SceneRecord& scene : comparison.scenes) {
    const std::vector<Told> spreads = told_spreads(scene);
    for (const RunPair& pair : run_pairs(scene)) {
      if (are_skipped(pair)) continue;
      if (is_ok(*pair.first) && is_ok(*pair.second)) {
        for (const auto& [spread, twins] : spreads) {
          changes.push_back(change_in(scene, pair, spread));
          changes.back().twins = twins;
        }
      } else if (pair.first->status != pair.second->status) {
        VersionChange change{&scene, pair.first, pair.second, ""};
        change.moved = INFINITY;
        changes.push_back(change);
      }
    }
  }
  return changes;
}

/// "0.369 … 0.805 … 0.809": the smallest, the middle and the largest over the phases.
std::string distribution_text(const EngineRecord& run, const std::string& observable,
                              const QuantityFormat& format) {
  const auto found = run.observables.find(observable);
  if (found == run.observables.end() || !std::isfinite(found->second.median)) return "–";
  const EnsembleValue& value = found->second;
  const std::string low = format.number(value.min), middle = format.number(value.median),
                    high = format.number(value.max);
  std::string text = low == high ? low : fmt::format("{} … {} … {}", low, middle, high);
  if (value.missing > 0) text += fmt::format(" ({} none)", value.missing);
  return text;
}

std::string status_of(const EngineRecord& run) {
  return run.reason.empty() ? status_text(run.status)
                            : fmt::format("{}: {}", status_text(run.status), run.reason);
}

Cell error_cell(double error) {
  if (!std::isfinite(error)) return {"–"};
  return {plain_number(error), error > 1 ? Tone::bad : Tone::good, error};
}

Cell moved_cell(double moved) {
  return {std::isfinite(moved) ? plain_number(moved) : "all", Tone::strong, moved};
}

std::vector<Cell> cells_of(const VersionChange& change) {
  const EngineRecord& run = *change.after;
  std::vector<Cell> cells = {{change.scene->scenario.name},
                             {fmt::format("{} {:g} Hz", run.profile, run.rate)}};
  if (change.observable.empty()) {
    for (Cell cell : {Cell{"(whole run)"}, Cell{}, Cell{status_of(*change.before)},
                      Cell{status_of(run)}, Cell{}, Cell{}, moved_cell(change.moved)})
      cells.push_back(std::move(cell));
    return cells;
  }
  const auto shown = run.observables.find(change.observable);
  const QuantityFormat format = format_for(
      *change.scene, change.observable, shown == run.observables.end() ? nullptr : &shown->second);
  cells.push_back({change.twins.empty() ? change.observable
                                        : fmt::format("{} (and {})", change.observable,
                                                      fmt::join(change.twins, ", "))});
  cells.push_back(reference_cell(*change.scene, change.observable, format));
  cells.push_back({distribution_text(*change.before, change.observable, format)});
  cells.push_back({distribution_text(run, change.observable, format)});
  cells.push_back(error_cell(change.error_before));
  cells.push_back(error_cell(change.error_after));
  cells.push_back(moved_cell(change.moved));
  return cells;
}

}  // namespace

std::vector<VersionChange> version_changes(const VersionComparison& comparison) {
  std::vector<VersionChange> changes = all_changes(comparison);
  std::erase_if(
      changes, [&](const VersionChange& change) { return !(change.moved > comparison.threshold); });
  const auto worst = [](const VersionChange& change) {
    return std::fmax(change.error_before, change.error_after);
  };
  std::ranges::stable_sort(changes, [&](const VersionChange& one, const VersionChange& other) {
    if (one.moved != other.moved) return one.moved > other.moved;
    return worst(one) > worst(other);
  });
  return changes;
}

VersionTotals totals_of(const VersionComparison& comparison,
                        const std::vector<VersionChange>& changes) {
  VersionTotals totals;
  for (const SceneRecord& scene : comparison.scenes)
    for (const RunPair& pair : run_pairs(scene)) {
      totals.runs += are_skipped(pair) ? 0 : 1;
      totals.failed += is_ok(*pair.second) || pair.second->status == RunStatus::skipped ? 0 : 1;
    }
  totals.compared = all_changes(comparison).size();
  totals.moved = changes.size();
  for (const VersionChange& change : changes) {
    totals.better += change.error_after < change.error_before ? 1 : 0;
    totals.worse += change.error_after > change.error_before ? 1 : 0;
  }
  return totals;
}

TextTable version_table(const VersionComparison& comparison,
                        const std::vector<VersionChange>& changes, std::size_t most) {
  TextTable table{{{"scene"},
                   {"run", false, 2},
                   {"observable"},
                   {"reference", true, 3},
                   {comparison.engine + " " + comparison.before},
                   {comparison.engine + " " + comparison.after},
                   {"worst before", true, 1},
                   {"worst after", true},
                   {"moved", true}}};
  for (std::size_t k = 0; k < std::min(most, changes.size()); ++k)
    table.rows.push_back(cells_of(changes[k]));
  return table;
}

std::string version_finding(const VersionComparison& comparison,
                            const std::vector<VersionChange>& changes) {
  const VersionTotals totals = totals_of(comparison, changes);
  std::string text = fmt::format("{} {} → {}: {} of {} in {} moved by more than {} of a tolerance",
                                 comparison.engine, comparison.before, comparison.after,
                                 totals.moved, counted(totals.compared, "value"),
                                 counted(totals.runs, "run"), plain_number(comparison.threshold));
  if (totals.compared == 0)
    text += "; nothing could be compared: neither version shows anything that has a tolerance";
  if (totals.moved > 0)
    text += fmt::format("; by the worst phase {} for the better, {} for the worse", totals.better,
                        totals.worse);
  return text;
}

}  // namespace slipcheck
