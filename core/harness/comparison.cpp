#include "harness/comparison.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <unordered_map>

#include "harness/observables.h"
#include "scenario/observable_names.h"

namespace slipcheck {
namespace {

/// "i.final_velocity.x" is of "i", named "final_velocity.x".
struct FullName {
  std::string owner, observable;
  explicit FullName(const std::string& name)
      : owner(name.substr(0, name.find('.'))), observable(name.substr(name.find('.') + 1)) {}
};

/// By how much each phase is off, and what that is relative to.
struct Differences {
  std::vector<double> by_phase;
  double scale = 0;  ///< of a relative error
  double uncertainty = 0;
};

using Ensemble = std::map<std::string, EnsembleValue>;

Differences scalar_differences(const UncertainValue& reference, const EnsembleValue& ensemble) {
  Differences differences;
  for (double value : ensemble.values)
    if (!std::isnan(value)) differences.by_phase.push_back(std::abs(value - reference.value));
  differences.scale = std::abs(reference.value);
  differences.uncertainty = reference.uncertainty;
  return differences;
}

/// The bodies of a scene by name: of many none is looked for among all.
using Bodies = std::unordered_map<std::string_view, const Body*>;

Bodies bodies_of(const Scenario& scenario) {
  Bodies bodies;
  for (const Body& body : scenario.bodies) bodies.emplace(body.name, &body);
  return bodies;
}

/// Differences of a vector (its bare name) or of one component, on the scale of the vector's
/// length; a position's scale is the way from the start.
Differences vector_differences(const Bodies& bodies, const ReferenceResult& reference,
                               const Ensemble& ensemble, const std::string& name,
                               const ObservableName& observable) {
  const FullName full(name);
  const std::string vector = full.owner + "." + std::string(observable.name);
  Differences differences;
  Vector3 length = Vector3::Zero();
  const auto body = bodies.find(full.owner);
  std::vector<double> squares;
  for (int k = 0; k < 3; ++k) {
    const std::string component = vector + "." + "xyz"[k];
    const UncertainValue& value = reference.observables.at(component);
    length[k] = value.value;
    if (observable.name == "final_position" && body != bodies.end())
      length[k] -= body->second->initial.position[k];
    differences.uncertainty = std::max(differences.uncertainty, value.uncertainty);
    if (name != vector && name != component) continue;
    const auto found = ensemble.find(component);
    if (found == ensemble.end()) continue;
    const Differences one = scalar_differences(value, found->second);
    squares.resize(one.by_phase.size());
    for (std::size_t p = 0; p < squares.size(); ++p)
      squares[p] += one.by_phase[p] * one.by_phase[p];
  }
  for (double square : squares) differences.by_phase.push_back(std::sqrt(square));
  differences.scale = length.norm();
  return differences;
}

std::string missing_phases(const EnsembleValue& value) {
  return std::to_string(value.missing) + " of " + std::to_string(value.values.size()) +
         " phases do not show it";
}

Deviation deviation(const Scenario& scenario, const Bodies& bodies,
                    const ReferenceResult& reference, const Ensemble& ensemble,
                    const std::string& name) {
  Deviation result;
  const std::string observable_name = FullName(name).observable;
  const ObservableName* observable = find_observable(observable_name);
  if (const auto found = scenario.compare.tolerance.find(observable_name);
      found != scenario.compare.tolerance.end()) {
    result.tolerance = found->second.value;
    result.absolute = found->second.absolute;
  }
  result.absolute |= observable && observable->is_restitution;

  const UncertainValue& expected = reference.observables.at(name);
  const auto found = ensemble.find(name);
  const bool is_vector = observable && observable->is_vector;
  Differences differences;
  if (found != ensemble.end())
    differences = is_vector ? vector_differences(bodies, reference, ensemble, name, *observable)
                            : scalar_differences(expected, found->second);
  if (differences.by_phase.empty()) {
    result.median = result.max = result.rms = kNotObserved;
    result.reason = "no run of the engine shows it";
  } else {
    const double scale = result.absolute ? 1 : differences.scale;
    result.median = median(differences.by_phase);
    result.max = *std::max_element(differences.by_phase.begin(), differences.by_phase.end());
    result.rms = root_mean_square(differences.by_phase);
    // Zero within the reference's own uncertainty: a relative error has no meaning. That of an
    // average over a box is statistical, a bound with 95 %; elsewhere it is of rounding.
    const double slack = (reference.box ? 1 : 10) * differences.uncertainty;
    const bool is_zero = !result.absolute && scale <= slack;
    if (is_zero && result.max > slack) {
      result.median = result.max = result.rms = kNotObserved;
      result.reason = "the reference is 0: a tolerance with a unit compares it";
    } else if (is_zero) {
      result.median = result.max = result.rms = 0;
    } else {
      result.median /= scale;
      result.max /= scale;
      result.rms /= scale;
    }
    if (found->second.missing > 0) result.reason = missing_phases(found->second);
  }
  result.within = !result.tolerance || (result.reason.empty() && result.max <= *result.tolerance);
  return result;
}

/// One statistic of the ensemble's value of an observable, which is null if no phase shows it.
ExpectationResult range_result(const std::string& name, ExpectationResult::Statistic statistic,
                               const ExpectedRange& range, const EnsembleValue* seen) {
  using Statistic = ExpectationResult::Statistic;
  ExpectationResult result{.observable = name,
                           .statistic = statistic,
                           .low = range.low,
                           .high = range.high,
                           .value = kNotObserved,
                           .reason = ""};
  if (!seen) {
    result.reason = "no phase shows it";
    return result;
  }
  result.value = statistic == Statistic::min   ? seen->min
                 : statistic == Statistic::max ? seen->max
                                               : seen->median;
  if (seen->missing > 0) result.reason = missing_phases(*seen);
  result.met = seen->missing == 0 && range.low <= result.value && result.value <= range.high;
  return result;
}

ExpectationResult none_result(const std::string& name, const EnsembleValue* seen) {
  return {.observable = name,
          .value = seen ? seen->median : kNotObserved,
          .met = !seen,
          .reason = seen ? (seen->missing > 0 ? missing_phases(*seen) : "every phase shows it")
                         : "no phase shows it"};
}

}  // namespace

double median(std::vector<double> values) {
  const std::size_t half = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(half),
                   values.end());
  const double upper = values[half];
  if (values.size() % 2 == 1) return upper;
  const double lower =
      *std::max_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(half));
  return 0.5 * (lower + upper);
}

