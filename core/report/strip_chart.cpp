#include "report/strip_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/comparison_rows.h"
#include "report/html_text.h"
#include "report/quantity.h"

namespace slipcheck {
namespace {

// Heights in CSS pixels; across, everything is in percent of the strip, which is as wide as the
// screen allows.
constexpr double kStripHeight = 40;
constexpr double kMargin = 5;  // above the first and below the last phase
constexpr double kAxisHeight = 20;

/// What the axis covers [SI].
struct Axis {
  double low = 0, high = 1;
  double percent(double value) const { return 100 * (value - low) / (high - low); }
};

/// Covers the tolerance and all values but outliers that would squeeze the rest to nothing: those
/// further from the tolerance and the middle four fifths of the values than twice their extent.
Axis axis_for(const PhaseSpread& spread) {
  std::vector<double> values;
  for (const RunSpread& run : spread.runs)
    for (double value : run.values)
      if (!std::isnan(value)) values.push_back(value);
  std::sort(values.begin(), values.end());
  const std::size_t tenth = values.size() / 10;
  double low = std::min(spread.low, values[tenth]);
  double high = std::max(spread.high, values[values.size() - 1 - tenth]);
  const double lowest = low - 2 * (high - low), highest = high + 2 * (high - low);
  for (double value : values) {
    if (value >= lowest) low = std::min(low, value);
    if (value <= highest) high = std::max(high, value);
  }
  // Around the tolerance there is always room to see its edges.
  const double band = spread.high - spread.low;
  const double room = std::max({0.05 * (high - low), 0.25 * band, 1e-12 * std::abs(high)});
  if (!(room > 0)) return {low - 1, high + 1};
  return {spread.is_distance ? -0.02 * (high - low) : low - room, high + room};
}

/// Multiples of 1, 2 or 5 times a power of ten, four to eight of them.
std::vector<double> ticks(const Axis& axis) {
  const double raw = (axis.high - axis.low) / 5;
  const double decade = std::pow(10.0, std::floor(std::log10(raw)));
  const double step = raw / decade < 1.5 ? decade : raw / decade < 3.5 ? 2 * decade : 5 * decade;
  std::vector<double> result;
  for (double k = std::ceil(axis.low / step); k * step <= axis.high; ++k)
    result.push_back(k * step);
  return result;
}

std::string dots(const PhaseSpread& spread, const RunSpread& run, const Axis& axis) {
  std::string svg;
  const double phases = static_cast<double>(run.values.size());
  for (std::size_t p = 0; p < run.values.size(); ++p) {
    const double value = run.values[p];
    if (std::isnan(value)) continue;
    const double y =
        kMargin + (static_cast<double>(p) + 0.5) / phases * (kStripHeight - 2 * kMargin);
    const bool inside = value >= spread.low && value <= spread.high;
    const char* shape = value < axis.low ? "l" : value > axis.high ? "r" : inside ? "i" : "o";
    const double x = std::clamp(axis.percent(value), 1.0, 99.0);
    svg += fmt::format("<use href=\"#{}\" x=\"{:.2f}%\" y=\"{:.1f}\"/>", shape, x, y);
  }
  return svg;
}

std::string strip(const PhaseSpread& spread, const RunSpread& run, const Axis& axis,
                  const std::vector<double>& grid) {
  std::string svg = fmt::format(
      "<svg class=\"strip\" width=\"100%\" height=\"{}\" role=\"img\" aria-label=\"{}\">",
      kStripHeight, escaped(words_of(spread, run)));
  for (double tick : grid)
    svg += fmt::format("<line class=\"grid\" x1=\"{0:.2f}%\" x2=\"{0:.2f}%\" y1=\"0\" y2=\"{1}\"/>",
                       axis.percent(tick), kStripHeight);
  const double left = axis.percent(spread.low), right = axis.percent(spread.high);
  svg += fmt::format("<rect class=\"band\" x=\"{:.2f}%\" width=\"{:.2f}%\" y=\"0\" height=\"{}\"/>",
                     left, std::max(right - left, 0.2), kStripHeight);
  svg += fmt::format("<line class=\"truth\" x1=\"{0:.2f}%\" x2=\"{0:.2f}%\" y1=\"0\" y2=\"{1}\"/>",
                     axis.percent(spread.reference), kStripHeight);
  return svg + dots(spread, run, axis) + "</svg>";
}

std::string axis_line(const Axis& axis, const std::vector<double>& grid,
                      const QuantityFormat& format) {
  std::string svg = fmt::format(
      "<svg class=\"axis\" width=\"100%\" height=\"{}\" aria-hidden=\"true\">", kAxisHeight);
  // As many decimals as the ticks' distance needs.
  const double step = grid.size() > 1 ? (grid[1] - grid[0]) / format.factor() : 1;
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
  for (double tick : grid) {
    const double x = axis.percent(tick);
    if (x < 3 || x > 97) continue;  // would be cut off
    const double value =
        std::abs(tick) < 1e-9 * (axis.high - axis.low) ? 0 : tick / format.factor();
    svg += fmt::format("<text x=\"{:.2f}%\" y=\"14\">{:.{}f}</text>", x, value, decimals);
  }
  return svg + "</svg>";
}

std::string row_label(const RunSpread& run) {
  const EngineRecord& record = *run.run;
  const char* symbol = symbol_of(run.outside > 0 ? Mark::deviates : Mark::within);
  std::string html = fmt::format(
      "<div class=\"row-label\"><span>{}</span> <span class=\"{}\">{} {} of {} outside</span>",
      escaped(fmt::format("{} {} {}, {:g} Hz", record.engine, record.precision, record.profile,
                          record.rate)),
      run.outside > 0 ? "bad" : "good", symbol, run.outside, run.shown);
  if (const std::size_t missing = run.values.size() - run.shown; missing > 0)
    html += fmt::format(" <span class=\"bad\">{} not shown</span>", missing);
  return html + "</div>";
}

}  // namespace

std::string strip_chart_shapes() {
  return R"(<svg class="shapes" width="0" height="0" aria-hidden="true"><defs>
<circle id="i" r="2.6"/>
<path id="o" d="M-2.6-2.6L2.6 2.6M-2.6 2.6L2.6-2.6"/>
<path id="l" d="M-4 0L3-3.5L3 3.5Z"/>
<path id="r" d="M4 0L-3-3.5L-3 3.5Z"/>
</defs></svg>
)";
}

std::string strip_chart(const PhaseSpread& spread) {
  const Axis axis = axis_for(spread);
  const std::vector<double> grid = ticks(axis);
  const QuantityFormat format(std::max(std::abs(axis.low), std::abs(axis.high)), spread.dimension);
  const std::string unit = format.unit().empty() ? "" : " [" + format.unit() + "]";
  std::string html = "<div class=\"strips\">\n";
  for (const RunSpread& run : spread.runs)
    html += row_label(run) + "\n" + strip(spread, run, axis, grid) + "\n";
  html += fmt::format("<div class=\"row-label unit\">{}{}</div>\n{}\n</div>\n",
                      spread.is_distance ? "distance from the reference" : escaped(spread.name),
                      escaped(unit), axis_line(axis, grid, format));
  return html;
}

}  // namespace slipcheck
