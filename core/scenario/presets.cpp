#include "scenario/presets.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace slipcheck {
namespace {

/// The value of one key, changed; nothing where the key is missing or nothing changes.
template <class Change>
YamlPointer with_value(const YamlPointer& node, std::string_view key, const Change& change) {
  if (!is_mapping(*node)) return node;
  const auto entry = std::ranges::find(node->entries, key, &YamlNode::Entry::key);
  if (entry == node->entries.end()) return node;
  YamlPointer changed = change(entry->value);
  if (changed == entry->value) return node;
  auto copy = std::make_shared<YamlNode>(*node);
  copy->entries[static_cast<std::size_t>(entry - node->entries.begin())].value = std::move(changed);
  return copy;
}

template <class Change>
YamlPointer with_items(const YamlPointer& node, const Change& change) {
  if (!is_list(*node)) return node;
  std::shared_ptr<YamlNode> copy;
  for (std::size_t i = 0; i < node->items.size(); ++i) {
    YamlPointer changed = change(node->items[i], i);
    if (changed == node->items[i]) continue;
    if (!copy) copy = std::make_shared<YamlNode>(*node);
    copy->items[i] = std::move(changed);
  }
  return copy ? copy : node;
}

/// A preset's node as if it stood where the preset is named.
YamlPointer placed_at(const YamlNode& node, Location location) {
  auto copy = std::make_shared<YamlNode>(node);
  copy->location = location;
  for (YamlPointer& item : copy->items) item = placed_at(*item, location);
  for (YamlNode::Entry& entry : copy->entries) {
    entry.location = location;
    entry.value = placed_at(*entry.value, location);
  }
  return copy;
}

/// Puts presets into a scene.
class Presets {
 public:
  explicit Presets(std::vector<UsedPreset>& used) : used_(used) {}

  YamlPointer in_scene(const YamlPointer& root) {
    YamlPointer scene = with_value(root, "materials", [&](const YamlPointer& materials) {
      if (!is_mapping(*materials)) return materials;
      YamlPointer all = materials;
      for (const YamlNode::Entry& entry : materials->entries)
        all = with_value(all, entry.key, [&](const YamlPointer& material) {
          return merged(material, PresetPart::material, "materials." + entry.key);
        });
      return all;
    });
    scene = with_value(scene, "contacts", [&](const YamlPointer& contacts) {
      return with_items(contacts, [&](const YamlPointer& contact, std::size_t i) {
        return merged(contact, part_of(*contact), "contacts[" + std::to_string(i) + ']');
      });
    });
    return with_value(scene, "bodies", [&](const YamlPointer& bodies) {
      return with_items(bodies, [&](const YamlPointer& body, std::size_t i) {
        return in_body(body, "bodies[" + std::to_string(i) + ']');
      });
    });
  }

 private:
  /// The preset that a mapping names, if it has the part.
  static const Preset* preset_of(const YamlNode& node, PresetPart part) {
    const YamlNode* name = is_mapping(node) ? node.find("preset") : nullptr;
    const Preset* preset = name && is_scalar(*name) ? find_preset(name->text) : nullptr;
    return preset && preset->parts.contains(part) ? preset : nullptr;
  }

  static PresetPart part_of(const YamlNode& contact) {
    const YamlNode* between = is_mapping(contact) ? contact.find("between") : nullptr;
    const bool on_substrate =
        between && std::ranges::any_of(between->items, [](const YamlPointer& name) {
          return is_scalar(*name) && name->text == "substrate";
        });
    // One that has this part alone may stand beside other surfaces too.
    return on_substrate || !preset_of(contact, PresetPart::contact) ? PresetPart::substrate
                                                                    : PresetPart::contact;
  }

  YamlPointer merged(const YamlPointer& node, PresetPart part, const std::string& path) {
    const Preset* preset = preset_of(*node, part);
    if (!preset) return node;
    const Use use{preset, part, node->find("preset")->location};
    return with_keys(node, *preset->parts.at(part), use, path, name_of(part));
  }

  /// A ball's preset brings its mass too, which is the body's.
  YamlPointer in_body(const YamlPointer& body, const std::string& path) {
    YamlPointer made = with_value(body, "cue", [&](const YamlPointer& cue) {
      return merged(cue, PresetPart::cue, path + ".cue");
    });
    const YamlNode* sphere = is_mapping(*made) ? made->find("sphere") : nullptr;
    const Preset* preset = sphere ? preset_of(*sphere, PresetPart::sphere) : nullptr;
    if (!preset) return made;
    const Use use{preset, PresetPart::sphere, sphere->find("preset")->location};
    const YamlNode& part = *preset->parts.at(PresetPart::sphere);
    const bool has_size = sphere->find("radius") || sphere->find("diameter");
    YamlNode of_sphere, of_body;
    of_sphere.kind = of_body.kind = YamlNode::Kind::mapping;
    for (const YamlNode::Entry& entry : part.entries) {
      if (entry.key == "mass")
        of_body.entries.push_back(entry);
      else if (!has_size || entry.key != "diameter")
        of_sphere.entries.push_back(entry);
    }
    made = with_value(made, "sphere", [&](const YamlPointer& node) {
      return with_keys(node, of_sphere, use, path + ".sphere", "sphere");
    });
    return with_keys(made, of_body, use, path, "sphere");
  }

  struct Use {
    const Preset* preset;
    PresetPart part;
    Location location;
  };

  YamlPointer with_keys(const YamlPointer& node, const YamlNode& more, const Use& use,
                        const std::string& path, const std::string& place) {
    auto copy = std::make_shared<YamlNode>(*node);
    for (const YamlNode::Entry& entry : more.entries) {
      const std::string key_path = path + '.' + entry.key, key_place = place + '.' + entry.key;
      const auto there = std::ranges::find(copy->entries, entry.key, &YamlNode::Entry::key);
      if (there == copy->entries.end()) {
        copy->entries.push_back({entry.key, use.location, placed_at(*entry.value, use.location)});
        note(*entry.value, use, key_path, key_place);
      } else if (is_mapping(*there->value) && is_mapping(*entry.value) &&
                 !there->value->find("model")) {
        there->value = with_keys(there->value, *entry.value, use, key_path, key_place);
      }
    }
    return copy;
  }

  void note(const YamlNode& node, const Use& use, const std::string& path,
            const std::string& place) {
    for (const PresetValue& value : preset_values(node)) {
      const std::string below = value.key.empty() ? "" : '.' + value.key;
      used_.push_back(
          {path + below, value.value, use.preset->name, use.preset->source_of(place + below)});
    }
  }

  std::vector<UsedPreset>& used_;
};

}  // namespace

YamlPointer with_presets(const YamlPointer& root, std::vector<UsedPreset>& used) {
  return Presets(used).in_scene(root);
}

Rule<std::size_t> preset_name(PresetPart part) { return word(preset_names(part)); }

}  // namespace slipcheck
