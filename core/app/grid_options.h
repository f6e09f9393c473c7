#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "harness/run/engine_grid.h"
#include "harness/run/scene_run.h"

namespace slipcheck {

/// What `precision`, `stability` and `versions` have in common: which engines, how, and where
/// results go.
struct GridArguments {
  std::vector<std::string> files;
  EngineGrid engines;
  RunOptions options;
  std::string directory, json;
  bool quiet = false;
};

/// Whether the engines of a command are named by an option, or it knows them.
enum class GridEngines { option, given };

/// Adds their options to a command.
void add_grid_options(CLI::App& command, GridArguments& arguments,
                      GridEngines engines = GridEngines::option);

/// Refuses what cannot be written in the end, before anything runs, and completes the options.
/// Profiles that are paths are taken from the working directory. Throws BadOption.
void complete(GridArguments& arguments);

}  // namespace slipcheck
