#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "scenario/owned_names.h"
#include "scenario/rules/scene_names.h"
#include "scenario/rules/spanning_rules.h"
#include "scenario/surfaces.h"

namespace slipcheck {
namespace {

/// A body's place in the order of the scene: that of its entry, and within a fill.
using Place = std::pair<std::size_t, std::int64_t>;

std::optional<Place> place_in(const Fill& fill, const std::string& name, std::size_t entry) {
  const std::int64_t number = number_in(fill, name);
  return number > 0 ? std::optional(Place(entry, number)) : std::nullopt;
}

std::optional<Place> place_of(const WrittenScene& written, const std::string& name) {
  std::size_t entry = 0;
  for (const auto& each : written.bodies) {
    ++entry;
    if (const auto* body = std::get_if<WrittenBody>(&each)) {
      if (body->name == name) return Place(entry, 0);
    } else if (const auto place = place_in(std::get<Fill>(each), name, entry)) {
      return place;
    }
  }
  for (const Fill& fill : written.fill)
    if (const auto place = place_in(fill, name, ++entry)) return place;
  return std::nullopt;
}

/// The substrate, where there is one, and the surfaces.
std::vector<std::string> carriers(const WrittenScene& written) {
  std::vector<std::string> names;
  if (written.substrate) names.emplace_back("substrate");
  for (const NamedSurface& surface : named_surfaces(written)) names.push_back(surface.name);
  return names;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

/// Why the scene has no such pair, "" if it has.
std::string fault_of_pair(const WrittenScene& written, const std::string& pair) {
  for (std::size_t at = pair.find('-'); at != std::string::npos; at = pair.find('-', at + 1)) {
    const std::string left = pair.substr(0, at), right = pair.substr(at + 1);
    const auto first = place_of(written, left);
    if (first && has(carriers(written), right)) return "";
    const auto second = place_of(written, right);
    if (!first || !second || *first == *second) continue;
    return *first < *second
               ? ""
               : fmt::format("must have the pair in the order of the bodies, {}-{}", right, left);
  }
  return fmt::format(
      "must be of a pair of this scene's bodies, or of one and the substrate{}, but "
      "{} is none",
      written.surfaces.empty() ? "" : " or a surface", pair);
}

/// Whether one of the bodies has a name that a pattern stands for.
bool any_body_matches(const WrittenScene& written, const std::string& pattern) {
  if (pattern.find('*') == std::string::npos) return place_of(written, pattern).has_value();
  const auto any_of_fill = [&](const Fill& fill) {
    for (std::int64_t k = 1; fill.complete && k <= fill.count; ++k)
      if (matches(pattern, fill.prefix + std::to_string(k))) return true;
    return false;
  };
  const auto any = [&](const std::variant<WrittenBody, Fill>& each) {
    const auto* body = std::get_if<WrittenBody>(&each);
    return body ? matches(pattern, body->name) : any_of_fill(std::get<Fill>(each));
  };
  return std::ranges::any_of(written.bodies, any) || std::ranges::any_of(written.fill, any_of_fill);
}

/// Whether a pattern with wildcards may stand for a pair of the bodies, or one and the substrate.
bool any_pair_matches(const WrittenScene& written, const std::string& pattern) {
  if (pattern == "*") return true;
  const std::vector<std::string> others = carriers(written);
  for (std::size_t at = pattern.find('-'); at != std::string::npos; at = pattern.find('-', at + 1))
    if (const std::string left = pattern.substr(0, at), right = pattern.substr(at + 1);
        any_body_matches(written, left) &&
        (std::ranges::any_of(others,
                             [&](const std::string& name) { return matches(right, name); }) ||
         any_body_matches(written, right)))
      return true;
  return false;
}

/// Why nothing of this name is seen of an engine in this scene, "" if it may be. The owner may have
/// wildcards.
std::string fault_of_owner(const WrittenScene& written, const std::string& name) {
  const ObservableKey key = observable_key(name);
  const std::string owner(key.owner);
  const ObservableScope scope = key.known()->scope;
  if (!written.surfaces.empty() && name == "all.height") return "";
  if (written.container.has_value() != (scope == ObservableScope::all))
    return written.container ? "must be of all, as nothing else is seen in a container"
                             : (written.surfaces.empty()
                                    ? "must be of a body or a pair: all is only for a container"
                                    : "must be of a body or a pair, or all.height: other "
                                      "observables of all are only for a container");
  if (scope == ObservableScope::body && !any_body_matches(written, owner))
    return fmt::format("must be of one of the bodies, but {} is none", owner);
  if (scope == ObservableScope::pair && owner.find('*') != std::string::npos)
    return any_pair_matches(written, owner)
               ? ""
               : fmt::format("must match a pair of this scene's bodies, but {} matches none",
                             owner);
  return scope == ObservableScope::pair ? fault_of_pair(written, owner) : "";
}

}  // namespace

void check_expectations(const WrittenScene& written, Reading& reading) {
  const auto& engines = written.compare.engines;
  for (std::size_t k = 0; k < engines.size(); ++k) {
    if (!engines[k].expect) continue;
    for (const auto& [name, expected] : engines[k].expect->observables) {
      std::string rule = fault_of_owner(written, name);
      if (!rule.empty())
        reading.fault_at(fmt::format("compare.engines[{}].expect.{}", k, name), std::move(rule));
    }
  }
}

void check_tolerances(const WrittenScene& written, Reading& reading) {
  for (const auto& [name, tolerance] : written.compare.tolerance) {
    if (observable_key(name).owner.empty()) continue;
    std::string rule = fault_of_owner(written, name);
    if (!rule.empty()) reading.fault_at("compare.tolerance." + name, std::move(rule));
  }
}

}  // namespace slipcheck
