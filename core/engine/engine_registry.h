#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/worker_command.h"

namespace slipcheck {

/// A worker as found on disk.
struct EngineExecutable {
  std::string engine;     ///< "bullet"; of one that is there in versions with it, "rapier@0.19.3"
  std::string precision;  ///< "single" or "double"
  WorkerCommand command;
  std::filesystem::path profiles = {};              ///< the folder of those shipped with it
  std::vector<std::filesystem::path> made_of = {};  ///< files whose bytes tell it from another
};

/// An engine that the project has an adapter for, whether built here or not.
struct KnownEngine {
  std::string name;  ///< "bullet"
  std::string from;  ///< what it takes: "Debian package libbullet-dev"
};

/// Those of packages and those that npm brings, sorted by name.
std::vector<KnownEngine> known_engines();
/// Every engine that the project or this machine knows of, sorted, without versions.
std::vector<std::string> engine_names();
/// "rapier@0.19.3 (single) is not installed: slipcheck engines add rapier@0.19.3"; of no precision
/// where that is left out.
std::string not_installed_text(const std::string& engine, const std::string& precision = {});

/// "rapier" of "rapier@0.19.3", "bullet" of "bullet".
std::string engine_family(std::string_view engine);
/// "0.19.3" of "rapier@0.19.3", empty of "bullet".
std::string engine_version(std::string_view engine);
/// Whether one version comes before another: number by number, 0.9 before 0.11, and what comes
/// after a hyphen before what has none.
bool is_older_version(std::string_view one, std::string_view other);

/// Where executables are looked for, first match first: the directories of the environment variable
/// SLIPCHECK_ENGINE_PATH (separated by colons), the running program's own, and ../libexec/slipcheck
/// from there.
std::vector<std::filesystem::path> engine_directories();

/// Every executable `slipcheck-engine-<engine>-<precision>` in these directories, sorted by engine
/// and precision; of two with the same name the first directory's.
std::vector<EngineExecutable> find_engines(const std::vector<std::filesystem::path>& directories);
/// Those of engine_directories(), and those that npm has brought (npm_engines.h).
std::vector<EngineExecutable> find_engines();

/// The one of these for an engine and a precision, if it is there: of an engine without a version
/// the newest.
std::optional<EngineExecutable> find_engine(const std::string& engine, const std::string& precision,
                                            std::span<const EngineExecutable> installed);
std::optional<EngineExecutable> find_engine(const std::string& engine,
                                            const std::string& precision);
/// Where it is left open, the precision that the engine has, of both the double one.
std::string usual_precision(const std::string& engine);

}  // namespace slipcheck
