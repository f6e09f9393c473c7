#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "app/bundled_scenes.h"
#include "app/commands.h"
#include "app/list_engines.h"
#include "app/print_list.h"
#include "app/say.h"
#include "scenario/fault.h"
#include "scenario/load.h"
#include "scenario/observable_names.h"
#include "scenario/preset_data.h"
#include "scenario/schema.h"

namespace slipcheck {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

Json list_scenarios() {
  Json list = Json::array();
  std::error_code ignored;
  for (const fs::path& file : bundled_scenes()) {
    try {
      const Scenario scenario = load_scenario(file);
      list.push_back(Json{{"name", scenario.name},
                          {"title", scenario.title},
                          {"bodies", scenario.bodies.size()},
                          {"file", fs::proximate(file, ignored).string()}});
    } catch (const BadScenario& bad) {
      say("{}\n", bad.what());
    }
  }
  return list;
}

Json list_observables() {
  Json list = Json::array();
  for (const ObservableName& observable : observable_names()) {
    const char* scope = observable.scope == ObservableScope::body   ? "body"
                        : observable.scope == ObservableScope::pair ? "pair"
                                                                    : "all";
    list.push_back(Json{{"name", observable.name},
                        {"of", scope},
                        {"unit", observable.dimension.si},
                        {"vector", observable.is_vector},
                        {"meaning", observable.doc}});
  }
  return list;
}

/// The solvers that take a model. Between bodies, `event` takes hard contacts, which alone can
/// collapse, and `contact` soft ones; what the substrate does, both take.
Json solvers_of(const std::string& key, const std::string& model) {
  if (key == "normal") return {model == "hard" ? "event" : "contact"};
  if (key == "tangential" && model != "none") return {model == "hard" ? "event" : "contact"};
  if (key == "collapse") return {"event"};
  return {"event", "contact"};
}

/// The alternatives of every key of the format that names a model, from the format's own schema.
void collect_models(const nlohmann::json& node, const std::string& key, Json& list) {
  if (node.is_array()) {
    for (const auto& item : node) collect_models(item, key, list);
    return;
  }
  if (!node.is_object()) return;
  const auto properties = node.find("properties");
  if (properties != node.end())
    for (const char* selector : {"model", "kind"})
      if (properties->contains(selector) && (*properties)[selector].contains("const")) {
        const auto model = (*properties)[selector]["const"].get<std::string>();
        Json parameters = Json::array();
        for (const auto& [name, rule] : properties->items())
          if (name != selector) parameters.push_back(name);
        list.push_back(Json{{"key", key},
                            {"model", model},
                            {"solvers", solvers_of(key, model)},
                            {"parameters", std::move(parameters)}});
      }
  for (const auto& [name, child] : node.items()) {
    if (name == "properties") {
      for (const auto& [property, rule] : child.items()) collect_models(rule, property, list);
    } else {
      collect_models(child, key, list);
    }
  }
}

/// A row for each value of each preset.
Json list_presets() {
  Json list = Json::array();
  for (const Preset& preset : presets())
    for (const auto& [part, node] : preset.parts)
      for (const PresetValue& value : preset_values(*node))
        list.push_back(
            Json{{"name", preset.name},
                 {"of", name_of(part)},
                 {"key", value.key},
                 {"value", value.value},
                 {"about", preset.about},
                 {"source", preset.source_of(std::string(name_of(part)) + '.' + value.key)}});
  return list;
}

Json list_models() {
  Json list = Json::array();
  collect_models(scenario_schema(), "", list);
  return list;
}

}  // namespace

void add_list_command(CLI::App& app, int& exit_code) {
  static const std::map<std::string, Json (*)()> lists = {
      {"engines", list_engines},  {"models", list_models},     {"observables", list_observables},
      {"presets", list_presets},  {"profiles", list_profiles}, {"scenarios", list_scenarios},
      {"settings", list_settings}};
  CLI::App* command = app.add_subcommand(
      "list",
      "List the engines, their profiles and settings, scenarios, observables, models or presets");
  auto what = std::make_shared<std::string>();
  auto as_json = std::make_shared<bool>(false);
  command
      ->add_option("WHAT", *what,
                   "engines, profiles, settings, scenarios, observables, models or presets")
      ->required()
      ->check(CLI::IsMember(lists));
  command->add_flag("--json", *as_json, "As JSON");
  accept_quiet(*command);
  command->footer("Example:\n  slipcheck list observables --json");
  command->callback([what, as_json, &exit_code] {
    const Json list = lists.at(*what)();
    if (*as_json)
      fmt::print("{}\n", list.dump(2));
    else
      print_list(*what == "settings" ? settings_in_words(list) : list);
    exit_code = kWithinTolerance;
  });
}

}  // namespace slipcheck
