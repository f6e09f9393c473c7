#pragma once

#include <string>
#include <vector>

#include "report/charts/report_charts.h"
#include "report/html/html_charts.h"
#include "studies/precision/precision.h"

namespace slipcheck {

/// Error against run time: how methods do over all scenes, then of each scene a place for charts
/// and how each method's errors fall. Nothing without scenes.
std::string html_precision(const std::vector<PrecisionScene>& scenes, const ReportCharts& charts,
                           const StandingCharts& standing);

}  // namespace slipcheck
