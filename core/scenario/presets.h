#pragma once

#include <string>
#include <vector>

#include "scenario/preset_data.h"
#include "scenario/rules/rules.h"

namespace slipcheck {

/// The scene with what its presets bring beside what stands there: of each key that the file has
/// too the file's value counts, in mappings key by key unless the file's chooses a `model` of its
/// own. What comes from a preset has the place of the key `preset`. Names that are none are left to
/// preset_rule(). `used` gets the values that the scene takes from presets.
YamlPointer with_presets(const YamlPointer& root, std::vector<UsedPreset>& used);

/// A preset's name at a place of this kind.
Rule<std::size_t> preset_name(PresetPart part);
/// The key `preset` of a record; reads nothing into it, as with_presets() has put its values there.
template <class T>
Rule<T> preset_rule(PresetPart part) {
  const Rule<std::size_t> name = preset_name(part);
  return {[name](const YamlNode& node, Reading& reading, T&) {
            std::size_t index = 0;
            return name.read(node, reading, index);
          },
          name.schema};
}

}  // namespace slipcheck
