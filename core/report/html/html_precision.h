#pragma once

#include <string>
#include <vector>

#include "studies/precision/precision.h"

namespace slipcheck {

/// Error against run time: how methods do over all scenes, then of each scene a place for charts
/// and how each method's errors fall. Nothing without scenes.
std::string html_precision(const std::vector<PrecisionScene>& scenes);

}  // namespace slipcheck
