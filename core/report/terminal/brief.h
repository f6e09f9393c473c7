#pragma once

#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "report/terminal/table_style.h"

namespace slipcheck {

/// One line for each scene: its verdict, how many of its runs are within tolerance, and the worst
/// deviation.
std::string brief_of(const std::vector<SceneRecord>& scenes, const TableStyle& style);

}  // namespace slipcheck
