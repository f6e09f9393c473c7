#include "report/charts/precision_charts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "report/charts/plot_text.h"
#include "report/files/file_stem.h"
#include "report/rows/precision_rows.h"
#include "report/rows/selection.h"
#include "scenario/observable_key.h"

namespace slipcheck {
namespace {

constexpr std::size_t kMostQuantities = 2;  // beside the trajectory
constexpr double kErrorCeiling = 1e4;       // what is worse has left the scene

/// What of a curve goes along an axis; NaN where it has none.
using Abscissa = double (*)(const MethodCurve&, const WorkPrecision&);

double cpu_time(const MethodCurve&, const WorkPrecision& point) {
  return point.cost ? point.cost->per_simulated_second : kNotObserved;
}

double step_of(const MethodCurve& curve, const WorkPrecision& point) {
  switch (curve.kind) {
    case MethodCurve::Kind::engine:
      return 1 / point.knob;
    case MethodCurve::Kind::fixed_step:
      return point.knob;
    case MethodCurve::Kind::contact:
    case MethodCurve::Kind::event:
      break;
  }
  return kNotObserved;
}

/// The worst error of all phases, on the floor where it is less.
double drawn_error(const WorkPrecision& point, const std::string& quantity) {
  const PhaseErrors* errors = errors_of(point, quantity);
  if (!errors || !std::isfinite(errors->worst)) return kNotObserved;
  return std::max(errors->worst, kErrorFloor);
}

/// What a point is, and its errors in all quantities that are drawn, this one first.
std::string note_of(const PrecisionScene& scene, const MethodCurve& method,
                    const WorkPrecision& point, const std::string& quantity) {
  std::vector<std::string> lines;
  std::string setting = knob_text(method.kind, point.knob);
  if (method.iterations) setting += fmt::format(", {:g} iterations", *method.iterations);
  if (!setting.empty()) lines.push_back(setting);
  if (point.cost) {
    lines.push_back(fmt::format("CPU {:.3g} s per simulated s", point.cost->per_simulated_second));
    if (std::isfinite(point.cost->spread))
      lines.back() += fmt::format(" ± {:.2g} %", 100 * point.cost->spread);
  }
  const auto tell = [&](const std::string& name) {
    const PhaseErrors* errors = errors_of(point, name);
    const std::string unit = error_dimension(scene, name).si;
    const std::string value = !errors || !std::isfinite(errors->worst) ? "–"
                              : errors->worst == 0                     ? "exact"
                                                   : fmt::format("{:.3g} {}", errors->worst, unit);
    lines.push_back(fmt::format("worst error of {}: {}", name, value));
  };
  tell(quantity);
  for (const std::string& other : drawn_quantities(scene))
    if (other != quantity) tell(other);
  if (point.pareto.contains(quantity)) lines.emplace_back("nothing is cheaper and no worse");
  return fmt::format("{}", fmt::join(lines, "\n"));
}

Curve curve_of(const PrecisionScene& scene, const MethodCurve& method, const std::string& quantity,
               const Look& look, Abscissa abscissa) {
  Curve curve{plot_literal(label_of(method)), look, {}, {}};
  curve.at_edge = true;
  for (const WorkPrecision& point : method.points) {
    curve.x.push_back(abscissa(method, point));
    curve.y.push_back(drawn_error(point, quantity));
    curve.notes.push_back(note_of(scene, method, point, quantity));
  }
  return curve;
}

Curve front_of(const PrecisionScene& scene, const std::string& quantity) {
  Curve front{"nothing is cheaper and no worse", {Ink::black, Line::none, Marker::ring}, {}, {}};
  for (const MethodCurve& curve : scene.curves)
    for (const WorkPrecision& point : curve.points)
      if (point.pareto.contains(quantity)) {
        front.x.push_back(cpu_time(curve, point));
        front.y.push_back(drawn_error(point, quantity));
      }
  return front;
}

/// A level line at the tolerance, from the first to the last point of the chart.
void add_tolerance(Panel& chart, const PrecisionScene& scene, const std::string& quantity) {
  std::optional<double> tolerance;
  for (const MethodCurve& curve : scene.curves)
    for (const WorkPrecision& point : curve.points)
      if (const PhaseErrors* errors = errors_of(point, quantity); errors && errors->tolerance)
        tolerance = errors->tolerance;
  double low = INFINITY, high = 0;
  for (const Curve& curve : chart.curves)
    for (double x : curve.x)
      if (x > 0 && std::isfinite(x)) {
        low = std::min(low, x);
        high = std::max(high, x);
      }
  if (!tolerance || !(*tolerance > 0) || low > high) return;
  chart.curves.insert(
      chart.curves.begin(),
      {"the scene's tolerance", {Ink::grey, Line::dotted}, {low, high}, {*tolerance, *tolerance}});
}

/// The axis of errors; a run that left the scene does not squeeze the others.
AxisSpec error_axis(const PrecisionScene& scene, const std::string& quantity,
                    const std::vector<Curve>& curves) {
  const Dimension& dimension = error_dimension(scene, quantity);
  AxisSpec axis{fmt::format("worst error [{}]", dimension.si[0] == '\0' ? "-" : dimension.si),
                true};
  double highest = 0;
  for (const Curve& curve : curves)
    for (double y : curve.y)
      if (std::isfinite(y)) highest = std::max(highest, y);
  if (highest > kErrorCeiling) axis.high = kErrorCeiling;
  return axis;
}

Panel panel_of(const PrecisionScene& scene, const std::string& quantity,
               const std::map<std::string, Look>& looks, Abscissa abscissa) {
  Panel chart;
  for (const MethodCurve& method : scene.curves) {
    if (!is_main_curve(method, quantity)) continue;
    Curve curve = curve_of(scene, method, quantity, looks.at(label_of(method)), abscissa);
    if (has_point(curve)) chart.curves.push_back(std::move(curve));
  }
  chart.y = error_axis(scene, quantity, chart.curves);
  add_tolerance(chart, scene, quantity);
  return chart;
}

std::string caption_of(const PrecisionScene& scene, const std::string& quantity) {
  std::string caption =
      "Left: the worst error of all phases against CPU time for a second of simulated time; down "
      "and left is better. Right: against the step; a level line does not converge. Full lines: "
      "double precision and the reference's solvers, dashed: single.";
  bool has_floor = false;
  for (const MethodCurve& curve : scene.curves)
    for (const WorkPrecision& point : curve.points)
      if (const PhaseErrors* errors = errors_of(point, quantity))
        has_floor |= errors->worst <= kErrorFloor;
  if (has_floor)
    caption += fmt::format(" No error at all is drawn at {}.", short_number(kErrorFloor));
  return caption;
}

}  // namespace

std::map<std::string, Look> method_looks(const std::vector<PrecisionScene>& scenes) {
  std::vector<std::pair<std::string, std::string>> profiles;
  std::map<std::string, Look> looks;
  for (const PrecisionScene& scene : scenes)
    for (const MethodCurve& curve : scene.curves) {
      Look& look = looks[label_of(curve)];
      switch (curve.kind) {
        case MethodCurve::Kind::contact:
          look = {Ink::black, Line::solid, Marker::none};
          continue;
        case MethodCurve::Kind::fixed_step:
          look = {Ink::black, Line::dash_dot, Marker::none};
          continue;
        case MethodCurve::Kind::event:
          look = {Ink::black, Line::none, Marker::diamond};
          continue;
        case MethodCurve::Kind::engine:
          break;
      }
      const std::pair profile(curve.engine, curve.profile);
      const auto found = std::find(profiles.begin(), profiles.end(), profile);
      const auto k = static_cast<std::size_t>(found - profiles.begin());
      if (found == profiles.end()) profiles.push_back(profile);
      look = look_of_run(k);
      look.line = curve.iterations              ? Line::dotted
                  : curve.precision == "single" ? Line::dashed
                                                : Line::solid;
    }
  return looks;
}

std::vector<std::string> drawn_quantities(const PrecisionScene& scene) {
  std::vector<std::string> result;
  std::set<std::string> bare;  // twins show the same: "j.sliding_time" beside "i.sliding_time"
  for (const std::string& quantity : judged_quantities(scene))
    if (result.size() < kMostQuantities && bare.insert(observable_key(quantity).bare()).second)
      result.push_back(quantity);
  const std::vector<std::string> shown = shown_quantities(scene, false);
  if (std::find(shown.begin(), shown.end(), kTrajectory) != shown.end())
    result.emplace_back(kTrajectory);
  return result;
}

std::vector<Chart> precision_charts(const PrecisionScene& scene,
                                    const std::map<std::string, Look>& looks,
                                    std::set<std::string>& taken) {
  std::vector<Chart> charts;
  for (const std::string& quantity : drawn_quantities(scene)) {
    Panel work = panel_of(scene, quantity, looks, cpu_time);
    work.title = plot_literal(quantity);
    work.x = {"CPU time for a simulated second [s]", true};
    if (Curve front = front_of(scene, quantity); has_point(front))
      work.curves.push_back(std::move(front));
    Panel step = panel_of(scene, quantity, looks, step_of);
    step.title = work.title;
    step.x = {"step [s]", true};
    if (work.curves.empty() && step.curves.empty()) continue;
    charts.push_back(
        {file_stem(fmt::format("precision-{}-{}", scene.scenario.name, quantity), taken),
         plot_literal(fmt::format("{}, {}", scene.scenario.name, quantity)),
         plot_literal(caption_of(scene, quantity)),
         {std::move(work), std::move(step)}});
  }
  return charts;
}

}  // namespace slipcheck
