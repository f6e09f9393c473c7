#include "report/time_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "report/comparison_rows.h"
#include "report/html_text.h"
#include "report/plot_axis.h"
#include "report/quantity.h"
#include "report/selection.h"

namespace slipcheck {
namespace {

// Heights in CSS pixels; across, everything is in percent of the strip, which is as wide as the
// screen allows. Traces have a box of their own, stretched to the strip.
constexpr double kStripHeight = 104;
constexpr double kAxisHeight = 20;
constexpr double kTraceWidth = 1000;
constexpr std::size_t kMostColumns = 400;  // each shows its lowest and its highest sample

/// One observable over time.
struct Strip {
  const char* name;     ///< "all.height"
  const char* meaning;  ///< "H, height of the centre of mass"
  const std::vector<double>* values;
};

/// Samples from `first` to before `last`.
struct Span {
  std::size_t first, last;
};

/// As many as the distance of the ticks needs, in units of `factor`.
int decimals_of(const std::vector<double>& ticks, double factor) {
  const double step = ticks.size() > 1 ? (ticks[1] - ticks[0]) / factor : 1;
  return std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
}

class TimeStrip {
 public:
  TimeStrip(const SceneRecord& scene, const Strip& strip)
      : strip_(strip),
        series_(scene.reference.box->series),
        averaged_(series_.time.size() -
                  std::min(scene.reference.box->samples, series_.time.size())),
        format_(format_for(scene, strip.name, nullptr)),
        text_(reference_text(scene, strip.name, format_)) {
    if (const auto found = scene.reference.observables.find(strip.name);
        found != scene.reference.observables.end())
      mean_ = found->second;
    low_ = std::ranges::min(*strip.values);
    high_ = std::ranges::max(*strip.values);
    const double room = std::max(0.06 * (high_ - low_), 1e-9 * std::abs(high_));
    low_ -= room > 0 ? room : 1;
    high_ += room > 0 ? room : 1;
  }

  std::string html() const {
    const std::string label = fmt::format("{} = {}", strip_.meaning, text_);
    std::string html = fmt::format(
        "<div class=\"row-label\"><span>{}</span> <strong>{}</strong></div>\n"
        "<div class=\"timed\">{}<svg class=\"strip\" width=\"100%\" height=\"{}\" role=\"img\" "
        "aria-label=\"{}\">",
        escaped(strip_.meaning), escaped(text_), scale(), kStripHeight, escaped(label));
    html += grid() + band() + trace({0, averaged_}, "trace early");
    html += trace({averaged_, series_.time.size()}, "trace") + mean_line();
    return html + "</svg></div>\n";
  }

 private:
  double down(double value) const { return kStripHeight * (1 - (value - low_) / (high_ - low_)); }

  std::string grid() const {
    std::string svg;
    for (double tick : round_ticks(low_, high_))
      svg += fmt::format(
          "<line class=\"grid\" x1=\"0\" x2=\"100%\" y1=\"{0:.1f}\" y2=\"{0:.1f}\"/>", down(tick));
    return svg;
  }

  /// The numbers to the left of the strip.
  std::string scale() const {
    const std::vector<double> ticks = round_ticks(low_, high_);
    std::string svg = fmt::format(
        "<svg class=\"ticks\" width=\"100%\" height=\"{}\" aria-hidden=\"true\">", kStripHeight);
    const int decimals = decimals_of(ticks, format_.factor());
    for (double tick : ticks) {
      const double y = down(tick);
      if (y < 5 || y > kStripHeight - 5) continue;  // would be cut off
      const double value = std::abs(tick) < 1e-9 * (high_ - low_) ? 0 : tick / format_.factor();
      svg += fmt::format("<text x=\"100%\" y=\"{:.1f}\">{:.{}f}</text>", y + 4, value, decimals);
    }
    return svg + "</svg>";
  }

  double mean_from() const {
    return 100.0 * static_cast<double>(averaged_) / static_cast<double>(series_.time.size());
  }

  std::string band() const {
    if (!std::isfinite(mean_.uncertainty) || !std::isfinite(mean_.value)) return {};
    const double top = std::max(down(mean_.value + mean_.uncertainty), 0.0);
    const double bottom = std::min(down(mean_.value - mean_.uncertainty), kStripHeight);
    return fmt::format(
        "<rect class=\"band\" x=\"{:.2f}%\" width=\"{:.2f}%\" y=\"{:.1f}\" height=\"{:.1f}\"/>",
        mean_from(), 100 - mean_from(), top, std::max(bottom - top, 1.0));
  }

