#include "report/charts/store_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "report/charts/plot_text.h"
#include "report/rows/quantity.h"

namespace slipcheck {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostLines = 600;    // of parallel coordinates
constexpr std::size_t kMostPoints = 1500;  // of a scatter
constexpr std::size_t kMostPanels = 8;
constexpr std::size_t kTelling = 3;  // parameters whose pairs make surfaces
constexpr double kDecades = 2;       // about one tolerance, to the ends of the colours

/// Fifths of the runs by their outcome, the least first.
constexpr std::array<Ink, 5> kFifths = {Ink::blue, Ink::sky, Ink::green, Ink::orange,
                                        Ink::vermilion};

/// Runs that show the outcome, at most so many, evenly taken.
std::vector<std::size_t> some_runs(const StoreView& view, std::size_t most) {
  std::vector<std::size_t> shown;
  for (std::size_t run = 0; run < view.values.size(); ++run)
    if (std::isfinite(view.values[run])) shown.push_back(run);
  if (shown.size() <= most) return shown;
  std::vector<std::size_t> some;
  for (std::size_t k = 0; k < most; ++k) some.push_back(shown[k * shown.size() / most]);
  return some;
}

std::string drawn_part(const StoreView& view, std::size_t drawn) {
  const std::size_t shown = view.values.size() - view.without;
  return drawn == shown ? "" : fmt::format(" {} of {} runs are drawn.", drawn, shown);
}

AxisSpec axis_of(const SweptParameter& parameter) {
  AxisSpec axis{plot_literal(parameter.name), parameter.logarithmic};
  if (!parameter.is_number)
    for (const std::string& level : parameter.levels) axis.names.push_back(plot_literal(level));
  return axis;
}

/// Where a value is between the ends of its axis, in [0, 1].
double share_of(double value, double low, double high, bool logarithmic) {
  if (!(high > low)) return 0.5;
  return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

/// "error [tolerances]" of "i-j.effective_restitution.error [tolerances]": where there is no room.
std::string short_name(const std::string& name) {
  const std::size_t unit = name.find(" [");
  const std::size_t dot = name.rfind('.', unit == std::string::npos ? unit : unit - 1);
  return dot == std::string::npos || dot == 0 ? name : name.substr(dot + 1);
}

bool in_decades(const StoreView& view) { return view.in_tolerances || view.logarithmic; }

/// One of the axes of parallel coordinates.
struct ParallelAxis {
  std::string name;
  double low = kNaN, high = kNaN;
  bool logarithmic = false;
  const std::vector<double>* values = nullptr;
};

ParallelAxis parallel_axis(const std::string& name, const std::vector<double>& values,
                           bool logarithmic, const std::vector<std::string>& words) {
  ParallelAxis axis{name, kNaN, kNaN, logarithmic, &values};
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    axis.low = std::fmin(axis.low, value);
    axis.high = std::fmax(axis.high, value);
  }
  const std::string ends = words.empty() ? fmt::format("{:.4g} … {:.4g}", axis.low, axis.high)
                                         : fmt::format("{} … {}", words.front(), words.back());
  axis.name = plot_literal(fmt::format("{}: {}", short_name(name), ends));
  return axis;
}

Chart parallel_chart(const StoreView& view) {
  std::vector<ParallelAxis> axes;
  for (const SweptParameter& parameter : view.parameters)
    axes.push_back(
        parallel_axis(parameter.name, parameter.values, parameter.logarithmic,
                      parameter.is_number ? std::vector<std::string>() : parameter.levels));
  axes.push_back(parallel_axis(view.outcome, view.values, view.logarithmic, {}));
  const std::vector<std::size_t> runs = some_runs(view, kMostLines);
  std::vector<std::size_t> order = runs;
  std::ranges::stable_sort(order, {}, [&](std::size_t run) { return view.values[run]; });
  Chart chart{"parallel",
              "All parameters at once",
              "A line for each run, from its parameters, what tells most first, to its outcome at "
              "the right; each axis from its least to its largest, words by the alphabet. Colours "
              "are fifths of the runs by their outcome." +
                  drawn_part(view, runs.size()),
              {},
              1,
              300};
  Panel panel;
  panel.y = {"from the least to the largest", false, -0.03, 1.03};
  for (const ParallelAxis& axis : axes) panel.x.names.push_back(axis.name);
  for (std::size_t fifth = 0; fifth < kFifths.size(); ++fifth) {
    const std::size_t begin = fifth * order.size() / kFifths.size();
    const std::size_t end = (fifth + 1) * order.size() / kFifths.size();
    if (begin == end) continue;
    Curve curve{plot_literal(fmt::format("{} … {}", plain_number(view.values[order[begin]]),
                                         plain_number(view.values[order[end - 1]]))),
                {kFifths[fifth]}};
    for (std::size_t k = begin; k < end; ++k) {
      for (std::size_t a = 0; a < axes.size(); ++a) {
        curve.x.push_back(static_cast<double>(a));
        curve.y.push_back(
            share_of((*axes[a].values)[order[k]], axes[a].low, axes[a].high, axes[a].logarithmic));
      }
      curve.x.push_back(kNaN);
      curve.y.push_back(kNaN);
    }
    panel.curves.push_back(std::move(curve));
  }
  chart.panels.push_back(std::move(panel));
  return chart;
}

Panel scatter_panel(const StoreView& view, const SweptParameter& parameter,
                    const std::vector<std::size_t>& runs) {
  Panel panel;
  panel.x = axis_of(parameter);
  panel.y = {plot_literal(short_name(view.outcome)), view.logarithmic};
  Curve points{"runs", {Ink::sky, Line::none, Marker::circle}};
  for (const std::size_t run : runs) {
    points.x.push_back(parameter.values[run]);
    points.y.push_back(view.values[run]);
  }
  Curve medians{"median", {Ink::black, Line::solid, Marker::square, true}};
  medians.x = parameter.places;
  medians.y = view.medians_over(parameter);
  if (!parameter.is_number) medians.look.line = Line::none;
  panel.curves = {std::move(points), std::move(medians)};
  if (view.in_tolerances) {
    const auto [low, high] = std::ranges::minmax(parameter.places);
    panel.curves.push_back({"one tolerance", {Ink::vermilion, Line::dashed}, {low, high}, {1, 1}});
  }
  return panel;
}

Chart scatter_chart(const StoreView& view) {
  const std::vector<std::size_t> runs = some_runs(view, kMostPoints);
  Chart chart{"scatter",
              plot_literal(view.outcome) + " over each parameter",
              "Each run, and the median over all runs that have this value or are near it." +
                  drawn_part(view, runs.size()),
              {},
              2,
              220};
  for (std::size_t k = 0; k < std::min(view.parameters.size(), kMostPanels); ++k)
    chart.panels.push_back(scatter_panel(view, view.parameters[k], runs));
  return chart;
}

/// Whether cells of equal size on the axis hold these places.
bool are_even(const SweptParameter& parameter) {
  const auto& places = parameter.places;
  const std::size_t last = places.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    const double share = share_of(places[k], places[0], places[last], parameter.logarithmic);
    if (!(std::abs(share - static_cast<double>(k) / static_cast<double>(last)) < 0.02))
      return false;
  }
  return true;
}

