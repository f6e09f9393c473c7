#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/compare/comparison.h"
#include "reference/initial_contacts.h"
#include "scenario/observable_key.h"
#include "studies/stability/stability.h"

namespace slipcheck {
namespace {

/// A scalar, or a vector's length with the worst uncertainty of its components.
UncertainValue known_value(const ReferenceResult& reference, const std::string& name) {
  UncertainValue value = reference.observables.at(name);
  const ObservableKey key = observable_key(name);
  if (key.component != '\0') return value;
  for (const std::string& component : key.components())
    if (const auto found = reference.observables.find(component);
        found != reference.observables.end())
      value.uncertainty = std::max(value.uncertainty, found->second.uncertainty);
  return value;
}

/// The worst uncertainty among the observables with a tolerance.
struct Uncertainty {
  double in_tolerances = kNotObserved;
  std::string observable;
};

Uncertainty worst_uncertainty(const PreparedScene& scene) {
  const ReferenceResult& reference = scene.reference;
  // A run that is off by just the uncertainty has it for its error.
  std::map<std::string, double> shifted;
  for (const auto& [name, value] : reference.observables)
    shifted.emplace(name, value.value + value.uncertainty);
  Uncertainty worst;
  for (const auto& [name, error] :
       deviations(scene.scenario, reference, ensemble_values({shifted}))) {
    if (!error.tolerance || !reference.observables.contains(name)) continue;
    const UncertainValue value = known_value(reference, name);
    double relative = error.max;
    if (!(relative > 0))  // taken as zero, for which its uncertainty has to be one of rounding
      relative = reference.scales.is_rounding(name, value.uncertainty)
                     ? 0
                     : std::numeric_limits<double>::infinity();
    const double in_tolerances = relative > 0 ? relative / *error.tolerance : 0;
    if (std::isnan(worst.in_tolerances) || in_tolerances > worst.in_tolerances)
      worst = {in_tolerances, name};
  }
  return worst;
}

}  // namespace

ReferenceOutcome reference_outcome(const PreparedScene& scene) {
  const ReferenceResult& reference = scene.reference;
  ReferenceOutcome outcome;
  outcome.cpu_seconds = reference.cpu_seconds;
  if (reference.run.failed || !reference.run.reached) {
    outcome.why = fmt::format("the run did not end: {}", reference.run.reason);
    return outcome;
  }
  for (const auto& [name, value] : reference.observables)
    if (!std::isfinite(value.value)) {
      outcome.why = fmt::format("{} is not finite", name);
      return outcome;
    }
  const Uncertainty worst = worst_uncertainty(scene);
  outcome.worst_uncertainty = worst.in_tolerances;
  outcome.accurate = !(worst.in_tolerances * kReferenceMargin > 1);
  if (!outcome.accurate)
    outcome.why = fmt::format("the uncertainty of {} is {:.3g} of its tolerance, more than 1/{}",
                              worst.observable, worst.in_tolerances, kReferenceMargin);
  return outcome;
}

}  // namespace slipcheck
