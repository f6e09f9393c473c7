#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace slipcheck {

/// The bundled scenes' files, sorted by path: beside the program, in its share folder, or in the
/// source tree. `folder`: a folder below that one, "extreme"; the scenes in it alone.
std::vector<std::filesystem::path> bundled_scenes(const std::filesystem::path& folder = {});

/// The folder of the bundled scenes' baselines: results/baselines beside that of the scenes.
std::filesystem::path bundled_baselines();

}  // namespace slipcheck
