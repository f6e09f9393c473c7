#include "harness/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>

#include "harness/observables.h"
#include "scenario/owned_names.h"
#include "scenario/tolerances.h"

namespace slipcheck {
namespace {

/// By how much each phase is off, and what that is relative to.
struct Differences {
  std::vector<double> by_phase;
  double uncertainty = 0;
  double scale = 0;              ///< of a relative error
  double scale_uncertainty = 0;  ///< of that
};

constexpr const char* kDidNotEnd = "the reference did not come to its end";

using Ensemble = std::map<std::string, EnsembleValue>;

Differences scalar_differences(const UncertainValue& reference, const EnsembleValue* ensemble) {
  Differences differences;
  if (ensemble)
    for (double value : ensemble->values)
      if (!std::isnan(value)) differences.by_phase.push_back(std::abs(value - reference.value));
  differences.scale = std::abs(reference.value);
  differences.uncertainty = differences.scale_uncertainty = reference.uncertainty;
  return differences;
}

template <class Value>
const Value* find(const std::map<std::string, Value>& map, const std::string& name) {
  const auto found = map.find(name);
  return found == map.end() ? nullptr : &found->second;
}

const Body* find_body(const Scenario& scenario, std::string_view name) {
  const auto found = std::ranges::find(scenario.bodies, name, &Body::name);
  return found == scenario.bodies.end() ? nullptr : &*found;
}

/// Differences of a vector (its bare name) or of one component, on the scale of the vector's
/// length; a position's scale is the way from the start.
Differences vector_differences(const Scenario& scenario, const ReferenceResult& reference,
                               const Ensemble& ensemble, const std::string& name,
                               const ObservableName& observable) {
  const std::string_view owner = owned_name(name).owner;
  const std::string vector = std::string(owner) + "." + std::string(observable.name);
  Differences differences;
  Vector3 length = Vector3::Zero(), uncertainty = Vector3::Zero(), own = Vector3::Zero();
  const bool is_way = observable.name == "final_position";
  const Body* body = find_body(scenario, owner);
  std::vector<double> squares;
  for (int k = 0; k < 3; ++k) {
    const std::string component = vector + "." + "xyz"[k];
    const UncertainValue& value = reference.observables.at(component);
    length[k] = value.value;
    uncertainty[k] = value.uncertainty;
    if (is_way && body) length[k] -= body->initial.position[k];
    if (name != vector && name != component) continue;
    const Differences one = scalar_differences(value, find(ensemble, component));
    own[k] = one.uncertainty;
    squares.resize(one.by_phase.size());
    for (std::size_t p = 0; p < squares.size(); ++p)
      squares[p] += one.by_phase[p] * one.by_phase[p];
  }
  for (double square : squares) differences.by_phase.push_back(std::sqrt(square));
  differences.uncertainty = own.norm();
  differences.scale = length.norm();
  // A length may be known where the direction is not.
  differences.scale_uncertainty =
      is_way ? uncertainty.norm() : reference.observables.at(vector).uncertainty;
  return differences;
}

/// Whether the length of a vector alone, which may be known where the direction is not, tells that
/// an error is beyond its tolerance: no two vectors are nearer to each other than their lengths.
bool is_too_long_or_short(const UncertainValue& length, const EnsembleValue& seen,
                          const Differences& differences, const Deviation& deviation) {
  const double allowed =
      *deviation.tolerance *
      (deviation.absolute ? 1 : differences.scale + differences.scale_uncertainty);
  const double off = std::max(std::abs(seen.max - length.value), std::abs(seen.min - length.value));
  return length.uncertainty <= allowed && off - length.uncertainty > allowed;
}

std::string missing_phases(const EnsembleValue& value) {
  return std::to_string(value.missing) + " of " + std::to_string(value.values.size()) +
         " phases do not show it";
}

/// What the reference cannot tell to a tolerance, as a reason; "" where it can.
std::string undecided_reason(const ReferenceResult& reference, const std::string& name,
                             const Differences& differences, bool is_zero,
                             const Deviation& deviation) {
  if (!reference.run.reached) return kDidNotEnd;
  const double uncertainty = differences.uncertainty;
  if (std::isinf(uncertainty)) return "the reference does not know whether it shows";
  if (is_zero)
    return reference.scales.is_rounding(name, uncertainty)
               ? ""
               : fmt::format("the reference is 0 within its uncertainty of {:.2g}", uncertainty);
  const double error = uncertainty / (deviation.absolute ? 1 : differences.scale);
  if (!(error > *deviation.tolerance)) return "";
  return fmt::format("the reference is uncertain by {:.2g}{}, more than the tolerance",
                     deviation.absolute ? error : 100 * error, deviation.absolute ? "" : " %");
}

Deviation deviation(const Scenario& scenario, const ReferenceResult& reference,
                    const Ensemble& ensemble, const std::string& name) {
  Deviation result;
  const ObservableName* observable = find_observable(owned_name(name).observable);
  result.absolute = observable && observable->is_restitution;
  if (const auto tolerance = tolerance_of(scenario, name)) {
    result.tolerance = tolerance->value;
    result.absolute = tolerance->absolute;
  }
  const EnsembleValue* seen = find(ensemble, name);
  const Differences differences =
      observable && observable->is_vector
          ? vector_differences(scenario, reference, ensemble, name, *observable)
          : scalar_differences(reference.observables.at(name), seen);
  // The spread over rounding modes tells the order of rounding errors only; that of an average over
  // a box is a bound with 95 %.
  const double slack = (reference.box ? 1 : 10) * differences.uncertainty;
  const double scale_slack = (reference.box ? 1 : 10) * differences.scale_uncertainty;
  const bool is_zero = !result.absolute && differences.scale <= scale_slack;

  bool good = false;
  if (!seen || differences.by_phase.empty()) {
    result.median = result.max = result.rms = kNotObserved;
    result.reason = "no run of the engine shows it";
  } else {
    result.max = *std::ranges::max_element(differences.by_phase);
    if (is_zero) {
      good = result.is_zero = result.max <= slack;
      result.median = result.max = result.rms = kNotObserved;
      result.reason = good ? "0 within the reference's uncertainty"
                           : "the reference is 0: a tolerance with a unit compares it";
    } else {
      const double scale = result.absolute ? 1 : differences.scale;
      result.median = median(differences.by_phase) / scale;
      result.max /= scale;
      result.rms = root_mean_square(differences.by_phase) / scale;
      good = !result.tolerance || result.max <= *result.tolerance;
    }
    if (seen->missing > 0) result.reason = missing_phases(*seen);
    good = good && seen->missing == 0;
  }
  if (!result.tolerance) return result;
  std::string undecided = undecided_reason(reference, name, differences, is_zero, result);
  if (reference.run.reached && seen && observable && name.ends_with(observable->name) &&
      observable->is_vector && !is_zero &&
      is_too_long_or_short(reference.observables.at(name), *seen, differences, result))
    undecided.clear();
  if (!undecided.empty()) result.reason = undecided;
  result.verdict = !undecided.empty() ? Verdict::undecided
                   : good             ? Verdict::within
                                      : Verdict::deviates;
  return result;
}

/// Of what has no number.
Deviation without_error(const Tolerance& tolerance, Verdict verdict, std::string reason) {
  return {.median = kNotObserved,
          .max = kNotObserved,
          .tolerance = tolerance.value,
          .absolute = tolerance.absolute,
          .verdict = verdict,
          .reason = std::move(reason),
          .rms = kNotObserved};
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
  for (const auto& [name, value] : reference.observables)
    result[name] = deviation(scenario, reference, ensemble, name);
  const bool has_end = reference.run.reached;
  // A jump or a landing that only the engine has is a deviation too.
  for (const auto& [name, value] : ensemble) {
    const auto tolerance = tolerance_of(scenario, name);
    if (tolerance && !result.contains(name))
      result[name] = without_error(*tolerance, has_end ? Verdict::deviates : Verdict::undecided,
                                   has_end ? "it does not occur in the reference" : kDidNotEnd);
  }
  for (const auto& [key, tolerance] : scenario.compare.tolerance) {
    const auto names_it = [&](const auto& each) {
      return names_observable(scenario, key, each.first);
    };
    if (tolerance.none || std::ranges::any_of(result, names_it)) continue;
    Tolerance of_nothing = tolerance;
    const ObservableName* observable = find_observable(owned_name(key).observable);
    of_nothing.absolute |= observable && observable->is_restitution;
    result[key] =
        without_error(of_nothing, Verdict::undecided, has_end ? kNothingOccurs : kDidNotEnd);
  }
  return result;
}

std::vector<double> phase_errors(const Scenario& scenario, const ReferenceResult& reference,
                                 const Ensemble& ensemble) {
  std::size_t phases = 0;
  for (const auto& [name, value] : ensemble) phases = std::max(phases, value.values.size());
  std::vector<double> errors(phases, kNotObserved);
  for (std::size_t p = 0; p < phases; ++p) {
    std::map<std::string, double> seen;
    for (const auto& [name, value] : ensemble)
      if (!std::isnan(value.values[p])) seen.emplace(name, value.values[p]);
    const auto note = [&](double error) { errors[p] = std::fmax(errors[p], error); };
    const Ensemble alone = ensemble_values({seen});
    for (const auto& [name, value] : reference.observables) {
      if (!tolerance_of(scenario, name)) continue;
      const Deviation off = deviation(scenario, reference, alone, name);
      if (off.verdict == Verdict::undecided) continue;
      if (off.verdict == Verdict::within && !(off.max > 0))
        note(0);
      else if (!std::isnan(off.max))
        note(off.max / *off.tolerance);
      else if (!seen.contains(name))
        note(std::numeric_limits<double>::infinity());
    }
    for (const auto& [name, value] : seen)
      if (reference.run.reached && !reference.observables.contains(name) &&
          tolerance_of(scenario, name))
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
