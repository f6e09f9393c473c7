#include "engine/engine_registry.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/folder.h"
#include "engine/npm_engines.h"

namespace slipcheck {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPrefix = "slipcheck-engine-";

/// Engine and precision of an executable's name, if it is one of ours. The engine's name may hold
/// hyphens, the precision's does not.
std::optional<std::pair<std::string, std::string>> parse_name(const std::string& name) {
  if (!name.starts_with(kPrefix)) return std::nullopt;
  const std::size_t hyphen = name.rfind('-');
  if (hyphen <= kPrefix.size()) return std::nullopt;
  const std::string precision = name.substr(hyphen + 1);
  if (precision != "single" && precision != "double") return std::nullopt;
  return std::pair(name.substr(kPrefix.size(), hyphen - kPrefix.size()), precision);
}

/// "0.8.0-alpha.2": numbers, and what follows a hyphen.
struct VersionParts {
  std::vector<unsigned long> numbers;
  std::string_view suffix;
};

VersionParts parts_of(std::string_view version) {
  VersionParts parts;
  const std::size_t hyphen = version.find('-');
  if (hyphen != std::string_view::npos) parts.suffix = version.substr(hyphen + 1);
  std::istringstream numbers{std::string(version.substr(0, hyphen))};
  for (std::string number; std::getline(numbers, number, '.');)
    parts.numbers.push_back(std::strtoul(number.c_str(), nullptr, 10));
  return parts;
}

bool is_executable(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0;
}

}  // namespace

std::vector<KnownEngine> known_engines() {
  std::vector<KnownEngine> engines = {
      {"bullet", "Debian package libbullet-dev"},
      {"dart", "Debian package libdart-dev"},
      {"lammps", "Debian package lammps"},
      {"mujoco", "Debian package libmujoco-dev"},
      {"ode", "Debian package libode-dev"},
      {"siconos", "Debian package libsiconos-kernel-dev"},
      {"simbody", "Debian package libsimbody-dev"},
  };
  for (const NpmEngine& engine : npm_engines()) {
    const std::string command = "slipcheck engines add " + engine.name;
    const auto known = std::ranges::find(engines, engine.name, &KnownEngine::name);
    if (known == engines.end())
      engines.push_back({engine.name, command});
    else
      known->from += ", or " + command;
  }
  std::ranges::sort(engines, {}, &KnownEngine::name);
  return engines;
}

std::vector<std::string> engine_names() {
  std::set<std::string> names;
  for (const KnownEngine& known : known_engines()) names.insert(known.name);
  for (const EngineExecutable& found : find_engines()) names.insert(engine_family(found.engine));
  return {names.begin(), names.end()};
}

std::string not_installed_text(const std::string& engine, const std::string& precision) {
  std::string text =
      engine + (precision.empty() ? "" : " (" + precision + ")") + " is not installed";
  const std::string other = precision == "single" ? "double" : "single";
  if ((precision == "single" || precision == "double") && find_engine(engine, other))
    return text + ", but " + other + " precision is";
  const std::vector<KnownEngine> engines = known_engines();
  const auto known = std::ranges::find(engines, engine_family(engine), &KnownEngine::name);
  if (known == engines.end()) return text;
  const std::string version = engine_version(engine);
  return text + ": " +
         (version.empty() ? known->from : "slipcheck engines add " + engine + " may have it");
}

std::vector<fs::path> engine_directories() {
  std::vector<fs::path> directories;
  if (const char* path = std::getenv("SLIPCHECK_ENGINE_PATH")) {
    std::istringstream stream(path);
    for (std::string directory; std::getline(stream, directory, ':');) {
      if (!directory.empty()) directories.emplace_back(directory);
    }
  }
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    directories.push_back(program.parent_path());
    directories.push_back(program.parent_path().parent_path() / "libexec" / "slipcheck");
  }
  return directories;
}

std::string engine_family(std::string_view engine) {
  return std::string(engine.substr(0, engine.find('@')));
}

std::string engine_version(std::string_view engine) {
  const std::size_t at = engine.find('@');
  return at == std::string_view::npos ? "" : std::string(engine.substr(at + 1));
}

bool is_older_version(std::string_view one, std::string_view other) {
  const VersionParts a = parts_of(one), b = parts_of(other);
  if (a.numbers != b.numbers) return a.numbers < b.numbers;
  if (a.suffix.empty() != b.suffix.empty()) return b.suffix.empty();
  return a.suffix < b.suffix;
}

std::vector<EngineExecutable> find_engines(const std::vector<fs::path>& directories) {
  std::map<std::pair<std::string, std::string>, fs::path> found;
  for (const fs::path& directory : directories) {
    std::error_code ignored;
    for (const fs::path& file : entries_of(directory, ignored)) {
      const auto name = parse_name(file.filename().string());
      if (name && is_executable(file)) found.emplace(*name, file);
    }
  }
  std::vector<EngineExecutable> engines;
  for (const auto& [name, path] : found) {
    const auto& [engine, precision] = name;
    const fs::path profiles = path.parent_path() / "profiles" / engine_family(engine);
    engines.push_back({engine, precision, path, profiles, {path}});
  }
  return engines;
}

std::vector<EngineExecutable> find_engines() {
  std::vector<EngineExecutable> engines = find_engines(engine_directories());
  const auto name_of = [](const EngineExecutable& each) {
    return std::pair(each.engine, each.precision);
  };
  for (EngineExecutable& brought : installed_npm_engines())
    if (std::ranges::find(engines, name_of(brought), name_of) == engines.end())
      engines.push_back(std::move(brought));
  std::ranges::sort(engines, [&](const EngineExecutable& one, const EngineExecutable& other) {
    const std::string family = engine_family(one.engine), of_other = engine_family(other.engine);
    if (family != of_other) return family < of_other;
    if (one.engine != other.engine)
      return is_older_version(engine_version(one.engine), engine_version(other.engine));
    return one.precision < other.precision;
  });
  return engines;
}

std::optional<EngineExecutable> find_engine(const std::string& engine, const std::string& precision,
                                            std::span<const EngineExecutable> installed) {
  const EngineExecutable* found = nullptr;
  for (const EngineExecutable& each : installed) {
    if (each.precision != precision) continue;
    if (each.engine == engine) return each;
    if (engine_family(each.engine) == engine &&
        (!found || is_older_version(engine_version(found->engine), engine_version(each.engine))))
      found = &each;
  }
  return found ? std::optional(*found) : std::nullopt;
}

std::optional<EngineExecutable> find_engine(const std::string& engine,
                                            const std::string& precision) {
  return find_engine(engine, precision, find_engines());
}

std::string usual_precision(const std::string& engine) {
  const bool has_single_alone = !find_engine(engine, "double") && find_engine(engine, "single");
  return has_single_alone ? "single" : "double";
}

}  // namespace slipcheck
