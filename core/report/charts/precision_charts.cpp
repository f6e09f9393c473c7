#include "report/charts/precision_charts.h"

#include <fmt/format.h>

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

constexpr std::array kInks = {Ink::vermilion, Ink::blue,   Ink::green,
                              Ink::purple,    Ink::orange, Ink::sky};
constexpr std::array kMarkers = {Marker::circle, Marker::square, Marker::triangle, Marker::diamond};

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

bool has_point(const Curve& curve) {
  for (std::size_t k = 0; k < curve.x.size(); ++k)
    if (std::isfinite(curve.x[k]) && std::isfinite(curve.y[k])) return true;
  return false;
}

/// The worst error of all phases, on the floor where it is less.
double drawn_error(const WorkPrecision& point, const std::string& quantity) {
  const PhaseErrors* errors = errors_of(point, quantity);
  if (!errors || !std::isfinite(errors->worst)) return kNotObserved;
  return std::max(errors->worst, kErrorFloor);
}

Curve curve_of(const MethodCurve& method, const std::string& quantity, const Look& look,
               Abscissa abscissa) {
  Curve curve{plot_literal(label_of(method)), look, {}, {}};
  for (const WorkPrecision& point : method.points) {
    curve.x.push_back(abscissa(method, point));
    curve.y.push_back(drawn_error(point, quantity));
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
void add_tolerance(LineChart& chart, const PrecisionScene& scene, const std::string& quantity) {
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

LineChart chart_of(const PrecisionScene& scene, const std::string& quantity,
                   const std::map<std::string, Look>& looks, Abscissa abscissa) {
  LineChart chart;
  for (const MethodCurve& method : scene.curves) {
    if (!is_main_curve(method, quantity)) continue;
    Look look = looks.at(label_of(method));
    Curve curve = curve_of(method, quantity, look, abscissa);
    if (has_point(curve)) chart.curves.push_back(std::move(curve));
  }
  chart.y = error_axis(scene, quantity, chart.curves);
  add_tolerance(chart, scene, quantity);
  return chart;
}

std::string caption_of(const PrecisionScene& scene) {
  std::string caption =
      "Left: the worst error of all phases against CPU time for a second of simulated time; down "
      "and left is better. Right: against the step; a level line does not converge. Full lines: "
      "double precision and the reference's solvers, dashed: single.";
  bool has_floor = false;
  for (const MethodCurve& curve : scene.curves)
    for (const WorkPrecision& point : curve.points)
      for (const auto& [name, errors] : point.errors) has_floor |= errors.worst <= kErrorFloor;
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
      look = {kInks[k % kInks.size()],
              curve.iterations              ? Line::dotted
              : curve.precision == "single" ? Line::dashed
                                            : Line::solid,
              kMarkers[k % kMarkers.size()]};
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

std::vector<Panel> precision_panels(const PrecisionScene& scene, const std::string& quantity,
                                    const std::map<std::string, Look>& looks) {
  LineChart work = chart_of(scene, quantity, looks, cpu_time);
  work.title = plot_literal(quantity);
  work.x = {"CPU time for a simulated second [s]", true};
  if (Curve front = front_of(scene, quantity); has_point(front))
    work.curves.push_back(std::move(front));
  LineChart step = chart_of(scene, quantity, looks, step_of);
  step.title = plot_literal(quantity);
  step.x = {"step [s]", true};
  return {std::move(work), std::move(step)};
}

std::vector<FigureOnPage> precision_charts(const std::vector<PrecisionScene>& scenes) {
  const std::map<std::string, Look> looks = method_looks(scenes);
  std::set<std::string> taken;
  std::vector<FigureOnPage> figures;
  for (const PrecisionScene& scene : scenes) {
    FigureDrawing drawing;
    for (const std::string& quantity : drawn_quantities(scene))
      for (Panel& panel : precision_panels(scene, quantity, looks))
        drawing.panels.push_back(std::move(panel));
    FigureOnPage figure;
    figure.name = file_stem("precision-" + scene.scenario.name, taken);
    figure.title = plot_literal(scene.scenario.name);
    figure.caption = caption_of(scene);
    figure.svg =
        figure_svg(drawing, figure.name, "Error against run time: " + figure.title, figure.caption);
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace slipcheck
