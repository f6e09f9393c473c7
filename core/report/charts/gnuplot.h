#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/charts/chart.h"

namespace slipcheck {

/// Charts as gnuplot has drawn them.
struct ChartDrawings {
  /// Of each chart, in their order: an image in SVG on a light ground, complete in itself, with ids
  /// that begin with the chart's name, and its title and caption for screen readers; empty where
  /// there is none.
  std::vector<std::string> svgs;
  std::string trouble;  ///< why some are missing, for people; empty where none is
};

/// Draws all in one process of gnuplot; none is started for no charts.
ChartDrawings draw_charts(const std::vector<Chart>& charts);

/// An image of draw_charts() as it stands in a page, which is HTML and XML at once.
std::string inline_svg(const std::string& svg);

/// Writes what was drawn into a folder, which is made: "<name>.svg"; `with_sources`: also what
/// gnuplot made it of, "<name>.gp" and "<name>.dat". Throws WriteFailure.
void write_charts(const std::filesystem::path& folder, const std::vector<Chart>& charts,
                  const ChartDrawings& drawings, bool with_sources);

}  // namespace slipcheck
