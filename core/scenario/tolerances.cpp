#include "scenario/tolerances.h"

#include <algorithm>
#include <limits>

#include "scenario/observable_key.h"
#include "scenario/owned_names.h"

namespace slipcheck {
namespace {

/// How much a key says of the owner: nothing, by a pattern, all.
std::size_t weight(std::string_view key) {
  const std::string_view owner = observable_key(key).owner;
  const auto wildcards = static_cast<std::size_t>(std::ranges::count(owner, '*'));
  if (owner.empty()) return 0;
  return wildcards > 0 ? 1 + owner.size() - wildcards : std::numeric_limits<std::size_t>::max();
}

}  // namespace

bool names_observable(const Scenario& scenario, std::string_view key, std::string_view full_name) {
  const ObservableKey name = observable_key(full_name), named = observable_key(key);
  if (named.observable != name.observable || named.component != name.component) return false;
  if (!named.owner.empty()) return matches(named.owner, name.owner);
  return !name.owner.ends_with("-substrate") || scenario.bodies.size() == 1;
}

std::optional<Tolerance> tolerance_of(const Scenario& scenario, std::string_view full_name) {
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
  const ObservableName* observable = observable_key(full_name).known();
  tolerance.absolute |= observable != nullptr && observable->is_restitution;
  return tolerance;
}

std::optional<Tolerance> tolerance_of_part(const Scenario& scenario, std::string_view full_name) {
  if (auto tolerance = tolerance_of(scenario, full_name)) return tolerance;
  const ObservableKey key = observable_key(full_name);
  if (key.component == '\0') return std::nullopt;
  return tolerance_of(scenario, key.whole().text());
}

}  // namespace slipcheck
