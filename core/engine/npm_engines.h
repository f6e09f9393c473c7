#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/engine_registry.h"

namespace slipcheck {

/// An engine that npm brings, in any of several versions: its worker is a program for Node.js
/// beside ours, and each version's packages have a folder of their own.
struct NpmEngine {
  std::string name;           ///< "rapier"
  std::string package;        ///< "@dimforge/rapier3d-compat"
  std::string versions;       ///< on which its adapter was tried, ">=0.11.0 <0.22.0"
  std::string usual_version;  ///< where none is named
  std::string precision;      ///< "single" or "double"
  /// Packages that its worker needs besides, with their versions.
  std::vector<std::pair<std::string, std::string>> also;
  std::size_t node = 0;  ///< the lowest major version of Node.js that starts it
  std::string about;     ///< one line
};

/// Those of catalog.json in npm_worker_folder(), sorted by name; none where there is no such file.
/// Throws BadJson.
std::vector<NpmEngine> npm_engines();

/// What is written once for all of them: main.mjs and what belongs to it.
std::filesystem::path npm_worker_folder();

/// Where engines are installed: SLIPCHECK_ENGINES, or slipcheck/engines in the user's data folder
/// (XDG_DATA_HOME, ~/.local/share). Empty where there is no such folder.
std::filesystem::path engines_folder();

/// The worker of an engine whose packages are in a folder.
EngineExecutable npm_worker(const NpmEngine& engine, const std::string& version,
                            const std::filesystem::path& folder);

/// Those in engines_folder().
std::vector<EngineExecutable> installed_npm_engines();

}  // namespace slipcheck
