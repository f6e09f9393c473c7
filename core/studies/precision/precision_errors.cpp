#include "studies/precision/precision_errors.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "harness/compare/comparison.h"
#include "scenario/observable_key.h"
#include "studies/precision/pareto.h"

namespace slipcheck {
namespace {

using Kind = MethodCurve::Kind;

// A step rounds velocities by 6e-8 of them: over a run's thousand steps 2e-6 where these roundings
// are independent, 6e-5 where all go one way, as where friction takes the same from each step.
constexpr double kSingleRounding = 5e-5;
// An observer finds the end of a phase in the differences of two steps' ends, 1e-4 of the speeds
// apart at the highest rate: 1e-16/1e-4, and a thousand times that over a run's steps.
constexpr double kDoubleRounding = 1e-9;
// Of the reference's own solvers: 1e6 steps whose roundings add up like 1e-16 each at the worst.
constexpr double kReferenceRounding = 1e-11;

constexpr double kOfUncertainty = 10;
constexpr double kOfTolerance = 1e-3;

double worst_of(const WorkPrecision& point, const std::string& quantity) {
  const auto found = point.errors.find(quantity);
  return found != point.errors.end() && found->second.reason.empty() ? found->second.worst
                                                                     : kNotObserved;
}

std::set<std::string> quantities_of(const std::vector<MethodCurve>& curves) {
  std::set<std::string> names;
  for (const MethodCurve& curve : curves)
    for (const WorkPrecision& point : curve.points)
      for (const auto& [name, errors] : point.errors) names.insert(name);
  return names;
}

}  // namespace

double rounding_of(const MethodCurve& curve) {
  if (curve.kind != Kind::engine) return kReferenceRounding;
  return curve.precision == "single" ? kSingleRounding : kDoubleRounding;
}

std::map<std::string, ErrorFloor> error_floors(const Scenario& scenario,
                                               const ReferenceResult& reference, double rounding) {
  // A run that is off by the uncertainties has errors of their size.
  std::map<std::string, double> off;
  for (const auto& [name, value] : reference.observables)
    off.emplace(name, value.value + value.uncertainty);
  std::map<std::string, ErrorFloor> floors;
  for (const auto& [name, deviation] : deviations(scenario, reference, ensemble_values({off}))) {
    const auto value = reference.observables.find(name);
    if (value == reference.observables.end()) continue;
    const ObservableName* observable = observable_key(name).known();
    const bool has_unit = deviation.absolute && !(observable && observable->is_restitution);
    const double scale = has_unit ? std::abs(value->second.value) : 1;
    ErrorFloor& floor = floors[name];
    floor.noise = rounding * scale;
    if (std::isfinite(deviation.max))
      floor.noise = std::max(floor.noise, kOfUncertainty * deviation.max);
    floor.negligible = kOfTolerance * deviation.tolerance.value_or(0);
  }
  floors[kTrajectory].noise = rounding;
  return floors;
}

void find_convergence(const Scenario& scenario, const ReferenceResult& reference,
                      MethodCurve& curve) {
  const auto floors = error_floors(scenario, reference, rounding_of(curve));
  std::vector<double> knobs;
  for (const WorkPrecision& point : curve.points)
    knobs.push_back(curve.kind == Kind::engine ? 1 / point.knob : point.knob);
  for (const std::string& name : quantities_of({curve})) {
    std::vector<double> errors;
    for (const WorkPrecision& point : curve.points) errors.push_back(worst_of(point, name));
    const auto floor = floors.find(name);
    curve.convergence[name] =
        convergence_of(knobs, errors, floor == floors.end() ? ErrorFloor{} : floor->second);
  }
}

namespace {

void mark_front(std::vector<MethodCurve>& curves, bool of_engines) {
  std::vector<WorkPrecision*> points;
  std::vector<double> costs;
  for (MethodCurve& curve : curves)
    for (WorkPrecision& point : curve.points) {
      if ((curve.kind == MethodCurve::Kind::engine) != of_engines) continue;
      points.push_back(&point);
      costs.push_back(point.cost ? point.cost->per_simulated_second : kNotObserved);
    }
  for (const std::string& name : quantities_of(curves)) {
    std::vector<double> errors;
    for (const WorkPrecision* point : points) errors.push_back(worst_of(*point, name));
    const std::vector<bool> front = pareto_front(costs, errors);
    for (std::size_t k = 0; k < points.size(); ++k)
      if (front[k]) points[k]->pareto.insert(name);
  }
}

}  // namespace

void mark_fronts(std::vector<MethodCurve>& curves) {
  for (const bool of_engines : {true, false}) mark_front(curves, of_engines);
}

}  // namespace slipcheck
