#pragma once

#include <span>
#include <string>
#include <vector>

#include "scenario/scenario.h"

namespace slipcheck {

/// Engines, each in each precision under each profile.
struct EngineGrid {
  std::vector<std::string> engines;     ///< empty: all that are installed
  std::vector<std::string> precisions;  ///< "single", "double"; empty: those that are installed
  std::vector<std::string> profiles = {"default", "physical", "fast", "tuned"};
};

/// Puts the grid at these rates [Hz], > 0, into compare.engines in place of what the scene asks
/// for, in the order of engine, precision and profile; nothing is expected of these runs.
void ask_for(Scenario& scenario, const EngineGrid& grid, std::span<const double> rates);

}  // namespace slipcheck
