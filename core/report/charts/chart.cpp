#include "report/charts/chart.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace slipcheck {
namespace {

constexpr double kRoom = 0.04;  // beside the data, of the range

// In the order of Ink: on a light and on a dark ground.
constexpr std::array<std::array<const char*, 2>, 8> kColours = {{{"#1b1b1b", "#e8e8e6"},
                                                                 {"#0072b2", "#56b4e9"},
                                                                 {"#d55e00", "#f08a3c"},
                                                                 {"#009e73", "#2fc79a"},
                                                                 {"#cc79a7", "#e39bc4"},
                                                                 {"#7a7a7a", "#a5a5a0"},
                                                                 {"#e69f00", "#e9b23a"},
                                                                 {"#56b4e9", "#9ad4f2"}}};

AxisRange range_over(const AxisSpec& axis, const std::vector<double>& values, double share) {
  double low = INFINITY, high = -INFINITY;
  for (double value : values) {
    if (!std::isfinite(value) || (axis.logarithmic && value <= 0)) continue;
    if (axis.logarithmic) value = std::log10(value);
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) low = high = 0;
  const double room = high > low ? share * (high - low)
                                 : std::max(0.05 * std::abs(high), axis.logarithmic ? 0.3 : 1e-300);
  const auto back = [&](double value) { return axis.logarithmic ? std::pow(10, value) : value; };
  AxisRange range{axis.low.value_or(back(low - room)), axis.high.value_or(back(high + room))};
  if (!(range.high > range.low)) range.high = axis.logarithmic ? 10 * range.low : range.low + 1;
  return range;
}

AxisRange range_of(const Panel& panel, bool of_y) {
  const AxisSpec& axis = of_y ? panel.y : panel.x;
  if (!axis.names.empty()) return {-0.5, static_cast<double>(axis.names.size()) - 0.5};
  std::vector<double> values;
  if (panel.colours) {
    values =
        cell_borders(of_y ? panel.colours->y_values : panel.colours->x_values, axis.logarithmic);
  } else if (!panel.cells.empty()) {
    for (const MapCell& cell : panel.cells)
      for (const double value : {of_y ? cell.y_low : cell.x_low, of_y ? cell.y_high : cell.x_high})
        values.push_back(value);
  }
  if (!values.empty()) return range_over(axis, values, 0);
  const auto is_shown = [&](double x) {
    return !(panel.x.low && x < *panel.x.low) && !(panel.x.high && x > *panel.x.high);
  };
  for (const Curve& curve : panel.curves)
    for (std::size_t k = 0; k < curve.x.size(); ++k)
      if (!of_y || is_shown(curve.x[k])) values.push_back(of_y ? curve.y[k] : curve.x[k]);
  for (const Band& band : panel.bands)
    for (const double value : {of_y ? band.y_low : band.x_low, of_y ? band.y_high : band.x_high})
      values.push_back(value);
  return range_over(axis, values, kRoom);
}

}  // namespace

const char* colour_of(Ink ink) { return kColours[static_cast<std::size_t>(ink)][0]; }
const char* dark_colour_of(Ink ink) { return kColours[static_cast<std::size_t>(ink)][1]; }

Look look_of_run(std::size_t k) {
  constexpr std::array kInks = {Ink::blue,   Ink::vermilion, Ink::green,
                                Ink::purple, Ink::orange,    Ink::sky};
  constexpr std::array kMarkers = {Marker::circle, Marker::square, Marker::triangle,
                                   Marker::diamond};
  constexpr std::array kLines = {Line::dashed, Line::dotted, Line::dash_dot};
  const std::size_t shifted = k + k / (kInks.size() * 2);
  return {kInks[k % kInks.size()], kLines[k % kLines.size()], kMarkers[shifted % kMarkers.size()]};
}

bool has_point(const Curve& curve) {
  for (std::size_t k = 0; k < curve.x.size(); ++k)
    if (std::isfinite(curve.x[k]) && std::isfinite(curve.y[k])) return true;
  return false;
}

double AxisRange::fraction(double value, bool logarithmic) const {
  if (!logarithmic) return (value - low) / (high - low);
  return value > 0 ? std::log(value / low) / std::log(high / low) : NAN;
}

AxisRange x_range(const Panel& panel) { return range_of(panel, false); }
AxisRange y_range(const Panel& panel) { return range_of(panel, true); }

std::vector<double> cell_borders(const std::vector<double>& centres, bool logarithmic) {
  const auto to = [&](double v) { return logarithmic ? std::log(v) : v; };
  const auto from = [&](double v) { return logarithmic ? std::exp(v) : v; };
  const std::size_t count = centres.size();
  const double half = count > 1 ? (to(centres[1]) - to(centres[0])) / 2 : 0.5;
  std::vector<double> borders = {from(to(centres[0]) - half)};
  for (std::size_t k = 0; k + 1 < count; ++k)
    borders.push_back(from((to(centres[k]) + to(centres[k + 1])) / 2));
  borders.push_back(from(2 * to(centres.back()) - to(borders.back())));
  return borders;
}

}  // namespace slipcheck
