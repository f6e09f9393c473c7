#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/engine.h"
#include "engine/engine_registry.h"
#include "scenario/fault.h"

namespace slipcheck {

/// An engine's settings under a name, from a YAML file of format 1 (docs/scenario-format.md).
struct Profile {
  std::string engine;
  std::string name;   ///< of a-z, 0-9 and -
  std::string about;  ///< one line; may be empty
  Settings settings;  ///< those that differ from what the engine ships with

  std::string file;  ///< as it was opened
  /// Where each key stands in the file, by its path, as in "settings.erp".
  std::map<std::string, Location> locations;
};

/// Reads a profile. Throws BadScenario with every fault of the file. Whether the engine takes the
/// settings is check_profile's to say.
Profile load_profile(const std::filesystem::path& file);
/// The same for a text in memory; `file` only names it in messages.
Profile parse_profile(std::string_view text, const std::string& file);

/// What an engine cannot take of a profile: it is another engine's, settings that the engine has
/// not, values that it does not take.
std::vector<Fault> check_profile(const Profile& profile, const EngineInfo& info);

/// Whether a scenario's `profile` is the path of a file, not a name: it holds a '/' or ends in
/// .yaml or .yml.
bool is_profile_path(const std::string& profile);

/// The file of a profile: a path as it stands, taken from `directory` where it is relative; a name
/// as one of the files shipped beside the engine's executable, in `profiles/<engine>/`. Nothing
/// where no file is shipped under the name.
std::optional<std::filesystem::path> find_profile(const EngineExecutable& executable,
                                                  const std::string& profile,
                                                  const std::filesystem::path& directory);

/// The names of the profiles shipped beside an engine's executable, sorted.
std::vector<std::string> profile_names(const EngineExecutable& executable);

/// A profile as a file of format 1. `provenance` is the YAML below the key of that name, without
/// its indentation; left out where empty.
std::string profile_yaml(const Profile& profile, const std::vector<std::string>& provenance = {});

}  // namespace slipcheck
