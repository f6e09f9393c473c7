#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "harness/run/engine_grid.h"
#include "harness/run/scene_run.h"

namespace slipcheck {

/// What `precision` and `stability` have in common: which engines, how, and where results go.
struct GridArguments {
  std::vector<std::string> files;
  EngineGrid engines;
  RunOptions options;
  std::size_t memory_limit = 2048;  // [MiB]
  std::string directory, json;
  bool quiet = false;
};

/// Adds their options to a command.
void add_grid_options(CLI::App& command, GridArguments& arguments);

/// Refuses what cannot be written in the end, before anything runs, and completes the options.
/// Profiles that are paths are taken from the working directory. Throws BadOption.
void complete(GridArguments& arguments);

}  // namespace slipcheck
