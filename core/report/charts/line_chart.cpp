#include "report/charts/line_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/charts/plot_text.h"

namespace slipcheck {
namespace {

constexpr double kMarkerSize = 2.7;
constexpr double kFarOutside = 20;  // in frames: what is beyond is drawn there

/// Dots and dashes in px.
const char* dashes_of(Line line) {
  switch (line) {
    case Line::dashed:
      return " stroke-dasharray=\"7 4\"";
    case Line::dotted:
      return " stroke-dasharray=\"1.5 3.5\"";
    case Line::dash_dot:
      return " stroke-dasharray=\"9 3 2 3\"";
    case Line::none:
    case Line::solid:
      break;
  }
  return "";
}

std::string path_of(Marker marker, double x, double y) {
  const double s = kMarkerSize;
  switch (marker) {
    case Marker::circle:
      return fmt::format("M{:.2f} {:.2f}a{s} {s} 0 1 0 {d} 0a{s} {s} 0 1 0 -{d} 0z", x - s, y,
                         fmt::arg("s", s), fmt::arg("d", 2 * s));
    case Marker::triangle:
      return fmt::format("M{:.2f} {:.2f}l{:g} {:g}h{:g}z", x, y - 1.2 * s, 1.15 * s, 2 * s,
                         -2.3 * s);
    case Marker::square:
      return fmt::format("M{:.2f} {:.2f}h{:g}v{:g}h{:g}z", x - 0.9 * s, y - 0.9 * s, 1.8 * s,
                         1.8 * s, -1.8 * s);
    case Marker::diamond:
      return fmt::format("M{:.2f} {:.2f}l{d:g} {d:g}l-{d:g} {d:g}l-{d:g} -{d:g}z", x, y - 1.4 * s,
                         fmt::arg("d", 1.4 * s));
    case Marker::ring:
      return fmt::format("M{:.2f} {:.2f}a{r:g} {r:g} 0 1 0 {d:g} 0a{r:g} {r:g} 0 1 0 -{d:g} 0z",
                         x - 2.1 * s, y, fmt::arg("r", 2.1 * s), fmt::arg("d", 4.2 * s));
    case Marker::none:
      break;
  }
  return {};
}

std::string stroke_of(const Look& look) {
  return fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{}", colour_of(look.ink),
                     look.line == Line::dotted ? 1.9 : 1.6, dashes_of(look.line));
}

std::string marker_paint(const Look& look) {
  if (look.marker == Marker::ring)
    return fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"", colour_of(look.ink));
  return fmt::format("fill=\"#ffffff\" stroke=\"{}\" stroke-width=\"1.3\"", colour_of(look.ink));
}

/// Places of values in the frame.
class Placing {
 public:
  Placing(const PlotAxis& x, const PlotAxis& y, const PlotFrame& frame)
      : x_(&x), y_(&y), frame_(frame) {}

  bool shows(double x, double y) const {
    return std::isfinite(x_->fraction(x)) && std::isfinite(y_->fraction(y));
  }
  double x(double value) const { return frame_.left + bounded(x_->fraction(value)) * frame_.width; }
  double y(double value) const {
    return frame_.top + (1 - bounded(y_->fraction(value))) * frame_.height;
  }
  bool is_inside(double x, double y) const {
    const auto within = [](double f) { return f >= -1e-9 && f <= 1 + 1e-9; };
    return within(x_->fraction(x)) && within(y_->fraction(y));
  }

 private:
  static double bounded(double fraction) { return std::clamp(fraction, -kFarOutside, kFarOutside); }

  const PlotAxis* x_;
  const PlotAxis* y_;
  PlotFrame frame_;
};

std::string line_of(const Curve& curve, const Placing& place) {
  std::string path;
  bool pen_down = false;
  for (std::size_t k = 0; k < curve.x.size(); ++k) {
    const bool shown = place.shows(curve.x[k], curve.y[k]);
    if (shown)
      path += fmt::format("{}{:.2f} {:.2f}", pen_down ? 'L' : 'M', place.x(curve.x[k]),
                          place.y(curve.y[k]));
    pen_down = shown;
  }
  return fmt::format("<path d=\"{}\" {}/>\n", path, stroke_of(curve.look));
}

std::string markers_of(const Curve& curve, const Placing& place) {
  std::string path;
  const std::size_t every = std::max<std::size_t>(1, curve.marker_every);
  for (std::size_t k = curve.marker_first; k < curve.x.size(); k += every)
    if (place.shows(curve.x[k], curve.y[k]) && place.is_inside(curve.x[k], curve.y[k]))
      path += path_of(curve.look.marker, place.x(curve.x[k]), place.y(curve.y[k]));
  return fmt::format("<path d=\"{}\" {}/>\n", path, marker_paint(curve.look));
}

std::vector<double> all_of(const LineChart& chart, bool of_y) {
  std::vector<double> values;
  const auto shown = [](const AxisSpec& axis, double value) {
    return !(axis.low && value < *axis.low) && !(axis.high && value > *axis.high);
  };
  for (const Curve& curve : chart.curves)
    for (std::size_t k = 0; k < curve.x.size(); ++k)
      if (!of_y || shown(chart.x, curve.x[k])) values.push_back(of_y ? curve.y[k] : curve.x[k]);
  return values;
}

}  // namespace

