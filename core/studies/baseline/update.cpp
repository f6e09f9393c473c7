#include "studies/baseline/update.h"

#include <algorithm>

#include "base/folder.h"
#include "base/regular_file.h"
#include "studies/baseline/baseline_json.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

SceneBaseline load_baseline(const fs::path& file) {
  try {
    return parse_baseline(read_regular_file(file, kBaselineFileLimit), file.string());
  } catch (const UnreadFile& bad) {
    throw BadJson(file.string() + ": " + bad.what());
  }
}

/// What does not make a baseline another one.
void take_circumstances(const SceneBaseline& old, SceneBaseline& now) {
  now.slipcheck = old.slipcheck;
  now.cpu_seconds = old.cpu_seconds;
  for (std::size_t k = 0; k < std::min(old.runs.size(), now.runs.size()); ++k)
    now.runs[k].cpu_seconds = old.runs[k].cpu_seconds;
}

bool are_same(const SceneBaseline& old, SceneBaseline now) {
  take_circumstances(old, now);
  return baseline_text(old) == baseline_text(now);
}

}  // namespace

std::map<std::string, SceneBaseline> load_baselines(const fs::path& folder,
                                                    const std::vector<std::string>& scenes) {
  std::map<std::string, SceneBaseline> baselines;
  std::error_code ignored;
  for (const std::string& scene : scenes)
    if (const fs::path file = baseline_file(folder, scene); fs::exists(file, ignored))
      baselines.emplace(scene, load_baseline(file));
  if (!scenes.empty()) return baselines;
  for (const fs::path& file : entries_of(folder, ignored))
    if (file.extension() == ".json") baselines.emplace(file.stem().string(), load_baseline(file));
  return baselines;
}

BaselineUpdate update_of(const fs::path& folder, const std::map<std::string, SceneBaseline>& old,
                         const std::vector<SceneBaseline>& now, bool all) {
  BaselineUpdate update;
  for (const SceneBaseline& baseline : now) {
    const auto before = old.find(baseline.scene);
    if (before != old.end() && are_same(before->second, baseline)) {
      ++update.unchanged;
      continue;
    }
    (before == old.end() ? update.added : update.changed).push_back(baseline.scene);
    update.files[baseline_file(folder, baseline.scene)] = baseline_text(baseline);
  }
  if (!all) return update;
  for (const auto& [scene, baseline] : old)
    if (std::ranges::find(now, scene, &SceneBaseline::scene) == now.end()) {
      update.removed.push_back(scene);
      update.left_over.push_back(baseline_file(folder, scene));
    }
  return update;
}

}  // namespace slipcheck
