#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/folder.h"
#include "engine/profile.h"
#include "engine/settings.h"
#include "scenario/units.h"

namespace slipcheck {

namespace fs = std::filesystem;

namespace {

bool is_profile_name(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
}

/// Whether a word, written without quotes, reads back as itself wherever YAML is read.
bool stands_plain(const std::string& word) {
  const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
  if (word.empty() || !is_letter(word[0])) return false;
  for (const char* other : {"true", "false", "yes", "no", "on", "off", "y", "n", "null"})
    if (word == other) return false;
  try {
    parse_number(word);
    return false;
  } catch (const BadQuantity&) {
    return std::ranges::all_of(word, [&](char c) {
      return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
  }
}

/// A JSON string is a double-quoted YAML scalar.
std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

std::string value_text(const Setting& setting) {
  const std::string text = exact_text(setting);
  return std::holds_alternative<std::string>(setting) && !stands_plain(text) ? quoted(text) : text;
}

}  // namespace

bool is_profile_path(const std::string& profile) {
  return profile.find('/') != std::string::npos || profile.ends_with(".yaml") ||
         profile.ends_with(".yml");
}

std::optional<fs::path> find_profile(const EngineExecutable& executable, const std::string& profile,
                                     const fs::path& directory) {
  if (is_profile_path(profile)) return directory / profile;
  if (!is_profile_name(profile)) return std::nullopt;
  const fs::path file = executable.profiles / (profile + ".yaml");
  std::error_code ignored;
  return fs::exists(file, ignored) ? std::optional(file) : std::nullopt;
}

std::vector<std::string> profile_names(const EngineExecutable& executable) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const fs::path& file : entries_of(executable.profiles, ignored)) {
    const std::string stem = file.stem().string();
    if (file.extension() == ".yaml" && is_profile_name(stem)) names.push_back(stem);
  }
  std::ranges::sort(names);
  return names;
}

std::string profile_yaml(const Profile& profile, const std::vector<std::string>& provenance) {
  std::string text = fmt::format("slipcheck-profile: 1\nengine: {}\nname: {}\n",
                                 value_text(profile.engine), value_text(profile.name));
  if (!profile.about.empty()) text += fmt::format("about: {}\n", quoted(profile.about));
  if (!profile.settings.empty()) text += "settings:\n";
  for (const auto& [name, value] : profile.settings)
    text += fmt::format("  {}: {}\n", name, value_text(value));
  if (!provenance.empty()) text += "provenance:\n";
  for (const std::string& line : provenance) text += fmt::format("  {}\n", line);
  return text;
}

}  // namespace slipcheck
