#include "studies/stability/phase_comparison.h"

#include <fmt/format.h>

#include <cmath>

#include "harness/compare/comparison.h"

namespace slipcheck {

PhaseComparison compare_phase(const Scenario& scenario, const ReferenceResult& reference,
                              const std::map<std::string, double>& shown) {
  std::map<std::string, double> seen;
  for (const auto& [name, value] : shown)
    if (!std::isnan(value)) seen.emplace(name, value);
  PhaseComparison result;
  std::string missing;  // said only where nothing is off by more than it may be
  double worst_outside = 0;
  for (const auto& [name, error] : deviations(scenario, reference, ensemble_values({seen}))) {
    if (!error.tolerance || error.verdict == Verdict::undecided) continue;
    const bool within = error.verdict == Verdict::within;
    result.within &= within;
    if (std::isnan(error.max) && !within) {
      if (missing.empty()) missing = fmt::format("{}: {}", name, error.reason);
      continue;
    }
    const double in_tolerances = error.max > 0 ? error.max / *error.tolerance : 0;
    if (!within && in_tolerances > worst_outside) {
      worst_outside = in_tolerances;
      result.why = fmt::format("{} is off by {:.3g}{}, {:.3g} tolerances", name,
                               error.absolute ? error.max : 100 * error.max,
                               error.absolute ? "" : " %", in_tolerances);
    }
    if (std::isnan(result.worst_error) || in_tolerances > result.worst_error) {
      result.worst_error = in_tolerances;
      result.worst_observable = name;
    }
  }
  if (result.why.empty() && !result.within) result.why = missing;
  return result;
}

}  // namespace slipcheck
