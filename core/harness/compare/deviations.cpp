#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "base/by_name.h"
#include "harness/compare/comparison.h"
#include "harness/observe/observables.h"
#include "scenario/observable_key.h"
#include "scenario/tolerances.h"

namespace slipcheck {
namespace {

using Ensemble = std::map<std::string, EnsembleValue>;

constexpr const char* kDidNotEnd = "the reference did not come to its end";

/// By how much each phase is off, and what that is relative to.
struct Differences {
  std::vector<double> by_phase;
  double uncertainty = 0;        ///< of the reference's value
  double scale = 0;              ///< of a relative error
  double scale_uncertainty = 0;  ///< of that
};

Differences scalar_differences(const UncertainValue& reference, const EnsembleValue* seen) {
  Differences differences;
  if (seen)
    for (const double value : seen->values)
      if (!std::isnan(value)) differences.by_phase.push_back(std::abs(value - reference.value));
  differences.scale = std::abs(reference.value);
  differences.uncertainty = differences.scale_uncertainty = reference.uncertainty;
  return differences;
}

/// Of what has no number.
Deviation without_error(const Tolerance& tolerance, Verdict verdict, const char* reason) {
  return {.median = kNotObserved,
          .max = kNotObserved,
          .tolerance = tolerance.value,
          .absolute = tolerance.absolute,
          .verdict = verdict,
          .reason = reason,
          .rms = kNotObserved};
}

/// Holds ensembles of a scene against its reference, observable by observable.
class Judge {
 public:
  Judge(const Scenario& scenario, const ReferenceResult& reference)
      : scenario_(scenario), reference_(reference), slack_(reference.box ? 1 : 10) {
    for (const Body& body : scenario.bodies) bodies_.emplace(body.name, &body);
  }

  /// Of an observable that the reference shows.
  Deviation deviation(const Ensemble& ensemble, const std::string& name) const {
    const ObservableKey key = observable_key(name);
    const ObservableName* observable = key.known();
    Deviation result;
    result.absolute = observable && observable->is_restitution;
    if (const auto tolerance = tolerance_of(scenario_, name)) {
      result.tolerance = tolerance->value;
      result.absolute = tolerance->absolute;
    }
    const EnsembleValue* seen = find_in(ensemble, name);
    const bool is_vector = observable && observable->is_vector;
    const Differences differences = is_vector
                                        ? vector_differences(ensemble, key)
                                        : scalar_differences(reference_.observables.at(name), seen);
    const bool is_zero =
        !result.absolute && differences.scale <= slack_ * differences.scale_uncertainty;
    const bool good = measure(seen, differences, is_zero, result);
    if (!result.tolerance) return result;
    result.verdict = good ? Verdict::within : Verdict::deviates;
    const bool is_length = is_vector && !is_zero && seen && key.component == '\0';
    if (is_length && is_too_long_or_short(*seen, name, differences, result)) return result;
    if (std::string reason = undecided_reason(name, differences, is_zero, result);
        !reason.empty()) {
      result.verdict = Verdict::undecided;
      result.reason = std::move(reason);
    }
    return result;
  }

  /// Of one that only the engine shows, as a jump or a landing; none without a tolerance.
  std::optional<Deviation> deviation_of_surplus(const std::string& name) const {
    const auto tolerance = tolerance_of(scenario_, name);
    if (!tolerance) return std::nullopt;
    return has_end()
               ? without_error(*tolerance, Verdict::deviates, "it does not occur in the reference")
               : without_error(*tolerance, Verdict::undecided, kDidNotEnd);
  }

  /// Of a tolerance that names nothing that there is.
  Deviation deviation_of_nothing(const std::string& key, Tolerance tolerance) const {
    const ObservableName* observable = observable_key(key).known();
    tolerance.absolute |= observable && observable->is_restitution;
    return without_error(tolerance, Verdict::undecided, has_end() ? kNothingOccurs : kDidNotEnd);
  }

 private:
  bool has_end() const { return reference_.run.reached; }

  /// Differences of a vector (its bare name) or of one component, on the scale of the vector's
  /// length; a position's scale is the way from the start.
  Differences vector_differences(const Ensemble& ensemble, const ObservableKey& key) const {
    const bool is_way = key.observable == "final_position";
    const auto body = bodies_.find(key.owner);
    const std::array<std::string, 3> components = key.components();
    Vector3 length = Vector3::Zero(), uncertainty = Vector3::Zero(), own = Vector3::Zero();
    Differences differences;
    std::vector<double> squares;
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const UncertainValue& value = reference_.observables.at(components[at]);
      length[k] = value.value;
      uncertainty[k] = value.uncertainty;
      if (is_way && body != bodies_.end()) length[k] -= body->second->initial.position[k];
      if (key.component != '\0' && key.component != kComponents[at]) continue;
      const Differences one = scalar_differences(value, find_in(ensemble, components[at]));
      own[k] = one.uncertainty;
      squares.resize(one.by_phase.size());
      for (std::size_t p = 0; p < squares.size(); ++p)
        squares[p] += one.by_phase[p] * one.by_phase[p];
    }
    for (const double square : squares) differences.by_phase.push_back(std::sqrt(square));
    differences.uncertainty = own.norm();
    differences.scale = length.norm();
    // A length may be known where the direction is not.
    differences.scale_uncertainty =
        is_way ? uncertainty.norm() : reference_.observables.at(key.whole().text()).uncertainty;
    return differences;
  }

