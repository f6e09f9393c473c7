#pragma once

#include <string>
#include <vector>

#include "report/charts/line_chart.h"
#include "report/charts/plot_axis.h"

namespace slipcheck {

/// A quantity over two others on a grid, as colours.
struct HeatMap {
  std::string title;
  AxisSpec x, y;                 ///< their ranges are those of the grid
  std::vector<double> x_values;  ///< centres of the cells, rising, equally far apart on the axis
  std::vector<double> y_values;
  std::vector<double> z;  ///< at y_values[r] and x_values[c]: z[r * x_values.size() + c]
  std::string z_label;
  double z_low = -1, z_high = 1;  ///< at the ends of the colours; what is beyond has theirs
  bool low_is_blue = false;       ///< the colours the other way round, for errors
  std::string missing = {};       ///< stands in cells that are NaN, at most two columns wide
};

/// The axis that a grid's cells fill; its range is theirs.
PlotAxis grid_axis(AxisSpec spec, const std::vector<double>& centres);

/// The colour for a share of the range in [0, 1], "#0072b2": vermilion over white to blue.
std::string heat_colour(double share);

/// The whole map with its bar of colours at the right; SVG.
std::string heat_map_svg(const HeatMap& map, const PlotFrame& frame);

/// What the bar takes beside the frame [px].
inline constexpr double kColourBarWidth = 62;

}  // namespace slipcheck
