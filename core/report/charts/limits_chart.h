#pragma once

#include <string>

#include "report/rows/stability_rows.h"

namespace slipcheck {

/// Limits of one kind on one scene as bars over the range that was searched: blue where it works,
/// in the colour of what happens beyond; a line where theory puts the limit. SVG; `name` makes its
/// ids unique.
std::string limits_svg(const LimitGroup& group, const std::string& name);

}  // namespace slipcheck
