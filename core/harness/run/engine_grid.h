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
  /// A profile that only some of the engines have is not asked for of the others; else their runs
  /// are there and say so.
  bool where_there = false;
};

/// What is asked for in place of what a scene says; what is empty stays as the scene has it.
struct EngineChoice {
  std::vector<std::string> engines = {};     ///< "all" alone: all that are installed
  std::vector<std::string> precisions = {};  ///< "single", "double"
  std::vector<std::string> profiles = {};
  std::vector<double> rates = {};  ///< [Hz], > 0
};

/// What the grid asks for at these rates [Hz], > 0, in the order of engine, precision and profile;
/// nothing is expected of these runs.
std::vector<EngineRequest> requests_of(const EngineGrid& grid, std::span<const double> rates);

/// What a scene asks for: its list, or where it asks for all engines, these.
std::vector<EngineRequest> requests_of(const Scenario& scenario);

/// Puts the choice into compare.engines: engines in place of those of the scene, under their
/// profiles default and physical at 240 and 1000 Hz where neither is chosen; else the scene's
/// engines with what is chosen in place of their own. Nothing is expected of what is changed.
void choose_engines(Scenario& scenario, const EngineChoice& choice);

/// Puts the grid at these rates into compare.engines in place of what the scene asks for, in one
/// heading and at its own scale.
void ask_for(Scenario& scenario, const EngineGrid& grid, std::span<const double> rates);

}  // namespace slipcheck
