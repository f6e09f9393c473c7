#include "engine/profile.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/settings.h"
#include "scenario/file_text.h"
#include "scenario/reading.h"
#include "scenario/record_keys.h"
#include "scenario/rules/rules.h"
#include "scenario/yaml_tree.h"

namespace slipcheck {
namespace {

/// What a scalar means: without quotes true, false or a number, else a word.
Setting setting_of(const YamlNode& node) {
  if (!node.plain) return node.text;
  if (node.text == "true") return true;
  if (node.text == "false") return false;
  try {
    return parse_number(node.text);
  } catch (const BadQuantity&) {
    return node.text;
  }
}

/// {name: value, …}; which names there are is the engine's to say.
bool read_settings(const YamlNode& node, Reading& reading, Settings& target) {
  if (!is_mapping(node)) {
    reading.fault(node, "must be a mapping {name: value, …}");
    return false;
  }
  bool good = true;
  for (const YamlNode::Entry& entry : node.entries) {
    const auto step = reading.key(shown(entry.key), entry.location, *entry.value);
    const auto first = std::ranges::find(node.entries, entry.key, &YamlNode::Entry::key);
    if (&*first != &entry) {
      reading.fault(
          entry.location, reading.path(),
          fmt::format("must stand here once, but stands in line {} too", first->location.line));
      good = false;
      continue;
    }
    if (!is_scalar(*entry.value)) {
      // Where there is nothing the key has a place at least.
      const bool empty = entry.value->kind == YamlNode::Kind::null;
      reading.fault(empty ? entry.location : entry.value->location, reading.path(),
                    "must be true, false, a number or a word", shown(*entry.value));
      good = false;
      continue;
    }
    target.emplace(entry.key, setting_of(*entry.value));
  }
  return good;
}

/// What is read into something that nobody looks at has no schema: a profile's schema would be
/// each engine's own.
template <class T, class Read>
Rule<T> only_read(Read read) {
  return {read, [] { return nlohmann::json::object(); }};
}

Rule<Profile> profile_rule() {
  const Rule<std::int64_t> version = integer(1, 1);
  const Rule<std::string> text = free_text();
  Record<Profile> profile;
  profile
      .whole("slipcheck-profile",
             only_read<Profile>([=](const YamlNode& node, Reading& reading, Profile&) {
               std::int64_t format = 0;
               return version.read(node, reading, format);
             }),
             required, "the format's version")
      .key("engine", &Profile::engine, name_text(NameStyle::lower_case), required, "")
      .key("name", &Profile::name, name_text(NameStyle::lower_case), required, "")
      .key("about", &Profile::about,
           only_read<std::string>([=](const YamlNode& node, Reading& reading, std::string& target) {
             if (!text.read(node, reading, target)) return false;
             if (target.find('\n') == std::string::npos) return true;
             reading.fault(node, "must be one line");
             return false;
           }),
           optional, "")
      .key("settings", &Profile::settings, only_read<Settings>(read_settings), optional, "")
      .whole("provenance",
             only_read<Profile>([](const YamlNode&, Reading&, Profile&) { return true; }), optional,
             "whatever whoever wrote the file wants to tell");
  return profile.rule();
}

}  // namespace

Profile load_profile(const std::filesystem::path& file) {
  return parse_profile(read_file(file), file.string());
}

Profile parse_profile(std::string_view text, const std::string& file) {
  const YamlPointer root = parse_yaml(checked_text(text, file, "profile"), file, "profile");
  Reading reading(file, UnitSystem::si);
  Profile profile;
  if (is_mapping(*root)) {
    profile_rule().read(*root, reading, profile);
  } else {
    reading.fault(*root, "must be a profile, a mapping that begins with slipcheck-profile: 1");
  }
  reading.throw_faults();
  profile.file = file;
  profile.locations = reading.locations();
  return profile;
}

std::vector<Fault> check_profile(const Profile& profile, const EngineInfo& info) {
  std::vector<Fault> faults;
  const auto add = [&](const std::string& key, std::string rule, const std::string& value) {
    const auto place = profile.locations.find(key);
    faults.push_back({profile.file, place == profile.locations.end() ? Location{} : place->second,
                      key, std::move(rule), shown(value)});
  };
  if (profile.engine != info.engine)
    add("engine", fmt::format("must be {}, which is to run with it", info.engine), profile.engine);
  std::vector<std::string> names;
  for (const SettingInfo& known : info.settings) names.push_back(known.name);
  for (SettingFault& fault : check_settings(info.settings, profile.settings)) {
    if (find_setting(info.settings, fault.name) == nullptr) {
      fault.rule += did_you_mean(fault.name, names);
    }
    add("settings." + shown(fault.name), std::move(fault.rule), fault.value);
  }
  return faults;
}

}  // namespace slipcheck
