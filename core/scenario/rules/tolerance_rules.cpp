#include <fmt/format.h>

#include <utility>
#include <vector>

#include "scenario/owned_names.h"
#include "scenario/rules/scene_rules.h"

namespace slipcheck {
namespace {

using nlohmann::json;

/// A number, with a unit absolute, or none.
Rule<Tolerance> tolerance_rule(const ObservableName& observable) {
  // A pure number, or a share in %, is relative whatever the observable's dimension.
  const Dimension dimension = observable.dimension;
  const bool has_dimension = dimension.mass != 0 || dimension.length != 0 || dimension.time != 0;
  const Rule<double> relative = number(kPureNumber, kNotNegative);
  const Rule<double> absolute = number(dimension, kNotNegative);
  const Rule<std::size_t> nothing = word({"none"});
  return {[=](const YamlNode& node, Reading& reading, Tolerance& target) {
            if (is_word("none")(node)) return target.none = true;
            if (has_dimension && is_scalar(node)) {
              try {
                const bool has_unit = parse_quantity(node.text, dimension).has_unit;
                target.absolute = has_unit;
              } catch (const BadQuantity&) {
                try {
                  parse_quantity(node.text, kPureNumber);
                } catch (const BadQuantity&) {
                  reading.fault(node, fmt::format("must be a number, a share as in \"1 %\" or {} "
                                                  "as in \"{}\"",
                                                  with_article(dimension), dimension.example));
                  return false;
                }
              }
            }
            return (target.absolute ? absolute : relative).read(node, reading, target.value);
          },
          [=] {
            return json{{"anyOf", {relative.schema(), nothing.schema()}}};
          }};
}

/// Names without an owner: of vectors also the components.
std::vector<std::string> bare_names() {
  std::vector<std::string> names;
  for (const ObservableName& each : observable_names()) {
    names.emplace_back(each.name);
    if (!each.is_vector) continue;
    for (std::string& component : ObservableKey{"", each.name}.components())
      names.push_back(std::move(component));
  }
  return names;
}

std::string fault_of_key(const std::string& key, const std::vector<std::string>& bare) {
  const ObservableKey parts = observable_key(key);
  if (!parts.owner.empty() && !find_observable(parts.owner))
    return fault_of_owned_name(key, Wildcards::yes);
  if (parts.owner.empty() && parts.known()) return "";
  const std::string near = nearest(key, bare);
  return near.empty() ? "must be an observable, or one of an owner as in i-j.restitution"
                      : fmt::format("is not a key here (did you mean {}?)", near);
}

json tolerances_schema() {
  json properties = json::object();
  for (const std::string& name : bare_names()) {
    const ObservableName* observable = observable_key(name).known();
    properties[name] = tolerance_rule(*observable).schema();
    properties[name]["description"] = std::string(observable->doc);
  }
  return {{"type", "object"},
          {"properties", properties},
          {"patternProperties", owned_names_schema(Wildcards::yes,
                                                   [](const ObservableName& each) {
                                                     return tolerance_rule(each).schema();
                                                   })},
          {"additionalProperties", false}};
}

}  // namespace

Rule<std::map<std::string, Tolerance>> tolerances_rule() {
  const auto read = [bare = bare_names()](const YamlNode& node, Reading& reading,
                                          std::map<std::string, Tolerance>& target) {
    if (!is_mapping(node)) {
      reading.fault(node, "must be a mapping {restitution: 0.01, i.final_position: 1 %, …}");
      return false;
    }
    bool good = true;
    for (const YamlNode::Entry& entry : node.entries) {
      const auto step = reading.key(shown(entry.key), entry.location, *entry.value);
      std::string rule =
          target.contains(entry.key) ? "must stand here once" : fault_of_key(entry.key, bare);
      if (rule.empty()) {
        const ObservableName& observable = *observable_key(entry.key).known();
        good = tolerance_rule(observable).read(*entry.value, reading, target[entry.key]) && good;
      } else {
        reading.fault(entry.location, reading.path(), std::move(rule));
        good = false;
      }
    }
    return good;
  };
  return {read, tolerances_schema};
}

}  // namespace slipcheck
