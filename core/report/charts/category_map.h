#pragma once

#include <string>
#include <utility>
#include <vector>

#include "report/charts/line_chart.h"
#include "report/charts/plot_axis.h"
#include "studies/stability/outcome.h"

namespace slipcheck {

/// How it comes out over two parameters on a grid, as colours with letters.
struct CategoryMap {
  std::string title;
  AxisSpec x, y;                 ///< their ranges are those of the grid
  std::vector<double> x_values;  ///< centres of the cells, rising, equally far apart on the axis
  std::vector<double> y_values;
  std::vector<Outcome> cells;      ///< at y_values[r] and x_values[c]: [r * x_values.size() + c]
  std::vector<std::string> notes;  ///< what a cell says when pointed at; empty, or of the same size
  std::vector<std::pair<double, double>> line;  ///< (x, y) where theory knows a border
  std::string line_label;                       ///< in the legend, as plot_text.h
};

/// The whole map; SVG. `id` is that of its clip path, unique on a page.
std::string category_map_svg(const CategoryMap& map, const PlotFrame& frame, const std::string& id);

/// One cell with its letter and, where there is one, a note; SVG.
std::string outcome_cell_svg(Outcome outcome, const PlotFrame& cell, const std::string& note);

}  // namespace slipcheck
