#pragma once

#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "report/charts/report_charts.h"
#include "report/html/html_charts.h"

namespace slipcheck {

/// Engines beside each other over all scenes: what that comes to, a score for each with its cost,
/// and error against run time. Nothing without two scenes and two methods.
std::string html_matrix(const std::vector<SceneRecord>& scenes, const ReportCharts& charts,
                        const StandingCharts& standing);

}  // namespace slipcheck
