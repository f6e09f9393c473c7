#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "studies/baseline/baseline.h"

namespace slipcheck {

/// What a new set of baselines changes in a folder. Nothing is written here.
struct BaselineUpdate {
  std::map<std::filesystem::path, std::string> files;  ///< to be written, with their text
  std::vector<std::filesystem::path> left_over;        ///< to be removed: their scenes are gone
  std::vector<std::string> added, changed, removed;    ///< scenes
  std::size_t unchanged = 0;                           ///< baselines

  bool empty() const { return files.empty() && left_over.empty(); }
};

/// The baselines of a folder by scene; empty for a folder that is not there. With `scenes` theirs
/// alone. Throws BadJson.
std::map<std::string, SceneBaseline> load_baselines(const std::filesystem::path& folder,
                                                    const std::vector<std::string>& scenes = {});

/// Replaces `old` by `now`. A baseline that differs in nothing but CPU times and the version of
/// slipcheck stays as it is. `all`: a scene that is not in `now` is gone.
BaselineUpdate update_of(const std::filesystem::path& folder,
                         const std::map<std::string, SceneBaseline>& old,
                         const std::vector<SceneBaseline>& now, bool all);

}  // namespace slipcheck
