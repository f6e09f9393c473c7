#include "report/charts/heat_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "report/charts/plot_text.h"

namespace slipcheck {
namespace {

constexpr int kLevels = 64;  // of colour

using Colour = std::array<double, 3>;
/// Dark at both ends, so that lightness alone tells how far from the middle a value is.
constexpr std::array<Colour, 5> kStops = {Colour{160, 60, 0}, Colour{235, 150, 80},
                                          Colour{250, 250, 247}, Colour{110, 180, 220},
                                          Colour{0, 84, 146}};

int level_of(double share) { return std::clamp(static_cast<int>(share * kLevels), 0, kLevels - 1); }

/// Which share of the colours a level has.
double share_of(const HeatMap& map, int level) {
  const double share = (level + 0.5) / kLevels;
  return map.low_is_blue ? 1 - share : share;
}

/// What stands in the cells that have no value.
std::string missing_cells(const HeatMap& map, const PlotFrame& frame) {
  if (map.missing.empty()) return {};
  const double width = frame.width / static_cast<double>(map.x_values.size());
  const double height = frame.height / static_cast<double>(map.y_values.size());
  std::string svg = "<g text-anchor=\"middle\" font-size=\"11\" fill=\"#7a7a7a\">";
  for (std::size_t k = 0; k < map.z.size(); ++k) {
    if (!std::isnan(map.z[k])) continue;
    const auto row = static_cast<double>(k / map.x_values.size());
    const auto column = static_cast<double>(k % map.x_values.size());
    svg += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\">{}</text>",
                       frame.left + (column + 0.5) * width,
                       frame.top + frame.height - (row + 0.5) * height + 4, plot_text(map.missing));
  }
  return svg + "</g>\n";
}

std::string colour_bar(const HeatMap& map, const PlotFrame& frame) {
  const double left = frame.left + frame.width + 12, width = 12;
  const double step = frame.height / kLevels;
  std::string svg = "<g shape-rendering=\"crispEdges\">";
  for (int k = 0; k < kLevels; ++k)
    svg += fmt::format("<path fill=\"{}\" d=\"M{:.2f} {:.2f}h{:g}v{:.2f}h-{:g}z\"/>",
                       heat_colour(share_of(map, k)), left,
                       frame.top + frame.height - (k + 1) * step, width,
                       // A little more, so that no line of background shows between two levels.
                       step + (k > 0 ? 0.5 : 0), width);
  svg += "</g>\n";
  const PlotAxis axis({map.z_label, false, map.z_low, map.z_high}, {});
  for (const PlotAxis::Tick& tick : axis.ticks())
    svg += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\">{}</text>", left + width + 4,
                       frame.top + (1 - axis.fraction(tick.value)) * frame.height + 4,
                       plot_text(tick.label));
  svg += fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\" font-size=\"13\">{}</text>\n",
      left + width / 2 + 6, frame.top - 9, plot_text(map.z_label));
  return svg;
}

}  // namespace

std::string heat_colour(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  std::array<int, 3> rgb{};
  for (std::size_t c = 0; c < 3; ++c)
    rgb[c] = static_cast<int>(std::lround(kStops[k][c] + (at - static_cast<double>(k)) *
                                                             (kStops[k + 1][c] - kStops[k][c])));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

PlotAxis grid_axis(AxisSpec spec, const std::vector<double>& centres) {
  const double first = centres.front(), last = centres.back();
  const double cells = static_cast<double>(std::max<std::size_t>(centres.size(), 2) - 1);
  if (spec.logarithmic) {
    const double half = std::pow(last / first, 0.5 / cells);
    spec.low = first / half;
    spec.high = last * half;
  } else {
    const double half = 0.5 * (last - first) / cells;
    spec.low = first - half;
    spec.high = last + half;
  }
  return PlotAxis(std::move(spec), centres);
}

std::string heat_map_svg(const HeatMap& map, const PlotFrame& frame) {
  const std::size_t columns = map.x_values.size(), rows = map.y_values.size();
  const double width = frame.width / static_cast<double>(columns);
  const double height = frame.height / static_cast<double>(rows);
  // Neighbours of one colour in a row are one rectangle, all of one colour one path.
  std::map<int, std::string> paths;
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns;) {
      const auto level = [&](std::size_t column) {
        const double value = map.z[r * columns + column];
        return std::isnan(value) ? -1 : level_of((value - map.z_low) / (map.z_high - map.z_low));
      };
      std::size_t end = c + 1;
      while (end < columns && level(end) == level(c)) ++end;
      if (level(c) >= 0)
        paths[level(c)] += fmt::format(
            "M{:.2f} {:.2f}h{:.2f}v{:.2f}h-{:.2f}z", frame.left + width * static_cast<double>(c),
            frame.top + frame.height - height * static_cast<double>(r + 1),
            width * static_cast<double>(end - c), height, width * static_cast<double>(end - c));
      c = end;
    }
  std::string svg = "<g shape-rendering=\"crispEdges\">\n";
  for (const auto& [level, path] : paths)
    svg += fmt::format("<path fill=\"{}\" d=\"{}\"/>\n", heat_colour(share_of(map, level)), path);
  svg += "</g>\n" + missing_cells(map, frame);
  svg += axes_svg(map.title, grid_axis(map.x, map.x_values), grid_axis(map.y, map.y_values), frame);
  return svg + colour_bar(map, frame);
}

}  // namespace slipcheck