const char* colour_of(Ink ink) {
  switch (ink) {
    case Ink::black:
      return "#1b1b1b";
    case Ink::blue:
      return "#0072b2";
    case Ink::vermilion:
      return "#d55e00";
    case Ink::green:
      return "#009e73";
    case Ink::purple:
      return "#cc79a7";
    case Ink::grey:
      return "#7a7a7a";
    case Ink::orange:
      return "#e69f00";
    case Ink::sky:
      return "#56b4e9";
  }
  return "#1b1b1b";
}

std::string legend_sample(const Look& look, double x, double y, double width) {
  std::string svg;
  if (look.line != Line::none)
    svg += fmt::format("<path d=\"M{:.1f} {:.1f}h{:g}\" {}/>", x, y, width, stroke_of(look));
  if (look.marker != Marker::none)
    svg += fmt::format("<path d=\"{}\" {}/>", path_of(look.marker, x + width / 2, y),
                       marker_paint(look));
  return svg;
}

std::string axes_svg(const std::string& title, const PlotAxis& x, const PlotAxis& y,
                     const PlotFrame& frame) {
  const double right = frame.left + frame.width, bottom = frame.top + frame.height;
  std::string svg, minor;
  double widest = 0;
  for (const PlotAxis::Tick& tick : x.ticks()) {
    const double at = frame.left + x.fraction(tick.value) * frame.width;
    if (tick.label.empty()) {
      minor += fmt::format("M{:.2f} {:.2f}v-3", at, bottom);
      continue;
    }
    minor += fmt::format("M{:.2f} {:.2f}v-6", at, bottom);
    svg += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\">{}</text>", at, bottom + 16,
                       plot_text(tick.label));
  }
  svg = "<g text-anchor=\"middle\">" + svg + "</g>\n<g text-anchor=\"end\">";
  for (const PlotAxis::Tick& tick : y.ticks()) {
    const double at = bottom - y.fraction(tick.value) * frame.height;
    if (tick.label.empty()) {
      minor += fmt::format("M{:.2f} {:.2f}h3", frame.left, at);
      continue;
    }
    minor += fmt::format("M{:.2f} {:.2f}h6", frame.left, at);
    svg += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\">{}</text>", frame.left - 6, at + 4,
                       plot_text(tick.label));
    widest = std::max(widest, plot_text_width(tick.label));
  }
  svg += "</g>\n";
  svg += fmt::format(
      "<path d=\"{}M{:.2f} {:.2f}h{:.2f}v{:.2f}h{:.2f}z\" fill=\"none\" stroke=\"#5c5c5c\"/>\n",
      minor, frame.left, frame.top, frame.width, frame.height, -frame.width);
  svg += fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\" font-size=\"13\">{}</text>\n",
      frame.left + frame.width / 2, bottom + 36, plot_text(x.spec().label));
  const double label_x = frame.left - 18 - 12 * widest, label_y = frame.top + frame.height / 2;
  svg += fmt::format(
      "<text x=\"{0:.2f}\" y=\"{1:.2f}\" text-anchor=\"middle\" font-size=\"13\" "
      "transform=\"rotate(-90 {0:.2f} {1:.2f})\">{2}</text>\n",
      label_x, label_y, plot_text(y.spec().label));
  svg += fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\" font-size=\"13\" "
      "font-weight=\"600\">{}</text>\n",
      (frame.left + right) / 2, frame.top - 9, plot_text(title));
  return svg;
}

std::string line_chart_svg(const LineChart& chart, const PlotFrame& frame, const std::string& id) {
  const PlotAxis x(chart.x, all_of(chart, false)), y(chart.y, all_of(chart, true));
  const Placing place(x, y, frame);
  std::string svg = fmt::format(
      "<clipPath id=\"{}\"><rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" "
      "height=\"{:.2f}\"/></clipPath>\n",
      id, frame.left, frame.top, frame.width, frame.height);
  if (!y.spec().logarithmic && y.low() < 0 && y.high() > 0)
    svg += fmt::format("<path d=\"M{:.2f} {:.2f}h{:.2f}\" stroke=\"#d5d5d0\"/>\n", frame.left,
                       place.y(0), frame.width);
  svg += axes_svg(chart.title, x, y, frame);
  double mark_y = frame.top + 14;
  for (const ChartMark& mark : chart.marks) {
    const double at = place.x(mark.x);
    const double label_y = mark.is_low ? frame.top + frame.height - 8 : mark_y;
    svg += fmt::format(
        "<path d=\"M{0:.2f} {1:.2f}v{2:.2f}\" stroke=\"#5c5c5c\" stroke-dasharray=\"2 2\"/>"
        "<text x=\"{3:.2f}\" y=\"{4:.2f}\">{5}</text>\n",
        at, frame.top, frame.height, at + 4, label_y, plot_text(mark.label));
    if (!mark.is_low) mark_y += 16;
  }
  svg += fmt::format("<g clip-path=\"url(#{})\" stroke-linejoin=\"round\">\n", id);
  for (const Curve& curve : chart.curves)
    if (curve.look.line != Line::none) svg += line_of(curve, place);
  svg += "</g>\n";
  // Markers at the frame are not cut in half.
  for (const Curve& curve : chart.curves)
    if (curve.look.marker != Marker::none) svg += markers_of(curve, place);
  return svg;
}

}  // namespace slipcheck
