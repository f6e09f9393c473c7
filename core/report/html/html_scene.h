#pragma once

#include <cstddef>
#include <string>

#include "harness/compare/record.h"
#include "report/html/html_engines.h"

namespace slipcheck {

/// A verdict as a label with its symbol.
std::string verdict_label(const SceneRecord& scene);

/// Section of the k-th scene: what it is, what of the reference it leaves out, the reference's
/// values, a place for its charts, `charts` (html_charts.h), and each run.
std::string html_scene(const SceneRecord& scene, std::size_t k, const SharedSettings& shared,
                       const std::string& charts);

}  // namespace slipcheck
