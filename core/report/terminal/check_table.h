#pragma once

#include <string>

#include "report/rows/check_rows.h"
#include "report/terminal/table_style.h"

namespace slipcheck {

/// A check for people on a terminal: what has moved, scene by scene, and a summary. With
/// `all_observables` every change, else the most severe of each run.
std::string check_table(const CheckReport& report, const TableStyle& style);

}  // namespace slipcheck
