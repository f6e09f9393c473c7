#pragma once

#include <string>
#include <vector>

#include "report/html/page_scenes.h"
#include "report/rows/engine_matrix.h"

namespace slipcheck {

/// All scenes by topic, with their verdicts and by engine, profile and rate the worst phase's error
/// in tolerances: what the page is found through. `matrix` has all methods. Nothing without scenes.
std::string html_index(const std::vector<PageTopic>& topics, const EngineMatrix& matrix);

/// A verdict as a label with its symbol.
std::string verdict_label(const SceneRecord& scene);

}  // namespace slipcheck
