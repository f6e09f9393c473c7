#pragma once

#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "report/terminal/table_style.h"

namespace slipcheck {

/// One scene for people on a terminal: the reference, then each engine's run beside it.
std::string table_of(const SceneRecord& scene, const TableStyle& style);

/// One line over all scenes.
std::string summary_of(const std::vector<SceneRecord>& scenes, const TableStyle& style);

}  // namespace slipcheck
