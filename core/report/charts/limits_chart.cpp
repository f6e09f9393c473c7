#include "report/charts/limits_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "report/charts/category_map.h"
#include "report/charts/line_chart.h"
#include "report/charts/plot_axis.h"
#include "report/charts/plot_text.h"
#include "report/charts/svg_image.h"
#include "report/rows/outcome_look.h"

namespace slipcheck {
namespace {

// All in px.
constexpr double kWidth = 760, kRight = 118, kTop = 30, kBar = 13, kLine = 20, kFont = 12;
constexpr double kAxis = 48;  // below the bars
constexpr double kEdge = 10;

// What is stable need not be accurate.
constexpr OutcomeLook kWorks{"✓", "", "#0072b2", "#ffffff"};

bool works_above(Limit::Kind kind) { return kind == Limit::Kind::length_scale; }

std::string axis_label(Limit::Kind kind) {
  switch (kind) {
    case Limit::Kind::stable_step:
    case Limit::Kind::accurate_step:
      return "step [s]";
    case Limit::Kind::length_scale:
      return "factor on all lengths [-]";
    case Limit::Kind::mass_ratio:
      return "ratio of masses [-]";
  }
  return "";
}

/// From `first` to `last` of the axis in one colour; nothing where that is empty.
std::string bar(const PlotAxis& axis, const PlotFrame& frame, double y, double first, double last,
                const OutcomeLook& look) {
  const double from = std::clamp(axis.fraction(first), 0.0, 1.0);
  const double to = std::clamp(axis.fraction(last), 0.0, 1.0);
  if (!(to > from)) return {};
  std::string svg =
      fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:g}\" fill=\"{}\"/>",
                  frame.left + from * frame.width, y, (to - from) * frame.width, kBar, look.fill);
  if ((to - from) * frame.width < 12) return svg + "\n";
  return svg + fmt::format(
                   "<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\" "
                   "font-size=\"10\" fill=\"{}\">{}</text>\n",
                   frame.left + (from + to) / 2 * frame.width, y + 10, look.ink, look.letter);
}

/// Where the limit's bar changes its colour; at the bad end of the range where all is good.
double border_of(const Limit& limit) {
  if (limit.good && limit.bad) return std::sqrt(*limit.good * *limit.bad);
  const bool all_good = limit.good.has_value();
  return works_above(limit.kind) == all_good ? limit.low : limit.high;
}

std::string row_svg(const Limit& limit, const PlotAxis& axis, const PlotFrame& frame, double y) {
  std::string svg = fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"end\">{}</text>\n",
                                frame.left - 8, y + 11, plot_text(plot_literal(label_of(limit))));
  const bool known = limit.good || limit.bad;
  if (known) {
    const double border = border_of(limit);
    const OutcomeLook &good = kWorks, &bad = look_of(limit.beyond);
    const bool above = works_above(limit.kind);
    svg += bar(axis, frame, y, limit.low, border, above ? bad : good);
    svg += bar(axis, frame, y, border, limit.high, above ? good : bad);
  }
  for (const double island : limit.islands)
    if (const double at = axis.fraction(island); at >= 0 && at <= 1)
      svg +=
          fmt::format("<path d=\"M{:.2f} {:.2f}v{:g}\" stroke=\"#f0e442\" stroke-width=\"3\"/>\n",
                      frame.left + at * frame.width, y, kBar);
  if (limit.theory)
    if (const double at = axis.fraction(*limit.theory); at >= 0 && at <= 1)
      svg += fmt::format(
          "<path d=\"M{0:.2f} {1:.2f}v{2:g}\" stroke=\"#ffffff\" stroke-width=\"5\"/><path "
          "d=\"M{0:.2f} {1:.2f}v{2:g}\" stroke=\"#1b1b1b\" stroke-width=\"2\"/>\n",
          frame.left + at * frame.width, y - 2, kBar + 4);
  const std::string value = limit.good && limit.bad ? value_text(limit.kind, limit.value())
                            : limit.good            ? "all"
                            : limit.bad             ? "none"
                                                    : "no answer";
  return svg + fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\">{}</text>\n",
                           frame.left + frame.width + 8, y + 11, plot_text(plot_literal(value)));
}

