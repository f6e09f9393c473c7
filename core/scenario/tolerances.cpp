#include "scenario/tolerances.h"

#include <algorithm>
#include <limits>

#include "scenario/owned_names.h"

namespace slipcheck {
namespace {

/// How much a key says of the owner: nothing, by a pattern, all.
std::size_t weight(std::string_view key) {
  const std::string_view owner = owned_name(key).owner;
  const auto wildcards = static_cast<std::size_t>(std::ranges::count(owner, '*'));
  if (owner.empty()) return 0;
  return wildcards > 0 ? 1 + owner.size() - wildcards : std::numeric_limits<std::size_t>::max();
}

}  // namespace

bool names_observable(const Scenario& scenario, std::string_view key, std::string_view full_name) {
  const OwnedName name = owned_name(full_name), named = owned_name(key);
  if (named.observable != name.observable) return false;
  if (!named.owner.empty()) return matches(named.owner, name.owner);
  return !name.owner.ends_with("-substrate") || scenario.bodies.size() == 1;
}

std::optional<Tolerance> tolerance_of(const Scenario& scenario, const std::string& full_name) {
  const std::string* key = nullptr;
  const Tolerance* best = nullptr;
  for (const auto& [name, tolerance] : scenario.compare.tolerance) {
    if (!names_observable(scenario, name, full_name)) continue;
    if (best != nullptr && weight(name) <= weight(*key)) continue;
    key = &name;
    best = &tolerance;
  }
  if (best == nullptr || best->none) return std::nullopt;
  Tolerance tolerance = *best;
  const ObservableName* observable = find_observable(owned_name(full_name).observable);
  tolerance.absolute |= observable != nullptr && observable->is_restitution;
  return tolerance;
}

std::optional<Tolerance> tolerance_of_part(const Scenario& scenario, const std::string& full_name) {
  if (auto tolerance = tolerance_of(scenario, full_name)) return tolerance;
  const OwnedName name = owned_name(full_name);
  const ObservableName* observable = find_observable(name.observable);
  if (observable == nullptr || observable->name == name.observable) return std::nullopt;
  return tolerance_of(scenario, std::string(name.owner) + "." + std::string(observable->name));
}

}  // namespace slipcheck
