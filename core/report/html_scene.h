#pragma once

#include <string>

#include "harness/record.h"

namespace slipcheck {

/// A verdict as a label with its symbol.
std::string verdict_label(const SceneRecord& scene);

/// Its class on the page and in the filter: "within", "deviates", "failed".
std::string verdict_class(const SceneRecord& scene);

/// A scene's section of the page: what it is, the reference, charts, and a table for each run.
std::string html_scene(const SceneRecord& scene, const std::string& id);

}  // namespace slipcheck
