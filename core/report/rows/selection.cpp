#include "report/rows/selection.h"

#include <algorithm>
#include <set>

#include "harness/compare/comparison.h"
#include "scenario/observable_key.h"
#include "scenario/tolerances.h"

namespace slipcheck {
namespace {

bool is_component(std::string_view full_name) {
  return observable_key(full_name).component != '\0';
}

/// Whose value of an observable the scene could show: of pairs, those that have met.
std::vector<std::string> owners(const SceneRecord& scene, ObservableScope scope) {
  if (scope == ObservableScope::all) return {"all"};
  std::set<std::string> result;
  if (scope == ObservableScope::body)
    for (const Body& body : scene.scenario.bodies) result.insert(body.name);
  else
    for (const auto& [name, value] : scene.reference.observables)
      if (const ObservableName* other = observable_of(name);
          other && other->scope == ObservableScope::pair)
        result.insert(std::string(observable_key(name).owner));
  return {result.begin(), result.end()};
}

}  // namespace

const ObservableName* observable_of(std::string_view full_name) {
  return observable_key(full_name).known();
}

const Dimension& dimension_of(std::string_view full_name) {
  const ObservableName* observable = observable_of(full_name);
  return observable ? observable->dimension : kPureNumber;
}

bool has_tolerance(const Scenario& scenario, std::string_view full_name) {
  return tolerance_of(scenario, full_name).has_value();
}

std::map<std::string, std::string> absent_observables(const SceneRecord& scene) {
  std::map<std::string, std::string> absent;
  for (const auto& [key, tolerance] : scene.scenario.compare.tolerance) {
    if (tolerance.none) continue;
    const ObservableKey parts = observable_key(key);
    const std::vector<std::string> named =
        parts.owner.empty() ? owners(scene, parts.known()->scope) : std::vector<std::string>{};
    for (const std::string& owner : named)
      if (const std::string full = parts.of(owner).text();
          names_observable(scene.scenario, key, full) &&
          !scene.reference.observables.contains(full))
        absent[full] = "it does not occur in the reference";
    const auto names_it = [&](const auto& value) {
      return names_observable(scene.scenario, key, value.first);
    };
    if (named.empty() && std::ranges::none_of(scene.reference.observables, names_it))
      absent[key] = kNothingOccurs;
  }
  return absent;
}

std::vector<std::string> shown_observables(const SceneRecord& scene, bool all) {
  std::set<std::string> names;
  for (const auto& [name, reason] : absent_observables(scene)) names.insert(name);
  for (const EngineRecord& run : scene.runs)
    for (const auto& [name, error] : run.errors)
      if (error.verdict > Verdict::within) names.insert(name);
  for (const EngineRecord& run : scene.runs)
    if (run.expect)
      for (const auto& [name, expected] : run.expect->observables)
        if (scene.reference.observables.contains(name)) names.insert(name);
  const bool has_engines = !scene.runs.empty();
  for (const auto& [name, value] : scene.reference.observables) {
    const ObservableName* observable = observable_of(name);
    if (all || has_tolerance(scene.scenario, name) || (observable && observable->is_restitution) ||
        (!has_engines && !is_component(name)))
      names.emplace(name);
  }
  if (names.empty())
    for (const auto& [name, value] : scene.reference.observables)
      if (!is_component(name)) names.emplace(name);
  return {names.begin(), names.end()};
}

}  // namespace slipcheck
