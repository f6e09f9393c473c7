#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "report/charts/report_charts.h"
#include "report/rows/report_content.h"

namespace slipcheck {

/// What the page's script draws, as "slipcheck-page/3": charts (page_chart.h) and the motion of
/// each scene [SI], which the script draws over time and plays back; of each run its verdict and
/// worst deviation, and its tables as HTML. `charts` are those of the
/// content.
nlohmann::json page_data(const ReportContent& content, const ReportCharts& charts);

/// The same compressed and in base64, as it stands on the page.
std::string packed_page_data(const ReportContent& content, const ReportCharts& charts);

}  // namespace slipcheck
