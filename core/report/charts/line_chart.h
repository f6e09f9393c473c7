#pragma once

#include <string>
#include <vector>

#include "report/charts/plot_axis.h"

namespace slipcheck {

/// Colours of Okabe and Ito, which colour-blind people can tell apart. Line and marker always say
/// the same.
enum class Ink { black, blue, vermilion, green, purple, grey, orange, sky };
enum class Line { none, solid, dashed, dotted, dash_dot };
/// A ring goes around another curve's marker.
enum class Marker { none, circle, triangle, square, diamond, ring };

/// How a curve is drawn.
struct Look {
  Ink ink = Ink::black;
  Line line = Line::solid;
  Marker marker = Marker::none;
};

struct Curve {
  std::string label;  ///< in the legend, as plot_text.h; empty: not there
  Look look;
  std::vector<double> x, y;                        ///< of equal size; NaN leaves a gap
  std::size_t marker_every = 1, marker_first = 0;  ///< which points get a marker
};

/// A vertical line at x with a name.
struct ChartMark {
  double x = 0;
  std::string label;
  bool is_low = false;  ///< the name stands at the line's lower end
};

/// Curves over one axis.
struct LineChart {
  std::string title;
  AxisSpec x, y;
  std::vector<Curve> curves;
  std::vector<ChartMark> marks;
};

/// "#0072b2"
const char* colour_of(Ink ink);

/// A short piece of the curve as the legend shows it, from (x, y) on, `width` wide; SVG.
std::string legend_sample(const Look& look, double x, double y, double width);

/// Where a chart lies in its figure [px]: the frame of the plot itself.
struct PlotFrame {
  double left, top, width, height;
};

/// The frame, ticks, labels and title; SVG.
std::string axes_svg(const std::string& title, const PlotAxis& x, const PlotAxis& y,
                     const PlotFrame& frame);

/// The whole chart; SVG. `id` is that of its clip path, unique on a page.
std::string line_chart_svg(const LineChart& chart, const PlotFrame& frame, const std::string& id);

}  // namespace slipcheck
