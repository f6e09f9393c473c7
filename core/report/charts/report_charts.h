#pragma once

#include <vector>

#include "report/charts/chart.h"
#include "report/charts/scene_charts.h"
#include "report/rows/report_content.h"

namespace slipcheck {

/// Every chart of a report, in the order of the page, where the catalogue is a table; their names
/// are distinct.
struct ReportCharts {
  std::vector<Chart> engines;                  ///< over all scenes, one or none
  std::vector<std::vector<Chart>> motions;     ///< of each scene one or none
  std::vector<std::vector<Chart>> scenes;      ///< of each scene the others
  std::vector<std::vector<Chart>> precision;   ///< of each scene, one for each quantity
  std::vector<Chart> catalogue, limits, maps;  ///< by limit_groups() and complete_maps()

  std::vector<Chart> all() const;
};
ReportCharts report_charts(const ReportContent& content, ChartExtent extent);

}  // namespace slipcheck