double root_mean_square(std::span<const double> values) {
  // Over the largest, that squares neither vanish nor overflow.
  double largest = 0, sum = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  if (largest == 0) return 0;
  for (const double value : values) sum += (value / largest) * (value / largest);
  return largest * std::sqrt(sum / static_cast<double>(values.size()));
}

std::map<std::string, EnsembleValue> ensemble_values(
    const std::vector<std::map<std::string, double>>& phases) {
  std::map<std::string, EnsembleValue> ensemble;
  for (std::size_t p = 0; p < phases.size(); ++p)
    for (const auto& [name, value] : phases[p]) {
      auto& values = ensemble[name].values;
      values.resize(phases.size(), kNotObserved);
      values[p] = value;
    }
  for (auto& [name, value] : ensemble) {
    std::vector<double> shown;
    for (double v : value.values)
      if (!std::isnan(v)) shown.push_back(v);
    value.missing = value.values.size() - shown.size();
    value.median = median(shown);
    const auto [low, high] = std::minmax_element(shown.begin(), shown.end());
    value.min = *low;
    value.max = *high;
  }
  return ensemble;
}

std::map<std::string, Deviation> deviations(const Scenario& scenario,
                                            const ReferenceResult& reference,
                                            const Ensemble& ensemble) {
  std::map<std::string, Deviation> result;
  const Bodies bodies = bodies_of(scenario);
  for (const auto& [name, value] : reference.observables)
    result[name] = deviation(scenario, bodies, reference, ensemble, name);
  // A jump or a landing that only the engine has is a deviation too.
  for (const auto& [name, value] : ensemble) {
    const auto tolerance = scenario.compare.tolerance.find(FullName(name).observable);
    if (result.count(name) || tolerance == scenario.compare.tolerance.end()) continue;
    result[name] = {.median = kNotObserved,
                    .max = kNotObserved,
                    .tolerance = tolerance->second.value,
                    .absolute = tolerance->second.absolute,
                    .within = false,
                    .reason = "it does not occur in the reference",
                    .rms = kNotObserved};
  }
  return result;
}

std::vector<double> phase_errors(const Scenario& scenario, const ReferenceResult& reference,
                                 const Ensemble& ensemble) {
  std::size_t phases = 0;
  for (const auto& [name, value] : ensemble) phases = std::max(phases, value.values.size());
  std::vector<double> errors(phases, kNotObserved);
  const auto has_tolerance = [&](const std::string& name) {
    return scenario.compare.tolerance.contains(FullName(name).observable);
  };
  const Bodies bodies = bodies_of(scenario);
  for (std::size_t p = 0; p < phases; ++p) {
    std::map<std::string, double> seen;
    for (const auto& [name, value] : ensemble)
      if (!std::isnan(value.values[p])) seen.emplace(name, value.values[p]);
    const auto note = [&](double error) { errors[p] = std::fmax(errors[p], error); };
    const Ensemble alone = ensemble_values({seen});
    for (const auto& [name, value] : reference.observables) {
      if (!has_tolerance(name)) continue;
      const Deviation off = deviation(scenario, bodies, reference, alone, name);
      if (off.within && off.max == 0)
        note(0);
      else if (!std::isnan(off.max))
        note(off.max / *off.tolerance);
      else if (!seen.contains(name))
        note(std::numeric_limits<double>::infinity());
    }
    for (const auto& [name, value] : seen)
      if (has_tolerance(name) && !reference.observables.contains(name))
        note(std::numeric_limits<double>::infinity());
  }
  return errors;
}

std::vector<ExpectationResult> expectation_results(const Expectation& expectation,
                                                   const Ensemble& ensemble) {
  using Statistic = ExpectationResult::Statistic;
  std::vector<ExpectationResult> results;
  for (const auto& [name, expected] : expectation.observables) {
    const auto found = ensemble.find(name);
    const EnsembleValue* seen = found == ensemble.end() ? nullptr : &found->second;
    if (expected.none) results.push_back(none_result(name, seen));
    if (expected.min) results.push_back(range_result(name, Statistic::min, *expected.min, seen));
    if (expected.median)
      results.push_back(range_result(name, Statistic::median, *expected.median, seen));
    if (expected.max) results.push_back(range_result(name, Statistic::max, *expected.max, seen));
  }
  return results;
}

}  // namespace slipcheck
