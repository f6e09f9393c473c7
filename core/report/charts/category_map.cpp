#include "report/charts/category_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/charts/heat_map.h"
#include "report/charts/plot_text.h"
#include "report/html/html_text.h"
#include "report/rows/outcome_look.h"

namespace slipcheck {
namespace {

/// The border that theory knows, cut at the frame.
std::string line_svg(const CategoryMap& map, const PlotAxis& x, const PlotAxis& y,
                     const PlotFrame& frame, const std::string& id) {
  std::string path;
  bool pen_down = false;
  for (const auto& [at_x, at_y] : map.line) {
    const double across = x.fraction(at_x), up = y.fraction(at_y);
    const bool shown = std::isfinite(across) && std::isfinite(up);
    // Renderers overflow on coordinates without bounds.
    if (shown)
      path += fmt::format("{}{:.2f} {:.2f}", pen_down ? 'L' : 'M',
                          frame.left + std::clamp(across, -20.0, 20.0) * frame.width,
                          frame.top + (1 - std::clamp(up, -20.0, 20.0)) * frame.height);
    pen_down = shown;
  }
  if (path.empty()) return {};
  // White below black, so that it shows on every colour.
  return fmt::format(
      "<clipPath id=\"{0}\"><rect x=\"{1:.2f}\" y=\"{2:.2f}\" width=\"{3:.2f}\" "
      "height=\"{4:.2f}\"/></clipPath>\n<g clip-path=\"url(#{0})\" fill=\"none\">"
      "<path d=\"{5}\" stroke=\"#ffffff\" stroke-width=\"4.5\"/>"
      "<path d=\"{5}\" stroke=\"#1b1b1b\" stroke-width=\"2\" stroke-dasharray=\"7 4\"/></g>\n",
      id, frame.left, frame.top, frame.width, frame.height, path);
}

}  // namespace

std::string outcome_cell_svg(Outcome outcome, const PlotFrame& cell, const std::string& note) {
  const OutcomeLook& look = look_of(outcome);
  const double size = std::min({11.0, 0.8 * cell.height, 1.1 * cell.width});
  const std::string title = note.empty() ? "" : fmt::format("<title>{}</title>", escaped(note));
  return fmt::format(
      "<g>{}<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" "
      "stroke=\"#ffffff\" stroke-width=\"0.5\"/><text x=\"{:.2f}\" y=\"{:.2f}\" "
      "text-anchor=\"middle\" font-size=\"{:.3g}\" fill=\"{}\">{}</text></g>\n",
      title, cell.left, cell.top, cell.width, cell.height, look.fill, cell.left + cell.width / 2,
      cell.top + cell.height / 2 + 0.36 * size, size, look.ink, look.letter);
}

std::string category_map_svg(const CategoryMap& map, const PlotFrame& frame,
                             const std::string& id) {
  const std::size_t columns = map.x_values.size(), rows = map.y_values.size();
  const double width = frame.width / static_cast<double>(columns);
  const double height = frame.height / static_cast<double>(rows);
  std::string svg;
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t k = r * columns + c;
      const PlotFrame cell{frame.left + width * static_cast<double>(c),
                           frame.top + frame.height - height * static_cast<double>(r + 1), width,
                           height};
      svg += outcome_cell_svg(map.cells[k], cell, map.notes.empty() ? "" : map.notes[k]);
    }
  const PlotAxis x = grid_axis(map.x, map.x_values), y = grid_axis(map.y, map.y_values);
  svg += line_svg(map, x, y, frame, id);
  return svg + axes_svg(map.title, x, y, frame);
}

}  // namespace slipcheck
