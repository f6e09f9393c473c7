#pragma once

#include <string>
#include <vector>

#include "scenario/scenario.h"

namespace slipcheck {

/// Loads all scenes. Throws BadScenario with the faults of all files together, also where two
/// scenes bear one name.
std::vector<Scenario> load_files(const std::vector<std::string>& files);

}  // namespace slipcheck
