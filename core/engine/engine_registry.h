#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace slipcheck {

/// A worker's executable as found on disk.
struct EngineExecutable {
  std::string engine;     ///< "bullet"
  std::string precision;  ///< "single" or "double"
  std::filesystem::path path;
};

/// The engines that the project has an adapter for, sorted, whether built here or not.
const std::vector<std::string>& known_engines();

/// Where executables are looked for, first match first: the directories of the environment variable
/// SLIPCHECK_ENGINE_PATH (separated by colons), the running program's own, and ../libexec/slipcheck
/// from there.
std::vector<std::filesystem::path> engine_directories();

/// Every executable slipcheck-engine-<engine>-<precision> in these directories, sorted by engine
/// and precision; of two with the same name the first directory's.
std::vector<EngineExecutable> find_engines(
    const std::vector<std::filesystem::path>& directories = engine_directories());

/// The one for an engine and a precision, if it is there.
std::optional<EngineExecutable> find_engine(
    const std::string& engine, const std::string& precision,
    const std::vector<std::filesystem::path>& directories = engine_directories());

}  // namespace slipcheck
