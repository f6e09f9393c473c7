#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "report/rows/report_content.h"

namespace slipcheck {

/// What the page's script draws, as "slipcheck-page/1": phases, series in a box and motion of each
/// scene, error against run time, maps and limits. All values SI, rounded as drawings need them.
nlohmann::json page_data(const ReportContent& content);

/// The same compressed and in base64, as it stands on the page.
std::string packed_page_data(const ReportContent& content);

}  // namespace slipcheck
