#pragma once

#include <string>

#include "report/charts/report_charts.h"
#include "report/html/html_charts.h"
#include "report/rows/report_content.h"

namespace slipcheck {

/// Style of the cells of maps, in the colours of what they tell.
std::string outcome_css();

/// Where it gets stiff: the classes with their criteria, the catalogue as a map, of each case all
/// runs with the reasons, limits and maps. Nothing without cases, limits and maps.
std::string html_stability(const ReportContent& content, const ReportCharts& charts,
                           const StandingCharts& standing);

}  // namespace slipcheck
