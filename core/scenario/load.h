#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scenario/fault.h"
#include "scenario/reading.h"
#include "scenario/scenario.h"
#include "scenario/yaml_tree.h"

namespace slipcheck {

/// Reads and checks one scene of format version 1. Throws BadScenario with every fault of the file.
Scenario load_scenario(const std::filesystem::path& file);

/// The same for a text in memory; `file` only names it in messages.
Scenario parse_scenario(std::string_view text, const std::string& file);

/// The same for a tree that was parsed, and may have been changed since: the scenario has no text,
/// and no `sha256`. Numbers at the paths that `numbers` names are noted there.
Scenario scenario_of(const YamlPointer& root, const std::string& file,
                     ReadNumbers* numbers = nullptr);

}  // namespace slipcheck
