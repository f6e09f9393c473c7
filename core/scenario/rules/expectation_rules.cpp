#include <fmt/format.h>

#include <map>
#include <utility>

#include "scenario/owned_names.h"
#include "scenario/record_keys.h"
#include "scenario/rules/scene_rules.h"

namespace slipcheck {
namespace {

using nlohmann::json;

/// [low, high]
Rule<ExpectedRange> range_rule(const Dimension& dimension) {
  const Rule<std::vector<double>> limits = numbers(dimension, kAnyNumber, {2});
  return {[limits](const YamlNode& node, Reading& reading, ExpectedRange& target) {
            std::vector<double> values;
            if (!limits.read(node, reading, values)) return false;
            target = {values[0], values[1]};
            if (target.low <= target.high) return true;
            reading.fault(node, "must have the lower limit first");
            return false;
          },
          limits.schema};
}

Rule<ExpectedObservable> observable_rule(const ObservableName& observable) {
  const Rule<ExpectedRange> range = range_rule(observable.dimension);
  Record<ExpectedObservable> ranges;
  ranges
      .key("min", &ExpectedObservable::min, range, optional,
           "where the least value over the phases lies")
      .key("median", &ExpectedObservable::median, range, optional, "where the median lies")
      .key("max", &ExpectedObservable::max, range, optional, "where the largest value lies")
      .at_least_one_of({"min", "median", "max"});
  const Rule<std::size_t> nothing = word({"none"});
  const Rule<ExpectedObservable> none = {
      [nothing](const YamlNode& node, Reading& reading, ExpectedObservable& target) {
        std::size_t index = 0;
        return target.none = nothing.read(node, reading, index);
      },
      nothing.schema};
  return one_form_of<ExpectedObservable>(
      "must be limits of min, median or max as in {max: [low, high]}, or none",
      {{is_word("none"), none}, {is_mapping, ranges.rule()}});
}

json expectation_schema(const Rule<std::size_t>& status) {
  const json observables = owned_names_schema(
      Wildcards::no, [](const ObservableName& each) { return observable_rule(each).schema(); });
  json statuses = status.schema();
  statuses["description"] = "how the run ends";
  return {{"type", "object"},
          {"oneOf",
           {{{"properties", {{"status", statuses}}},
             {"required", {"status"}},
             {"additionalProperties", false}},
            {{"patternProperties", observables},
             {"minProperties", 1},
             {"additionalProperties", false}}}}};
}

}  // namespace

Rule<Expectation> expectation_rule() {
  const std::vector<std::pair<std::string, RunStatus>> statuses = {
      {"unstable", RunStatus::unstable},
      {"crashed", RunStatus::crashed},
      {"timed_out", RunStatus::timed_out},
      {"skipped", RunStatus::skipped}};
  std::vector<std::string> words;
  for (const auto& each : statuses) words.push_back(each.first);
  const Rule<std::size_t> status = word(words);
  std::map<std::string_view, Rule<ExpectedObservable>> observables;
  for (const ObservableName& each : observable_names())
    observables.emplace(each.name, observable_rule(each));

  const auto read = [=](const YamlNode& node, Reading& reading, Expectation& target) {
    if (!is_mapping(node) || node.entries.empty()) {
      reading.fault(node,
                    "must be a mapping {i-j.restitution: {max: [low, high]}, …} or "
                    "{status: …}");
      return false;
    }
    bool good = true;
    for (const YamlNode::Entry& entry : node.entries) {
      const auto step = reading.key(shown(entry.key), entry.location, *entry.value);
      const auto refuse = [&](std::string rule) {
        reading.fault(entry.location, reading.path(), std::move(rule));
        good = false;
      };
      if (target.observables.contains(entry.key) || (entry.key == "status" && target.status)) {
        refuse("must stand here once");
      } else if (entry.key == "status") {
        std::size_t index = 0;
        good = status.read(*entry.value, reading, index) && good;
        target.status = statuses[index].second;
        if (node.entries.size() > 1)
          refuse("must stand alone: a run that does not end well shows no observables");
      } else if (std::string rule = fault_of_owned_name(entry.key, Wildcards::no); !rule.empty()) {
        refuse(std::move(rule));
      } else {
        const std::string_view name = observable_key(entry.key).observable;
        const Rule<ExpectedObservable>& observable = observables.at(name);
        good = observable.read(*entry.value, reading, target.observables[entry.key]) && good;
      }
    }
    return good;
  };
  return {read, [status] { return expectation_schema(status); }};
}

}  // namespace slipcheck