  /// Fills in the errors; whether they are within the tolerance, if there is one.
  bool measure(const EnsembleValue* seen, const Differences& differences, bool is_zero,
               Deviation& result) const {
    result.median = result.max = result.rms = kNotObserved;
    if (!seen || differences.by_phase.empty()) {
      result.reason = "no run of the engine shows it";
      return false;
    }
    const double largest = *std::ranges::max_element(differences.by_phase);
    bool good = false;
    if (is_zero) {
      good = result.is_zero = largest <= slack_ * differences.uncertainty;
      result.reason = good ? "0 within the reference's uncertainty"
                           : "the reference is 0: a tolerance with a unit compares it";
    } else {
      const double scale = result.absolute ? 1 : differences.scale;
      result.median = median(differences.by_phase) / scale;
      result.max = largest / scale;
      result.rms = root_mean_square(differences.by_phase) / scale;
      good = !result.tolerance || result.max <= *result.tolerance;
    }
    if (seen->missing > 0) result.reason = missing_phases(*seen);
    return good && seen->missing == 0;
  }

  /// Whether the length of a vector alone, which may be known where the direction is not, tells
  /// that an error is beyond its tolerance: vectors are no nearer to each other than their lengths.
  bool is_too_long_or_short(const EnsembleValue& seen, const std::string& name,
                            const Differences& differences, const Deviation& deviation) const {
    if (!has_end()) return false;
    const UncertainValue& length = reference_.observables.at(name);
    const double scale = deviation.absolute ? 1 : differences.scale + differences.scale_uncertainty;
    const double allowed = *deviation.tolerance * scale;
    const double off =
        std::max(std::abs(seen.max - length.value), std::abs(seen.min - length.value));
    return length.uncertainty <= allowed && off - length.uncertainty > allowed;
  }

  /// Why the reference cannot tell whether an error is within its tolerance; "" where it can.
  std::string undecided_reason(const std::string& name, const Differences& differences,
                               bool is_zero, const Deviation& deviation) const {
    if (!has_end()) return kDidNotEnd;
    if (reference_.box && !reference_.box->steady)
      return "the reference's averages still drift, or are of too few samples";
    const double uncertainty = differences.uncertainty;
    if (std::isinf(uncertainty)) return "the reference does not know whether it shows";
    if (is_zero)
      return reference_.scales.is_rounding(name, uncertainty)
                 ? ""
                 : fmt::format("the reference is 0 within its uncertainty of {:.2g}", uncertainty);
    const double error = uncertainty / (deviation.absolute ? 1 : differences.scale);
    if (error <= *deviation.tolerance) return "";
    return fmt::format("the reference is uncertain by {:.2g}{}, more than the tolerance",
                       deviation.absolute ? error : 100 * error, deviation.absolute ? "" : " %");
  }

  const Scenario& scenario_;
  const ReferenceResult& reference_;
  /// The spread over rounding modes tells the order of rounding errors only; that of an average
  /// over a box is a bound with 95 %.
  double slack_;
  std::unordered_map<std::string_view, const Body*> bodies_;
};

}  // namespace

std::string missing_phases(const EnsembleValue& value) {
  return fmt::format("{} of {} {} do not show it", value.missing, value.values.size(),
                     value.headings ? "runs" : "phases");
}

std::map<std::string, Deviation> deviations(const Scenario& scenario,
                                            const ReferenceResult& reference,
                                            const Ensemble& ensemble) {
  const Judge judge(scenario, reference);
  std::map<std::string, Deviation> result;
  for (const auto& [text, value] : reference.observables) {
    const std::string name(text);
    result.emplace(name, judge.deviation(ensemble, name));
  }
  for (const auto& [name, value] : ensemble)
    if (!result.contains(name))
      if (auto surplus = judge.deviation_of_surplus(name)) result[name] = std::move(*surplus);
  for (const auto& [key, tolerance] : scenario.compare.tolerance) {
    const auto names_it = [&](const auto& each) {
      return names_observable(scenario, key, each.first);
    };
    if (!tolerance.none && std::ranges::none_of(result, names_it))
      result[key] = judge.deviation_of_nothing(key, tolerance);
  }
  return result;
}

std::vector<double> phase_errors(const Scenario& scenario, const ReferenceResult& reference,
                                 const Ensemble& ensemble) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Judge judge(scenario, reference);
  std::size_t phases = 0;
  for (const auto& [name, value] : ensemble) phases = std::max(phases, value.values.size());
  std::vector<double> errors(phases, kNotObserved);
  for (std::size_t p = 0; p < phases; ++p) {
    std::map<std::string, double> seen;
    for (const auto& [name, value] : ensemble)
      if (!std::isnan(value.values[p])) seen.emplace(name, value.values[p]);
    const auto note = [&](double error) { errors[p] = std::fmax(errors[p], error); };
    const Ensemble alone = ensemble_values({seen});
    for (const auto& [text, value] : reference.observables) {
      const std::string name(text);
      if (!tolerance_of(scenario, name)) continue;
      const Deviation off = judge.deviation(alone, name);
      if (off.verdict == Verdict::undecided) continue;
      if (off.verdict == Verdict::within && !(off.max > 0))
        note(0);
      else if (!std::isnan(off.max))
        note(off.max / *off.tolerance);
      else if (!seen.contains(name))
        note(kInfinity);
    }
    for (const auto& [name, value] : seen)
      if (!reference.observables.contains(name))
        if (const auto surplus = judge.deviation_of_surplus(name);
            surplus && surplus->verdict == Verdict::deviates)
          note(kInfinity);
  }
  return errors;
}

}  // namespace slipcheck
