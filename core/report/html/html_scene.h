#pragma once

#include <string>

#include "harness/compare/record.h"
#include "report/html/html_engines.h"
#include "report/html/page_scenes.h"

namespace slipcheck {

/// Section of a scene, folded: its finding in a sentence, what it is, what of the reference it
/// leaves out, the reference's values, a place for its charts, `charts` (html_charts.h), and
/// `runs`: each run, or what stands in their place.
std::string html_scene(const PageScene& each, const SharedSettings& shared,
                       const std::string& charts, const std::string& runs);

/// Every run of a scene with all its tables.
std::string html_runs(const SceneRecord& scene, const SharedSettings& shared);

/// The runs in a table, a row for each, for readers without the script that brings html_runs().
std::string html_run_list(const SceneRecord& scene);

}  // namespace slipcheck