/// A surface's axis: numbers where its levels are even, else their names.
AxisSpec level_axis(const SweptParameter& parameter, std::vector<double>& centres) {
  if (parameter.is_number && are_even(parameter)) {
    centres = parameter.places;
    return axis_of(parameter);
  }
  centres.resize(parameter.places.size());
  std::iota(centres.begin(), centres.end(), 0.0);
  AxisSpec axis{plot_literal(parameter.name)};
  for (const std::string& level : parameter.levels) axis.names.push_back(plot_literal(level));
  return axis;
}

void set_colours(const StoreView& view, ColourMap& map) {
  map.low_is_blue = true;
  if (view.in_tolerances) {
    map.low = -kDecades;
    map.high = kDecades;
    return;
  }
  double low = kNaN, high = kNaN;
  for (const double z : map.z) {
    low = std::fmin(low, z);
    high = std::fmax(high, z);
  }
  map.low = low;
  map.high = high > low ? high : low + 1;
}

Panel surface_panel(const StoreView& view, const SweptParameter& across, const SweptParameter& up) {
  ColourMap map;
  Panel panel;
  panel.x = level_axis(across, map.x_values);
  panel.y = level_axis(up, map.y_values);
  const std::size_t columns = map.x_values.size();
  std::vector<std::vector<std::size_t>> cells(columns * map.y_values.size());
  for (std::size_t run = 0; run < view.values.size(); ++run)
    if (across.level[run] < columns && up.level[run] < map.y_values.size())
      cells[up.level[run] * columns + across.level[run]].push_back(run);
  for (const auto& runs : cells) {
    const double middle = view.median_of(runs);
    // No error at all is as blue as any.
    const bool is_none = in_decades(view) && middle == 0;
    map.z.push_back(is_none ? -kDecades : in_decades(view) ? std::log10(middle) : middle);
  }
  set_colours(view, map);
  panel.colours = std::move(map);
  return panel;
}

Chart surface_chart(const StoreView& view) {
  Chart chart{
      "surface",
      fmt::format("{}{} over two parameters", in_decades(view) ? "log_{10} of " : "",
                  plot_literal(view.outcome)),
      "The median over all else, for each two of those that tell most; – where no run shows "
      "it.",
      {},
      2,
      250};
  const std::size_t count = std::min(view.parameters.size(), kTelling);
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b)
      chart.panels.push_back(surface_panel(view, view.parameters[a], view.parameters[b]));
  return chart;
}

}  // namespace

std::vector<Chart> store_charts(const StoreView& view) {
  std::vector<Chart> charts;
  if (view.parameters.empty()) return charts;
  if (view.parameters.size() > 1) charts.push_back(surface_chart(view));
  charts.push_back(scatter_chart(view));
  charts.push_back(parallel_chart(view));
  return charts;
}

}  // namespace slipcheck
