#pragma once

#include <filesystem>
#include <vector>

#include "report/charts/gnuplot_script.h"
#include "report/rows/report_content.h"

namespace slipcheck {

/// Of each scene the phases of every observable with a tolerance, slip, speed and energy over time
/// where motion was recorded, and the series of a box; work-precision diagrams; limits and maps.
std::vector<GnuplotChart> gnuplot_charts(const ReportContent& content);

/// Draws all of them into a folder, which is made: for each a script, its data and the SVG. Throws
/// std::runtime_error, before anything is written, where gnuplot is missing or fails, and
/// WriteFailure.
void write_gnuplot_charts(const std::filesystem::path& folder, const ReportContent& content);

}  // namespace slipcheck