  std::string mean_line() const {
    if (!std::isfinite(mean_.value)) return {};
    return fmt::format(
        "<line class=\"mean\" x1=\"{0:.2f}%\" x2=\"100%\" y1=\"{1:.1f}\" y2=\"{1:.1f}\"/>",
        mean_from(), down(mean_.value));
  }

  std::string trace(const Span& span, const char* css_class) const {
    if (span.last - span.first < 2) return {};
    const std::size_t count = series_.time.size();
    const std::size_t per_column = std::max<std::size_t>(1, count / kMostColumns);
    std::string path;
    const auto add = [&](std::size_t k) {
      const double x = kTraceWidth * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
      path +=
          fmt::format("{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', x, down((*strip_.values)[k]));
    };
    for (std::size_t k = span.first; k < span.last; k += per_column) {
      const auto begin = strip_.values->begin();
      const auto end = begin + static_cast<std::ptrdiff_t>(std::min(k + per_column, span.last));
      const auto [low, high] = std::minmax_element(begin + static_cast<std::ptrdiff_t>(k), end);
      const auto a = static_cast<std::size_t>(std::min(low, high) - begin);
      const auto b = static_cast<std::size_t>(std::max(low, high) - begin);
      add(a);
      if (b != a) add(b);
    }
    return fmt::format(
        "<svg width=\"100%\" height=\"{0:g}\" viewBox=\"0 0 {1:g} {0:g}\" "
        "preserveAspectRatio=\"none\"><path class=\"{2}\" vector-effect=\"non-scaling-stroke\" "
        "d=\"{3}\"/></svg>",
        kStripHeight, kTraceWidth, css_class, path);
  }

  const Strip& strip_;
  const BoxSeries& series_;
  std::size_t averaged_;  ///< the first sample that counts
  QuantityFormat format_;
  std::string text_;
  UncertainValue mean_{NAN, NAN};
  double low_ = 0, high_ = 0;
};

std::string time_axis(const std::vector<double>& time) {
  const double step = time[1] - time[0];
  const double low = time.front() - 0.5 * step, high = time.back() + 0.5 * step;
  const QuantityFormat format(high, kTime);
  const std::vector<double> ticks = round_ticks(low, high);
  const int decimals = decimals_of(ticks, format.factor());
  std::string svg = fmt::format(
      "<svg class=\"axis\" width=\"100%\" height=\"{}\" aria-hidden=\"true\">", kAxisHeight);
  for (double tick : ticks) {
    const double x = 100 * (tick - low) / (high - low);
    if (x < 3 || x > 97) continue;  // would be cut off
    svg += fmt::format("<text x=\"{:.2f}%\" y=\"14\">{:.{}f}</text>", x, tick / format.factor(),
                       decimals);
  }
  return fmt::format(
      "<div class=\"row-label unit\">time [{}]</div>\n<div "
      "class=\"timed\"><span></span>{}</svg></div>\n",
      format.unit(), svg);
}

}  // namespace

std::string html_time_charts(const SceneRecord& scene) {
  if (!scene.reference.box || scene.reference.box->series.time.size() < 2) return {};
  const BoxSeries& series = scene.reference.box->series;
  const Strip strips[] = {
      {"all.height", "H, height of the centre of mass over its height at rest", &series.height},
      {"all.kinetic_energy", "K, energy of translation of a body", &series.kinetic_energy},
      {"all.rotational_energy", "R, energy of rotation of a body", &series.rotational_energy},
      {"all.collision_rate", "collisions of two bodies in a second", &series.collision_rate},
  };
  std::string html = "<h3>Over time</h3>\n";
  html += html_paragraph("faint", "",
                         "What the reference shows at each sample; the line is the mean, the "
                         "shaded band holds the mean "
                         "of an endless run with 95 %.");
  html += "<figure class=\"chart\"><div class=\"strips\">\n";
  for (const Strip& strip : strips) {
    const bool is_zero = std::ranges::all_of(*strip.values, [](double v) { return v == 0; });
    if (!is_zero) html += TimeStrip(scene, strip).html();
  }
  html += time_axis(series.time) + "</div><figcaption>";
  return html + escaped(sampling_summary(*scene.reference.box)) + ".</figcaption></figure>\n";
}

}  // namespace slipcheck
