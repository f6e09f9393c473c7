#include "report/json/read_parts.h"

#include <algorithm>

#include "harness/compare/record.h"
#include "scenario/load.h"

namespace slipcheck {

Scenario read_scenario(const JsonNode& scene) {
  Scenario scenario;
  try {
    scenario = parse_scenario(scene.text("text"), scene.text("file"));
  } catch (const BadScenario& bad) {
    throw_bad_results(scene.file(), scene.place_of("text"),
                      "must be a scene that this version reads: " + bad.faults().front().message(),
                      nullptr);
  }
  if (scenario.sha256 != scene.text("sha256")) scene.fault("sha256", "must be that of the text");
  return scenario;
}

Settings read_settings(const JsonNode& node, const std::string& key) {
  const JsonNode object = node.at(key);
  Settings settings;
  bool any_null = false;
  for (const auto& [name, value] : object.json().items()) {
    any_null |= value.is_null();
    if (value.is_boolean())
      settings[name] = value.get<bool>();
    else if (value.is_string())
      settings[name] = value.get<std::string>();
    else
      settings[name] = object.number(name);
  }
  if (any_null) settings.erase("reason");  // which then is of the null
  return settings;
}

RunStatus read_status(const JsonNode& run) {
  return run.one_of<RunStatus>("status", 5, [](RunStatus status) { return name_of(status); });
}

Context read_context(const JsonNode& file) {
  const JsonNode slipcheck = file.at("slipcheck"), machine = file.at("machine");
  Context context;
  context.version = slipcheck.text("version");
  context.commit = slipcheck.text("commit");
  context.build = slipcheck.text("build");
  context.compiler = machine.text("compiler");
  context.system = machine.text("system");
  context.cpu = machine.text("processor");
  context.cores = static_cast<unsigned>(machine.count("hardware_threads"));
  return context;
}

}  // namespace slipcheck
