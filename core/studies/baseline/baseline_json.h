#pragma once

#include <filesystem>
#include <string>

#include "base/json_node.h"
#include "studies/baseline/baseline.h"

namespace slipcheck {

/// The baseline as a file of "slipcheck-baseline/1": JSON with a line for each observable, so that
/// a difference of two is readable, and numbers that read back as the very same.
std::string baseline_text(const SceneBaseline& baseline);

/// Reads such a file's text; `file` names it in messages. Throws BadJson.
SceneBaseline parse_baseline(const std::string& text, const std::string& file);

/// The file of a scene's baseline in a folder.
std::filesystem::path baseline_file(const std::filesystem::path& folder, const std::string& scene);

}  // namespace slipcheck