/// In as many lines as it takes; `y` moves on.
std::string legend_svg(const LimitGroup& group, double& y) {
  std::set<Outcome> outcomes;
  bool theory = false, islands = false;
  for (const Limit* limit : group.limits) {
    if (limit->bad) outcomes.insert(limit->beyond);
    theory |= limit->theory.has_value();
    islands |= !limit->islands.empty();
  }
  double x = kEdge;
  std::string svg;
  // Each sample is 18 × 16 px, drawn for a place whose left upper corner is the origin.
  const auto add = [&](const std::string& sample, const std::string& label) {
    const double width = 44 + kFont * plot_text_width(label);
    if (x + width > kWidth) {
      x = kEdge;
      y += kLine;
    }
    svg += fmt::format(
        "<g transform=\"translate({:.2f} {:.2f})\">{}<text x=\"24\" y=\"12\">{}"
        "</text></g>\n",
        x, y, sample, plot_text(label));
    x += width;
  };
  const auto tick = [](const char* colour) {
    return fmt::format("<path d=\"M9 0v16\" stroke=\"{}\" stroke-width=\"3\"/>", colour);
  };
  add(fmt::format("<rect width=\"18\" height=\"16\" fill=\"{}\"/><text x=\"9\" y=\"12\" "
                  "text-anchor=\"middle\" font-size=\"11\" fill=\"{}\">{}</text>",
                  kWorks.fill, kWorks.ink, kWorks.letter),
      "works");
  for (const Outcome outcome : outcomes)
    add(outcome_cell_svg(outcome, {0, 0, 18, 16}, ""), name_of(outcome));
  if (theory) add(tick("#1b1b1b"), "theory");
  if (islands) add(tick("#f0e442"), "bad all the same");
  y += kLine;
  return svg;
}

}  // namespace

std::string limits_svg(const LimitGroup& group, const std::string& name) {
  double low = INFINITY, high = 0, widest = 0;
  for (const Limit* limit : group.limits) {
    if (limit->low > 0) low = std::min(low, limit->low);
    high = std::max(high, limit->high);
    widest = std::max(widest, plot_text_width(plot_literal(label_of(*limit))));
  }
  AxisSpec spec{axis_label(group.kind), true};
  if (high > low) {
    spec.low = low;
    spec.high = high;
  }
  const PlotAxis axis(spec, {});
  const double left = 24 + kFont * widest;
  const double rows = kLine * static_cast<double>(group.limits.size());
  const PlotFrame frame{left, kTop, kWidth - left - kRight, rows + 8};
  std::string body;
  for (const PlotAxis::Tick& tick : axis.ticks()) {
    const double x = frame.left + axis.fraction(tick.value) * frame.width;
    if (tick.label.empty()) continue;
    body += fmt::format(
        "<path d=\"M{:.2f} {:.2f}v{:.2f}\" stroke=\"#d5d5d0\"/><text x=\"{:.2f}\" "
        "y=\"{:.2f}\" text-anchor=\"middle\">{}</text>\n",
        x, frame.top, frame.height, x, frame.top + frame.height + 16, plot_text(tick.label));
  }
  const std::string title = fmt::format("{}, {}", words_of(group.kind), plot_literal(group.scene));
  body += fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\" font-size=\"13\" "
      "font-weight=\"600\">{}</text>\n<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\" "
      "font-size=\"13\">{}</text>\n",
      kWidth / 2, kTop - 11, plot_text(title), frame.left + frame.width / 2,
      frame.top + frame.height + 36, plot_text(spec.label));
  for (std::size_t k = 0; k < group.limits.size(); ++k)
    body += row_svg(*group.limits[k], axis, frame,
                    frame.top + 4 + kLine * static_cast<double>(k) + (kLine - kBar) / 2);
  double bottom = frame.top + frame.height + kAxis;
  body += legend_svg(group, bottom);
  return svg_image(kWidth, bottom + 6, name, title,
                   "bars: where each method works, and how it fails beyond", body);
}

}  // namespace slipcheck
