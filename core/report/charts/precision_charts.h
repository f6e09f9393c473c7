#pragma once

#include <map>
#include <string>
#include <vector>

#include "report/charts/figure.h"
#include "report/html/figure_page.h"
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

/// Of one quantity the work-precision diagram (worst error against CPU time, both logarithmic, with
/// rings around what no other method beats) and beside it the worst error against the step, where
/// it shows what converges. Of methods without a step, those over a tolerance, only the former.
std::vector<Panel> precision_panels(const PrecisionScene& scene, const std::string& quantity,
                                    const std::map<std::string, Look>& looks);

/// A figure for each scene, "precision-<scene>"; names fit for files.
std::vector<FigureOnPage> precision_charts(const std::vector<PrecisionScene>& scenes);

}  // namespace slipcheck
