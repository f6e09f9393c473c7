#pragma once

#include <set>
#include <string>
#include <vector>

#include "report/charts/gnuplot_script.h"
#include "studies/precision/precision.h"
#include "studies/stability/limits.h"

namespace slipcheck {

/// Adds "precision-<scene>-<quantity>", worst error against CPU time, and
/// "step-<scene>-<quantity>", against the step, for each quantity that is drawn
/// (precision_charts.h). `taken` as in file_stem.h.
void add_precision_charts(const PrecisionScene& scene, std::set<std::string>& taken,
                          std::vector<GnuplotChart>& charts);

/// Adds "limit-<kind>-<scene>" for each group of limits and "map-<name>" for each complete map.
void add_stability_charts(const LimitResults& limits, std::set<std::string>& taken,
                          std::vector<GnuplotChart>& charts);

}  // namespace slipcheck
