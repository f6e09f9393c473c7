#pragma once

#include <string>
#include <variant>
#include <vector>

#include "report/charts/category_map.h"
#include "report/charts/heat_map.h"
#include "report/charts/line_chart.h"

namespace slipcheck {

using Panel = std::variant<LineChart, HeatMap, CategoryMap>;

/// Panels side by side with one legend below them.
struct FigureDrawing {
  std::vector<Panel> panels;
  int columns = 2;
};

/// One image in SVG: static, complete in itself, on a light ground, fit for a paper and for a page
/// (no XML declaration). `name` makes its ids unique on a page; title and description are what a
/// screen reader says of it.
std::string figure_svg(const FigureDrawing& drawing, const std::string& name,
                       const std::string& title, const std::string& description);

}  // namespace slipcheck
