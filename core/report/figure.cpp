#include "report/figure.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/html_text.h"
#include "report/plot_text.h"

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
};

std::vector<LegendEntry> legend_of(const FigureDrawing& drawing) {
  std::vector<LegendEntry> entries;
  for (const Panel& panel : drawing.panels)
    if (const auto* chart = std::get_if<LineChart>(&panel))
      for (const Curve& curve : chart->curves)
        if (!curve.label.empty() &&
            std::none_of(entries.begin(), entries.end(),
                         [&](const LegendEntry& e) { return e.label == curve.label; }))
          entries.push_back({curve.label, curve.look});
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
    svg += legend_sample(entries[k].look, x, line, kSampleWidth);
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
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" "
             "width=\"{0:g}\" height=\"{1:g}\" role=\"img\" aria-labelledby=\"{2}-title\" "
             "font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" font-size=\"12\" "
             "fill=\"#1b1b1b\">\n<title id=\"{2}-title\">{3}</title>\n<desc>{4}</desc>\n"
             "<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"#ffffff\"/>\n",
             kWidth, height, escaped(name), escaped(plain_plot_text(title)),
             escaped(plain_plot_text(description))) +
         body + "</svg>\n";
}

}  // namespace slipcheck
