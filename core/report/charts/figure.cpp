#include "report/charts/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "report/charts/plot_text.h"
#include "report/charts/svg_image.h"
#include "report/rows/outcome_look.h"

namespace slipcheck {
namespace {

// All in px at an image width of 760.
constexpr double kWidth = 760;
constexpr double kLeft = 68, kRight = 14, kTop = 30, kBottom = 50;  // around the plot in a panel
constexpr double kPlotHeight = 220;
constexpr double kSampleWidth = 34, kLegendLine = 20, kLegendFont = 12.5;

struct LegendEntry {
  std::string label;
  Look look;
  std::optional<Outcome> outcome = std::nullopt;  ///< a cell of a map in place of a curve
};

/// The outcomes of all maps from good to bad, and the lines in them.
void add_maps(std::vector<LegendEntry>& entries, const FigureDrawing& drawing) {
  std::set<Outcome> outcomes;
  std::set<std::string> lines;
  for (const Panel& panel : drawing.panels)
    if (const auto* map = std::get_if<CategoryMap>(&panel)) {
      outcomes.insert(map->cells.begin(), map->cells.end());
      if (!map->line.empty()) lines.insert(map->line_label);
    }
  for (const Outcome outcome : outcomes) entries.push_back({name_of(outcome), {}, outcome});
  for (const std::string& line : lines) entries.push_back({line, {Ink::black, Line::dashed}});
}

std::vector<LegendEntry> legend_of(const FigureDrawing& drawing) {
  std::vector<LegendEntry> entries;
  for (const Panel& panel : drawing.panels)
    if (const auto* chart = std::get_if<LineChart>(&panel))
      for (const Curve& curve : chart->curves)
        if (!curve.label.empty() &&
            std::none_of(entries.begin(), entries.end(),
                         [&](const LegendEntry& e) { return e.label == curve.label; }))
          entries.push_back({curve.label, curve.look});
  add_maps(entries, drawing);
  return entries;
}

/// The legend in as many equal columns as fit; adds its height to `y`.
std::string legend_svg(const std::vector<LegendEntry>& entries, double& y) {
  if (entries.empty()) return {};
  double widest = 0;
  for (const LegendEntry& entry : entries)
    widest = std::max(widest, kSampleWidth + 28 + kLegendFont * plot_text_width(entry.label));
  const auto fit = static_cast<std::size_t>(std::max(1.0, (kWidth - kLeft) / widest));
  const std::size_t columns = std::min(fit, entries.size());
  const std::size_t rows = (entries.size() + columns - 1) / columns;
  const double left = std::max(10.0, (kWidth - static_cast<double>(columns) * widest) / 2);
  std::string svg = fmt::format("<g font-size=\"{}\">\n", kLegendFont);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const std::size_t column = k / rows;
    const double x = left + static_cast<double>(column) * widest;
    const double line = y + kLegendLine * (static_cast<double>(k % rows) + 0.5);
    svg += entries[k].outcome ? outcome_cell_svg(*entries[k].outcome, {x + 8, line - 8, 18, 16}, "")
                              : legend_sample(entries[k].look, x, line, kSampleWidth);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x + kSampleWidth + 8,
                       line + 4, plot_text(entries[k].label));
  }
  y += kLegendLine * static_cast<double>(rows);
  return svg + "</g>\n";
}

}  // namespace

std::string figure_svg(const FigureDrawing& drawing, const std::string& name,
                       const std::string& title, const std::string& description) {
  const double panel_width = kWidth / drawing.columns;
  const double panel_height = kTop + kPlotHeight + kBottom;
  std::string body;
  for (std::size_t k = 0; k < drawing.panels.size(); ++k) {
    const auto column = static_cast<int>(k) % drawing.columns;
    const auto row = static_cast<int>(k) / drawing.columns;
    PlotFrame frame{column * panel_width + kLeft, row * panel_height + kTop,
                    panel_width - kLeft - kRight, kPlotHeight};
    if (const auto* chart = std::get_if<LineChart>(&drawing.panels[k])) {
      body += line_chart_svg(*chart, frame, fmt::format("{}-plot-{}", name, k + 1));
    } else if (const auto* map = std::get_if<CategoryMap>(&drawing.panels[k])) {
      body += category_map_svg(*map, frame, fmt::format("{}-plot-{}", name, k + 1));
    } else {
      frame.width -= kColourBarWidth - kRight;
      body += heat_map_svg(std::get<HeatMap>(drawing.panels[k]), frame);
    }
  }
  const auto panels = static_cast<int>(drawing.panels.size());
  const int rows = (panels + drawing.columns - 1) / drawing.columns;
  double height = rows * panel_height;
  body += legend_svg(legend_of(drawing), height);
  height += 8;
  return svg_image(kWidth, height, name, title, description, body);
}

}  // namespace slipcheck
