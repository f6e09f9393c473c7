#include "scenario/preset_data.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "scenario/presets_yaml.h"
#include "scenario/reading.h"

namespace slipcheck {
namespace {

constexpr std::pair<PresetPart, const char*> kParts[] = {{PresetPart::material, "material"},
                                                         {PresetPart::sphere, "sphere"},
                                                         {PresetPart::contact, "contact"},
                                                         {PresetPart::substrate, "substrate"},
                                                         {PresetPart::cue, "cue"}};

const YamlNode& at(const YamlNode& node, std::string_view key) {
  const YamlNode* found = node.find(key);
  if (!found) throw std::logic_error("presets.yaml lacks " + std::string(key));
  return *found;
}

Preset preset_of(const YamlNode::Entry& entry, const YamlNode& all_sources) {
  const YamlNode& node = *entry.value;
  Preset preset{entry.key, at(node, "about").text, {}, {}};
  for (const auto& [part, word] : kParts)
    for (const YamlNode::Entry& each : node.entries)
      if (each.key == word) preset.parts.emplace(part, each.value);
  for (const YamlNode::Entry& source : at(node, "sources").entries)
    preset.sources.emplace(source.key, at(all_sources, source.value->text).text);
  return preset;
}

std::vector<Preset> read_presets() {
  const YamlPointer root = parse_yaml(kPresetsYaml, "presets.yaml", "list of presets");
  std::vector<Preset> all;
  for (const YamlNode::Entry& entry : at(*root, "presets").entries)
    all.push_back(preset_of(entry, at(*root, "sources")));
  return all;
}

void add_values(const YamlNode& node, const std::string& key, std::vector<PresetValue>& values) {
  if (node.kind != YamlNode::Kind::mapping) {
    values.push_back({key, shown(node)});
    return;
  }
  for (const YamlNode::Entry& entry : node.entries)
    if (entry.key != "model")
      add_values(*entry.value, key.empty() ? entry.key : key + '.' + entry.key, values);
}

}  // namespace

const char* name_of(PresetPart part) {
  return std::ranges::find(kParts, part, &std::pair<PresetPart, const char*>::first)->second;
}

std::string Preset::source_of(std::string place) const {
  for (;;) {
    if (const auto found = sources.find(place); found != sources.end()) return found->second;
    const std::size_t dot = place.rfind('.');
    if (dot == std::string::npos) return "";
    place.resize(dot);
  }
}

const std::vector<Preset>& presets() {
  static const std::vector<Preset> all = read_presets();
  return all;
}

const Preset* find_preset(std::string_view name) {
  const auto found = std::ranges::find(presets(), name, &Preset::name);
  return found == presets().end() ? nullptr : &*found;
}

std::vector<std::string> preset_names(PresetPart part) {
  std::vector<std::string> names;
  for (const Preset& preset : presets())
    if (preset.parts.contains(part)) names.push_back(preset.name);
  return names;
}

std::vector<PresetValue> preset_values(const YamlNode& node) {
  std::vector<PresetValue> values;
  add_values(node, "", values);
  return values;
}

}  // namespace slipcheck
