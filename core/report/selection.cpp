#include "report/selection.h"

#include <set>

namespace slipcheck {
namespace {

std::string owner_of(const std::string& full_name) {
  return full_name.substr(0, full_name.find('.'));
}

std::string bare_name(const std::string& full_name) {
  const std::size_t dot = full_name.find('.');
  return dot == std::string::npos ? full_name : full_name.substr(dot + 1);
}

bool is_component(const std::string& full_name) {
  const ObservableName* observable = observable_of(full_name);
  return observable && bare_name(full_name) != observable->name;
}

/// Whose value of an observable the scene could show.
std::vector<std::string> owners(const SceneRecord& scene, ObservableScope scope) {
  std::set<std::string> result;
  switch (scope) {
    case ObservableScope::all:
      return {"all"};
    case ObservableScope::body:
      for (const Body& body : scene.scenario.bodies) result.insert(body.name);
      break;
    case ObservableScope::pair:
      for (const auto& [name, value] : scene.reference.observables)
        if (const ObservableName* other = observable_of(name);
            other && other->scope == ObservableScope::pair)
          result.insert(owner_of(name));
      break;
  }
  return {result.begin(), result.end()};
}

}  // namespace

const ObservableName* observable_of(const std::string& full_name) {
  return find_observable(bare_name(full_name));
}

const Dimension& dimension_of(const std::string& full_name) {
  const ObservableName* observable = observable_of(full_name);
  return observable ? observable->dimension : kPureNumber;
}

bool has_tolerance(const Scenario& scenario, const std::string& full_name) {
  return scenario.compare.tolerance.count(bare_name(full_name)) > 0;
}

std::map<std::string, std::string> absent_observables(const SceneRecord& scene) {
  std::map<std::string, std::string> absent;
  for (const auto& [name, tolerance] : scene.scenario.compare.tolerance) {
    const ObservableName* observable = find_observable(name);
    if (!observable) {
      absent[name] = "no observable of this name is known";
      continue;
    }
    const std::vector<std::string> named = owners(scene, observable->scope);
    if (named.empty()) absent[name] = "no pair collides in the reference";
    for (const std::string& owner : named) {
      // A landing has a restitution; nothing of it is left once a body rolls.
      const bool of_landing = owner.ends_with("-substrate") && name != "restitution";
      if (const std::string full = owner + "." + name;
          !of_landing && !scene.reference.observables.count(full))
        absent[full] = "it does not occur in the reference";
    }
  }
  return absent;
}

std::vector<std::string> shown_observables(const SceneRecord& scene, bool all) {
  std::set<std::string> names;
  for (const auto& [name, reason] : absent_observables(scene)) names.insert(name);
  for (const EngineRecord& run : scene.runs)
    if (run.expect)
      for (const auto& [name, expected] : run.expect->observables)
        if (scene.reference.observables.count(name)) names.insert(name);
  const bool has_engines = !scene.runs.empty();
  for (const auto& [name, value] : scene.reference.observables) {
    const ObservableName* observable = observable_of(name);
    if (all || has_tolerance(scene.scenario, name) || (observable && observable->is_restitution) ||
        (!has_engines && !is_component(name)))
      names.insert(name);
  }
  if (names.empty())
    for (const auto& [name, value] : scene.reference.observables)
      if (!is_component(name)) names.insert(name);
  return {names.begin(), names.end()};
}

}  // namespace slipcheck
