#include "scenario/load.h"

#include <utility>

#include "scenario/assemble.h"
#include "scenario/file_text.h"
#include "scenario/presets.h"
#include "scenario/reading.h"
#include "scenario/rules/scene_rules.h"
#include "scenario/yaml_tree.h"

namespace slipcheck {
namespace {

/// What `units` says; a fault in it is noted when its turn comes.
UnitSystem units_of(const YamlNode& root, const std::string& file) {
  UnitSystem units = UnitSystem::si;
  Reading ignored(file, units);
  if (const YamlNode* node = root.find("units")) units_rule().read(*node, ignored, units);
  return units;
}

}  // namespace

Scenario scenario_of(const YamlPointer& tree, const std::string& file, ReadNumbers* numbers) {
  std::vector<UsedPreset> presets;
  const YamlPointer root = with_presets(tree, presets);
  Reading reading(file, units_of(*root, file));
  reading.note_numbers(numbers);
  WrittenScene written;
  if (is_mapping(*root)) {
    // Making it takes longer than reading a scene.
    static const Rule<WrittenScene> rule = scene_rule();
    rule.read(*root, reading, written);
  } else {
    reading.fault(*root, "must be a scene, a mapping that begins with slipcheck: 1");
    reading.throw_faults();
  }
  Scenario scenario = assemble(written, reading);
  reading.throw_faults();
  scenario.presets = std::move(presets);
  scenario.file = file;
  scenario.locations = reading.locations();
  return scenario;
}

Scenario parse_scenario(std::string_view text, const std::string& file) {
  Scenario scenario = scenario_of(parse_yaml(checked_text(text, file), file), file);
  scenario.text = text;
  scenario.sha256 = sha256_hex(text);
  return scenario;
}

Scenario load_scenario(const std::filesystem::path& file) {
  return parse_scenario(read_file(file), file.string());
}

}  // namespace slipcheck
