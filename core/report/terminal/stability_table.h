#pragma once

#include <string>
#include <vector>

#include "report/terminal/table_style.h"
#include "studies/stability/limits.h"
#include "studies/stability/stability.h"

namespace slipcheck {

/// The catalogue for the terminal: of each case how it comes out in the reference and in each
/// engine, in words or, where there is no room, in short ones or letters with their meaning below;
/// then how many come out how. With style.all_observables also why.
std::string stability_table(const std::vector<StabilityCase>& cases, const TableStyle& style);

/// How far each method works, beside what theory says.
std::string limits_table(const LimitResults& results, const TableStyle& style);

}  // namespace slipcheck
