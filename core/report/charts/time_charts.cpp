#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "harness/observe/motion_quantities.h"
#include "report/charts/plot_text.h"
#include "report/charts/scene_charts.h"
#include "report/files/file_stem.h"
#include "report/rows/comparison_rows.h"
#include "report/rows/findings.h"
#include "report/rows/quantity.h"
#include "scenario/observable_names.h"

namespace slipcheck {
namespace {

constexpr std::size_t kMostBodies = 4;  // of a motion
constexpr std::array kLineOfBody = {Line::solid, Line::dashed, Line::dotted, Line::dash_dot};
constexpr std::size_t kMarks = 9;          // along a line
constexpr std::size_t kMostColumns = 300;  // of a series; each keeps its lowest and highest sample

std::string unit_text(const QuantityFormat& format) {
  return format.unit().empty() ? "" : " [" + format.unit() + "]";
}

std::string time_label(const QuantityFormat& time) { return "time" + unit_text(time); }

std::vector<double> in_units(std::vector<double> values, const QuantityFormat& format) {
  for (double& value : values) value /= format.factor();
  return values;
}

/// The largest of the finite ones; 0 if there is none.
double largest_of(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
}

/// The reference's motion, then of each engine's run the phase in the middle.
struct DrawnMotion {
  std::string label;
  const RecordedMotion* motion;
  Look look;
};

std::vector<DrawnMotion> drawn_motions(const SceneRecord& scene) {
  std::vector<DrawnMotion> drawn;
  if (scene.reference.motion) drawn.push_back({"reference", &*scene.reference.motion, {}});
  for (std::size_t k = 0; k < scene.runs.size(); ++k)
    for (const RecordedMotion& motion : scene.runs[k].motions)
      if (motion.role == "median" || scene.runs[k].motions.size() == 1) {
        drawn.push_back({plot_literal(run_label(scene.runs[k])), &motion, look_of_run(k)});
        break;
      }
  return drawn;
}

/// A quantity of each body over time.
struct Seen {
  const DrawnMotion* drawn;
  std::size_t body;
  std::vector<double> values;  // [SI], by frame
};

/// Of what left the scene the axis shows little.
Panel over_time(const std::string& label, const Dimension& dimension, const std::vector<Seen>& all,
                const QuantityFormat& time) {
  double truth = 0, most = 0;
  for (const Seen& seen : all) {
    const double largest = largest_of(seen.values);
    most = std::max(most, largest);
    if (seen.drawn->label == "reference") truth = std::max(truth, largest);
  }
  // The slip of what rolls is rounding.
  if (truth < 1e-6 * most) truth = 0;
  const QuantityFormat format(truth > 0 ? truth : most, dimension);
  Panel panel{"", {"", false, 0.0}, {label + unit_text(format), false, 0.0}};
  if (truth > 0 && most > 3.2 * truth) panel.y.high = 1.6 * truth / format.factor();
  for (const Seen& seen : all) {
    std::vector<double> x;
    for (const MotionFrame& frame : seen.drawn->motion->frames)
      x.push_back(frame.time / time.factor());
    Curve curve{seen.body == 0 ? seen.drawn->label : "", seen.drawn->look, std::move(x),
                in_units(seen.values, format)};
    curve.look.line = kLineOfBody[seen.body];
    curve.marker_every = std::max<std::size_t>(1, curve.x.size() / kMarks);
    if (has_point(curve)) panel.curves.push_back(std::move(curve));
  }
  return panel;
}

/// The samples that are drawn: all, or of each column the lowest and the highest.
std::vector<std::size_t> drawn_samples(const std::vector<double>& values) {
  const std::size_t width = std::max<std::size_t>(1, values.size() / kMostColumns);
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < values.size(); k += width) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(k);
    const auto end =
        values.begin() + static_cast<std::ptrdiff_t>(std::min(k + width, values.size()));
    const auto [low, high] = std::minmax_element(begin, end);
    const auto a = static_cast<std::size_t>(std::min(low, high) - values.begin());
    const auto b = static_cast<std::size_t>(std::max(low, high) - values.begin());
    result.push_back(a);
    if (b != a) result.push_back(b);
  }
  return result;
}

/// One quantity of a box, its samples before `averaged` in grey.
Panel strip_of(const SceneRecord& scene, const char* observable, const std::string& title,
               const std::vector<double>& values, std::size_t averaged, const QuantityFormat& time,
               std::string& caption) {
  const std::vector<double>& times = scene.reference.box->series.time;
  const QuantityFormat format = format_for(scene, observable, nullptr);
  Panel panel{title,
              {"", false, times.front() / time.factor(), times.back() / time.factor()},
              {title.substr(0, title.find(',')) + unit_text(format)}};
  Curve before{"not averaged", {Ink::grey, Line::solid}, {}, {}};
  Curve after{"averaged", {Ink::blue, Line::solid}, {}, {}};
  for (const std::size_t k : drawn_samples(values)) {
    const double x = times[k] / time.factor(), y = values[k] / format.factor();
    // Both lines meet.
    if (k <= averaged || after.x.empty()) before.x.push_back(x), before.y.push_back(y);
    if (k >= averaged) after.x.push_back(x), after.y.push_back(y);
  }
  if (averaged > 0) panel.curves.push_back(std::move(before));
  panel.curves.push_back(std::move(after));
  const auto found = scene.reference.observables.find(observable);
  if (found == scene.reference.observables.end() || !std::isfinite(found->second.value))
    return panel;
  const double mean = found->second.value / format.factor();
  const double error = found->second.uncertainty / format.factor();
  const double from = times[averaged] / time.factor(), to = times.back() / time.factor();
  panel.curves.push_back({"mean", {Ink::black, Line::solid}, {from, to}, {mean, mean}});
  if (std::isfinite(error))
    panel.bands.push_back({"its 95 % interval", from, to, mean - error, mean + error});
  caption += fmt::format("{}{}: mean {}{}", caption.empty() ? "" : "; ", observable,
                         format.text(found->second.value),
                         std::isfinite(error) ? fmt::format(" ± {:.2g}", error) : "");
  return panel;
}

}  // namespace

