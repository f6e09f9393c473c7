#include "report/charts/gnuplot_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "report/charts/plot_text.h"

namespace slipcheck {
namespace {

// [px]
constexpr double kLeft = 70, kRight = 14, kTop = 12, kTitle = 22;  // around a panel's frame
constexpr double kBottom = 28, kAxisLabel = 22, kColourBar = 66;
constexpr double kSlant = 0.87;           // sine of the angle of names on top, 60°
constexpr std::size_t kLongestName = 44;  // columns

std::string shown_name(const std::string& name) {
  return plot_literal(shortened(plain_plot_text(name), kLongestName));
}

double widest_of(const std::vector<std::string>& names) {
  double widest = 0;
  for (const std::string& name : names) widest = std::max(widest, text_pixels(shown_name(name)));
  return widest;
}

/// A tick's text, in which gnuplot expands formats of numbers.
std::string tick_text(const std::string& name) {
  std::string text;
  for (const char c : gnuplot_text(shown_name(name))) text += c == '%' ? "%%" : std::string(1, c);
  return text;
}

}  // namespace

std::string gnuplot_number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "NaN";
}

const char* gnuplot_dash(Line line) {
  switch (line) {
    case Line::dashed:
      return "(7,4)";
    case Line::dotted:
      return "(1.5,3.5)";
    case Line::dash_dot:
      return "(9,3,2,3)";
    case Line::none:
    case Line::solid:
      break;
  }
  return "1";
}

const char* gnuplot_point(Marker marker) {
  switch (marker) {
    case Marker::square:
      return "pt 5 ps 0.5";
    case Marker::triangle:
      return "pt 9 ps 0.6";
    case Marker::diamond:
      return "pt 13 ps 0.6";
    case Marker::ring:
      return "pt 6 ps 1.2 lw 1.5";
    case Marker::circle:
    case Marker::none:
      break;
  }
  return "pt 7 ps 0.5";
}

double text_pixels(std::string_view text) { return kChartFont * plot_text_width(text); }

std::string fitted_text(const std::string& text, double room) {
  const double size = 13.0 / kChartFont;  // these are larger
  if (size * text_pixels(text) <= room) return text;
  return plot_literal(
      shortened(plain_plot_text(text), static_cast<std::size_t>(room / (size * text_pixels("x")))));
}

/// What a panel takes beside its frame.
struct Margins {
  double left = kLeft, right = kRight, top = kTop, bottom = kBottom;
};

PanelMargins panel_margins(const Panel& panel) {
  PanelMargins margins{kLeft, kRight, kTop, kBottom};
  if (!panel.y.names.empty()) margins.left = 20 + widest_of(panel.y.names);
  if (!panel.title.empty()) margins.top += kTitle;
  if (!panel.x.label.empty()) margins.bottom += kAxisLabel;
  if (panel.colours) margins.right = kColourBar;
  if (!panel.x.names.empty()) {
    const double widest = widest_of(panel.x.names);
    margins.top += kSlant * widest;
    margins.right += 0.5 * widest;  // the last leans beyond its column
    margins.bottom = 8;
  }
  return margins;
}

std::string gnuplot_logarithmic_ticks(const AxisRange& range) {
  constexpr double kSlack = 1e-9;
  const int first = static_cast<int>(std::floor(std::log10(range.low) + kSlack));
  const int last = static_cast<int>(std::ceil(std::log10(range.high) - kSlack));
  const double decades = std::log10(range.high / range.low);
  const int every = decades > 14 ? 4 : decades > 7 ? 2 : 1;
  std::string ticks;
  for (int n = first; n <= last; ++n)
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * std::pow(10.0, n);
      if (value < range.low * (1 - kSlack) || value > range.high * (1 + kSlack)) continue;
      const bool is_power = digit == 1 && n % every == 0;
      const bool is_between = decades <= 1.7 && (digit == 2 || digit == 5);
      if (!is_power && !is_between && every > 1) continue;
      std::string label;
      if (is_power)
        label = n >= -2 && n <= 3 ? fmt::format("{:g}", value) : fmt::format("10^{{{}}}", n);
      else if (is_between)
        label = fmt::format("{:g}", value);
      ticks += fmt::format("{}'{}' {}{}", ticks.empty() ? "" : ", ", label, gnuplot_number(value),
                           label.empty() ? " 1" : "");
    }
  return ticks;
}

std::string gnuplot_named_ticks(const std::vector<std::string>& names) {
  std::string ticks;
  for (std::size_t k = 0; k < names.size(); ++k)
    ticks += fmt::format("{}{} {}", k > 0 ? ", " : "", tick_text(names[k]), k);
  return ticks;
}

}  // namespace slipcheck
