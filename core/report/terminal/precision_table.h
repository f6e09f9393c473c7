#pragma once

#include <string>
#include <vector>

#include "report/terminal/table_style.h"
#include "studies/precision/precision.h"

namespace slipcheck {

/// Error against run time for the terminal: of each scene and quantity a line for each method with
/// its worst error from the coarsest to the finest setting, how that falls, and what it costs; then
/// how the methods do over all scenes. With style.all_observables all quantities and all curves.
std::string precision_table(const std::vector<PrecisionScene>& scenes, const TableStyle& style);

}  // namespace slipcheck
