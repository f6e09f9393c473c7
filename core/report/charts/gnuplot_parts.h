#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/charts/chart.h"

namespace slipcheck {

// How the parts of a chart are written for gnuplot, and the room that they take, in px at an image
// width of 760.
inline constexpr double kChartWidth = 760, kChartFont = 12;

/// Where something lies in the image [px], from its left upper corner.
struct ChartPlace {
  double left, top, width, height;
};

/// What a panel takes beside its frame [px].
struct PanelMargins {
  double left, right, top, bottom;
};
PanelMargins panel_margins(const Panel& panel);

/// How wide a text is at the font's size [px].
double text_pixels(std::string_view text);

/// A title or a label, cut where it would leave its room [px].
std::string fitted_text(const std::string& text, double room);

/// A number as gnuplot reads it, exactly; "NaN" for what is not finite.
std::string gnuplot_number(double value);
/// Behind `dt`.
const char* gnuplot_dash(Line line);
/// The type and size of a marker, "pt 7 ps 0.5".
const char* gnuplot_point(Marker marker);

/// Powers of ten, between them 2 and 5 where few decades leave room, and minor ticks.
std::string gnuplot_logarithmic_ticks(const AxisRange& range);
/// Names at 0, 1, …
std::string gnuplot_named_ticks(const std::vector<std::string>& names);

}  // namespace slipcheck
