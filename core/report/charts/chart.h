#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace slipcheck {

/// Colours of Okabe and Ito, which colour-blind people can tell apart. Line and marker always say
/// the same.
enum class Ink { black, blue, vermilion, green, purple, grey, orange, sky };
enum class Line { none, solid, dashed, dotted, dash_dot };
/// A ring goes around another curve's marker.
enum class Marker { none, circle, triangle, square, diamond, ring };

/// "#0072b2"; of the page in dark colours, "#56b4e9".
const char* colour_of(Ink ink);
const char* dark_colour_of(Ink ink);

/// How a curve is drawn.
struct Look {
  Ink ink = Ink::black;
  Line line = Line::solid;
  Marker marker = Marker::none;
  bool halo = false;  ///< white about the line, which shows it on every colour

  bool operator==(const Look&) const = default;
};

/// The look of the k-th of many: no two of the first twelve are alike even without their colours.
Look look_of_run(std::size_t k);

/// Texts of charts are formulas (plot_text.h); what is none is made one by plot_literal().
struct Curve {
  std::string label;  ///< in the legend; empty: not there
  Look look;
  std::vector<double> x = {}, y = {};              ///< of equal size; NaN leaves a gap
  std::size_t marker_every = 1, marker_first = 0;  ///< which points get a marker
  std::vector<std::string> notes = {};             ///< what a point is; none, or one for each
  bool at_edge = false;  ///< what is beyond the axes is drawn at their ends
};

/// A vertical line at x with a name.
struct ChartMark {
  double x = 0;
  std::string label;
  bool is_low = false;  ///< the name stands at the line's lower end
};

/// What lies between two values of x and of y is tinted; infinite: up to the frame.
struct Band {
  std::string label;  ///< in the legend; empty: not there
  double x_low, x_high, y_low, y_high;
};

/// How cells of one kind are filled: the letter says the same as the colour.
struct CellLook {
  std::string label;  ///< in the legend
  std::string letter, fill, ink;
};
struct MapCell {
  double x_low, x_high, y_low, y_high;
  std::size_t look;  ///< of the panel's
  std::string note;  ///< what the page says when it is pointed at
};

/// A quantity on a grid, as colours from vermilion over white to blue.
struct ColourMap {
  std::vector<double> x_values, y_values;  ///< centres of the cells, rising, even on the axis
  std::vector<double> z;  ///< at y_values[r] and x_values[c]: z[r * x_values.size() + c]
  std::string label;
  double low = -1, high = 1;  ///< at the ends of the colours; what is beyond has theirs
  bool low_is_blue = false;   ///< the colours the other way round, for errors
};

struct AxisSpec {
  std::string label;  ///< with the unit in brackets
  bool logarithmic = false;
  /// In the unit of the label; where not given, the data decide. > 0 on a logarithmic axis.
  std::optional<double> low = std::nullopt, high = std::nullopt;
  /// What stands at 0, 1, … in place of numbers, downwards on y. The range is then theirs.
  std::vector<std::string> names = {};
  std::vector<std::size_t> runs = {};  ///< of the scene, to which these belong; none or as many
};

/// What x should be, for errors in the page's tooltips.
struct Truth {
  double value = 0, tolerance = 0;
};

/// Everything over one pair of axes.
struct Panel {
  std::string title;
  AxisSpec x, y;
  std::vector<Curve> curves = {};
  std::vector<ChartMark> marks = {};
  std::vector<Band> bands = {};
  std::vector<CellLook> looks = {};
  std::vector<MapCell> cells = {};
  std::optional<ColourMap> colours = std::nullopt;
  std::optional<Truth> truth = std::nullopt;
};

/// Panels side by side with one legend below them.
struct Chart {
  std::string name;  ///< of its files and of ids on a page (file_stem.h)
  std::string title;
  std::string caption;  ///< what it shows, in words
  std::vector<Panel> panels;
  int columns = 2;
  double plot_height = 220;  ///< of a panel's frame, at an image width of 760 [px]
};

struct AxisRange {
  double low, high;

  /// 0 at the low end, 1 at the high end; NaN for what a logarithmic axis cannot show.
  double fraction(double value, bool logarithmic) const;
  bool operator==(const AxisRange&) const = default;
};

/// What the axes of a panel show: what they ask for, else the cells, else all curves with a little
/// room; NaN and, on a logarithmic axis, what is not positive do not count.
AxisRange x_range(const Panel& panel);
AxisRange y_range(const Panel& panel);

/// Borders of cells about rising centres: half-way, on a logarithmic axis in the logarithm.
std::vector<double> cell_borders(const std::vector<double>& centres, bool logarithmic);

/// Whether any point of it can be drawn.
bool has_point(const Curve& curve);

}  // namespace slipcheck
