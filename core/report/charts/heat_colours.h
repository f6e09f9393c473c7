#pragma once

#include <string>

namespace slipcheck {

// Colours of a quantity, from vermilion over white to blue in 64 levels: dark at both ends, so that
// lightness alone tells how far from the middle a value is.

/// The level of a share of the range in [0, 1]; what is beyond has that of the end.
int heat_level(double share);
/// The middle of a level's share.
double heat_share(int level);
/// The colours as gnuplot's palette, "0 '#a03c00', …"; the other way round for errors.
std::string heat_palette(bool low_is_blue);

}  // namespace slipcheck
