#include "app/bundled_scenes.h"

#include <algorithm>

#include "base/folder.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

fs::path scenario_directory() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const fs::path& directory :
       {program / "scenarios", program.parent_path() / "share/slipcheck/scenarios"})
    if (fs::is_directory(directory, ignored)) return directory;
  return SLIPCHECK_SCENARIO_DIR;
}

}  // namespace

std::vector<fs::path> bundled_scenes(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const fs::path& file : entries_of(scenario_directory() / folder, ignored))
    if (file.extension() == ".yaml") files.push_back(file);
  return files;
}

fs::path bundled_baselines() { return scenario_directory().parent_path() / "results/baselines"; }

}  // namespace slipcheck
