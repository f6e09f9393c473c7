#include "engine/engine_registry.h"

#include <unistd.h>

#include <cstdlib>
#include <map>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

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

bool is_executable(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0;
}

}  // namespace

const std::vector<std::string>& known_engines() {
  static const std::vector<std::string> names = {
      "bullet",
  };
  return names;
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

std::vector<EngineExecutable> find_engines(const std::vector<fs::path>& directories) {
  std::map<std::pair<std::string, std::string>, fs::path> found;
  for (const fs::path& directory : directories) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(directory, error)) {
      const auto name = parse_name(entry.path().filename().string());
      if (name && is_executable(entry.path())) found.emplace(*name, entry.path());
    }
  }
  std::vector<EngineExecutable> engines;
  for (const auto& [name, path] : found) engines.push_back({name.first, name.second, path});
  return engines;
}

std::optional<EngineExecutable> find_engine(const std::string& engine, const std::string& precision,
                                            const std::vector<fs::path>& directories) {
  for (EngineExecutable& each : find_engines(directories)) {
    if (each.engine == engine && each.precision == precision) return std::move(each);
  }
  return std::nullopt;
}

}  // namespace slipcheck
