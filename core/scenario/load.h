#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scenario/fault.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// Reads and checks one scene of format version 1. Throws BadScenario with every fault of the file.
Scenario load_scenario(const std::filesystem::path& file);

/// The same for a text in memory; `file` only names it in messages.
Scenario parse_scenario(std::string_view text, const std::string& file);

}  // namespace slipcheck
