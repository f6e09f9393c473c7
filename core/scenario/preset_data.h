#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/yaml_tree.h"

namespace slipcheck {

/// Where a preset may stand: in a material, in a sphere, in a contact of two bodies, in one with
/// the substrate, in a cue's stroke.
enum class PresetPart { material, sphere, contact, substrate, cue };
/// The part's word in presets.yaml.
const char* name_of(PresetPart part);

/// Values with their sources, under one name.
struct Preset {
  std::string name;   ///< "pool-ball"
  std::string about;  ///< one line
  std::map<PresetPart, YamlPointer> parts;
  /// By place, the part's word first, "contact.normal": where its values are from.
  std::map<std::string, std::string> sources;

  /// Of a value at this place, or at one that encloses it; empty where there is none.
  std::string source_of(std::string place) const;
};

/// All of presets.yaml, in its order.
const std::vector<Preset>& presets();
/// Null where there is none of that name.
const Preset* find_preset(std::string_view name);
/// Names of those that have the part.
std::vector<std::string> preset_names(PresetPart part);

/// One value of a preset.
struct PresetValue {
  std::string key;    ///< "normal.restitution"
  std::string value;  ///< as it stands in the file
};
/// All values below a node, but not the words that choose a model.
std::vector<PresetValue> preset_values(const YamlNode& node);

}  // namespace slipcheck