bool fits_scene(const Scene& scene, const RecordedMotion& motion) {
  return !motion.frames.empty() && std::ranges::all_of(motion.frames, [&](const auto& frame) {
    return frame.bodies.size() == scene.bodies.size();
  });
}

std::optional<Chart> motion_chart(const SceneRecord& scene, std::set<std::string>& taken) {
  if (!scene.scene) return std::nullopt;
  const Scene& hard = scene.scene->hard;
  std::vector<DrawnMotion> motions = drawn_motions(scene);
  std::erase_if(motions,
                [&](const DrawnMotion& drawn) { return !fits_scene(hard, *drawn.motion); });
  if (motions.empty()) return std::nullopt;
  std::vector<Seen> slip, speed, energy;
  double end = 0;
  for (const DrawnMotion& drawn : motions) {
    const MotionQuantities seen = motion_quantities(hard, *drawn.motion);
    const std::size_t frames = drawn.motion->frames.size();
    end = std::max(end, drawn.motion->frames.back().time);
    for (std::size_t body = 0; body < std::min(hard.bodies.size(), kMostBodies); ++body) {
      std::vector<double> slips, speeds;
      for (std::size_t frame = 0; frame < frames; ++frame) {
        slips.push_back(seen.slip[frame][body].norm());
        speeds.push_back(seen.speed[frame][body]);
      }
      slip.push_back({&drawn, body, std::move(slips)});
      speed.push_back({&drawn, body, std::move(speeds)});
    }
    energy.push_back({&drawn, 0, seen.kinetic_energy});
  }
  const QuantityFormat time(end, kTime);
  Chart chart{file_stem("motion-" + scene.scenario.name, taken),
              plot_literal(scene.scenario.name) + " over time",
              "Black: the reference; the others: of each run the phase in the middle.",
              {},
              1,
              150};
  for (const auto& [label, dimension, all] :
       {std::tuple("slip velocity", kVelocity, &slip), std::tuple("speed", kVelocity, &speed),
        std::tuple("kinetic energy", kEnergy, &energy)}) {
    Panel panel = over_time(label, dimension, *all, time);
    if (!panel.curves.empty()) chart.panels.push_back(std::move(panel));
  }
  if (chart.panels.empty()) return std::nullopt;
  chart.panels.front().title = plot_literal(scene.scenario.name);
  for (std::size_t body = 0; body < std::min(hard.bodies.size(), kMostBodies); ++body)
    if (hard.bodies.size() > 1)
      chart.panels.front().curves.push_back(
          {plot_literal(scene.scenario.bodies[body].name), {Ink::grey, kLineOfBody[body]}, {}, {}});
  chart.panels.back().x.label = time_label(time);
  // An engine that stops far too late must not press the rest together.
  const auto& truth = scene.reference.motion;
  if (truth && !truth->frames.empty()) end = std::min(end, 1.4 * truth->frames.back().time);
  for (Panel& panel : chart.panels) panel.x.high = end / time.factor();
  return chart;
}

std::optional<Chart> series_chart(const SceneRecord& scene, std::set<std::string>& taken) {
  if (!scene.reference.box || scene.reference.box->series.time.size() < 2) return std::nullopt;
  const BoxReference& box = *scene.reference.box;
  const QuantityFormat time(box.series.time.back(), kTime);
  const std::size_t count = box.series.time.size();
  const std::size_t averaged = std::min(count - std::min(box.samples, count), count - 1);
  Chart chart{"", plot_literal(scene.scenario.name) + " over time", "", {}, 1, 110};
  const auto add = [&](const char* observable, const char* title,
                       const std::vector<double>& values) {
    if (std::ranges::any_of(values, [](double value) { return value != 0; }))
      chart.panels.push_back(
          strip_of(scene, observable, title, values, averaged, time, chart.caption));
  };
  add("all.height", "H, height of the centre of mass over its height at rest", box.series.height);
  add("all.kinetic_energy", "K, energy of translation of a body", box.series.kinetic_energy);
  add("all.rotational_energy", "R, energy of rotation of a body", box.series.rotational_energy);
  add("all.collision_rate", "collisions, of two bodies in a second", box.series.collision_rate);
  if (chart.panels.empty()) return std::nullopt;
  chart.name = file_stem("series-" + scene.scenario.name, taken);
  chart.panels.back().x.label = time_label(time);
  chart.caption = plot_literal(chart.caption);
  return chart;
}

}  // namespace slipcheck
