#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "report/charts/chart.h"
#include "studies/precision/precision.h"

namespace slipcheck {

/// Errors that are smaller, and zero, are drawn here.
inline constexpr double kErrorFloor = 1e-17;

/// The look of each method, the same in all charts: a colour and a marker for an engine's profile,
/// full lines in double and dashed ones in single precision; black for the reference's solvers.
std::map<std::string, Look> method_looks(const std::vector<PrecisionScene>& scenes);

/// The quantities that are drawn: the first two that are judged and are not each other's twins, and
/// the trajectory.
std::vector<std::string> drawn_quantities(const PrecisionScene& scene);

/// "precision-<scene>-<quantity>" for each quantity that is drawn: the work-precision diagram
/// (worst error against CPU time, both logarithmic, with rings around what no other method beats)
/// and beside it the worst error against the step, where it shows what converges. Of methods
/// without a step, those over a tolerance, only the former. `taken` as in file_stem.h.
std::vector<Chart> precision_charts(const PrecisionScene& scene,
                                    const std::map<std::string, Look>& looks,
                                    std::set<std::string>& taken);

}  // namespace slipcheck
