#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "app/commands.h"
#include "app/output.h"
#include "report/files/files.h"
#include "scenario/load.h"
#include "studies/sweep/sweep_block.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSchemaFile = "slipcheck.schema.json";

/// A scene that runs, with a word on each part; {name} and {schema} are filled in.
constexpr const char* kNewScene = R"(# yaml-language-server: $schema={schema}
# Say here what the scene shows, and where its expected values are from.
slipcheck: 1
name: {name}
title: "A ball slides, then rolls"
# Bare numbers are in SI; a unit may stand beside one, "2 mm". units: cgs is for papers.

materials:
  steel: {density: 7850}                 # kg/m³; or a mass for each body

contacts:                                # what happens when two materials meet
  - between: [steel, substrate]
    friction: 0.2                        # or {static: 0.3, kinetic: 0.2}
    rolling: 0.001                       # μ_r, what stops a rolling ball
  # - between: [steel, steel]            # for more than one ball
  #   normal: {model: hard, restitution: 0.9}
  #   tangential: {model: hard, friction: 0.1}

substrate: {}                            # the plane z = 0; {tilt: 5} is a slope

bodies:
  - {name: ball, material: steel, sphere: {radius: 0.02}, position: [0, 0], velocity: [0.5, 0], spin: none}

run: {until: rest, limit: 60}            # or until: rolling, or a number of seconds

compare:
  engines:                               # slipcheck list engines, slipcheck list profiles
    - {engine: bullet, precision: double, profile: default, rate: [240, 1000]}
    - {engine: bullet, precision: double, profile: tuned, rate: 240}
  tolerance: {sliding_time: 1 %, sliding_distance: 1 %}   # slipcheck list observables
)";

std::string replaced(std::string text, const std::string& word, const std::string& by) {
  text.replace(text.find(word), word.size(), by);
  return text;
}

/// Profiles are simple enough to be described here (docs/scenario-format.md); which settings an
/// engine takes is its own to say.
nlohmann::json profile_schema() {
  return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
          {"title", "Slipcheck profile, format version 1"},
          {"type", "object"},
          {"required", {"slipcheck-profile", "engine", "name"}},
          {"additionalProperties", false},
          {"properties",
           {{"slipcheck-profile", {{"const", 1}, {"description", "version of the format"}}},
            {"engine", {{"type", "string"}, {"description", "slipcheck list engines"}}},
            {"name",
             {{"type", "string"},
              {"pattern", "^[a-z0-9-]+$"},
              {"description", "under which reports show it"}}},
            {"about", {{"type", "string"}, {"description", "one line"}}},
            {"settings",
             {{"type", "object"},
              {"description", "what differs from the engine's own: slipcheck list settings"},
              {"additionalProperties", {{"type", {"number", "boolean", "string"}}}}}},
            {"provenance", {{"description", "how it came about; slipcheck tune writes it"}}}}}};
}

void write_new_scene(const std::string& name) {
  if (name.empty() ||
      name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") != std::string::npos)
    throw BadOption(fmt::format("NAME: must be of a-z, 0-9 and -, got {}", name));
  const fs::path file = name + ".yaml";
  if (fs::exists(file))
    throw BadOption(fmt::format("NAME: {} is there already and stays as it is", file.string()));
  check_output("NAME", file, false);
  const std::string text = replaced(replaced(kNewScene, "{schema}", kSchemaFile), "{name}", name);
  parse_scenario(text, file.string());
  write_file_atomically(kSchemaFile, sweep_file_schema().dump(2) + "\n");
  write_file_atomically(file, text);
  fmt::print("{}\n", file.string());
}

}  // namespace

void add_schema_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "schema", "Print the JSON Schema of the scenario format, for editors and other programs");
  auto of_profiles = std::make_shared<bool>(false);
  command->add_flag("--profile", *of_profiles, "That of profiles, an engine's settings in a file");
  command->footer(
      "Examples:\n  slipcheck schema > scenarios/schema.json\n"
      "  slipcheck schema --profile > profile.schema.json");
  accept_quiet(*command);
  command->callback([of_profiles, &exit_code] {
    fmt::print("{}\n", (*of_profiles ? profile_schema() : sweep_file_schema()).dump(2));
    exit_code = kWithinTolerance;
  });

  CLI::App* fresh = app.add_subcommand(
      "new", "Write a commented scene to begin with, and the schema that editors check it by");
  auto name = std::make_shared<std::string>();
  fresh->add_option("NAME", *name, "Of the scene and its file, of a-z, 0-9 and -")->required();
  fresh->footer("Example:\n  slipcheck new my-scene && slipcheck run my-scene.yaml");
  accept_quiet(*fresh);
  fresh->callback([name, &exit_code] {
    write_new_scene(*name);
    exit_code = kWithinTolerance;
  });
}

}  // namespace slipcheck
