#include "report/terminal/precision_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "report/rows/comparison_rows.h"
#include "report/rows/precision_rows.h"
#include "report/rows/quantity.h"
#include "report/rows/selection.h"
#include "report/terminal/text.h"

namespace slipcheck {
namespace {

std::string errors_text(const MethodCurve& curve, const std::string& quantity,
                        const Dimension& dimension) {
  std::string first, last;
  for (const WorkPrecision& point : curve.points) {
    const PhaseErrors* errors = errors_of(point, quantity);
    if (!errors || !std::isfinite(errors->worst)) continue;
    last = short_error(errors->worst, dimension);
    if (first.empty()) first = last;
  }
  if (first.empty()) return "–";
  return curve.points.size() == 1 ? first : fmt::format("{} → {}", first, last);
}

/// The largest spread of the times.
std::string spread_text(const MethodCurve& curve) {
  double spread = kNotObserved;
  for (const WorkPrecision& point : curve.points)
    if (point.cost) spread = std::fmax(spread, point.cost->spread);
  return std::isnan(spread) ? "–" : fmt::format("{:.0f} %", 100 * spread);
}

Cell convergence_cell(const MethodCurve& curve, const std::string& quantity) {
  const auto found = curve.convergence.find(quantity);
  if (found == curve.convergence.end()) return {"–", Tone::faint};
  return {words_of(found->second), tone_of(found->second.kind)};
}

/// "i-j.effective_restitution, tolerance 0.005"
std::string quantity_head(const PrecisionScene& scene, const std::string& quantity) {
  for (const MethodCurve& curve : scene.curves)
    for (const WorkPrecision& point : curve.points)
      if (const PhaseErrors* errors = errors_of(point, quantity); errors && errors->tolerance)
        return fmt::format(
            "{}, tolerance {}", quantity,
            tolerance_text(*errors->tolerance, errors->absolute, dimension_of(quantity)));
  if (quantity == kTrajectory)
    return scene.path_length > 0 ? fmt::format("trajectory, of a path of {}",
                                               slipcheck::quantity(scene.path_length, kLength, 3))
                                 : "trajectory, nothing moves";
  return quantity;
}

std::string quantity_block(const PrecisionScene& scene, const std::string& quantity,
                           const TableStyle& style) {
  const Dimension& dimension = error_dimension(scene, quantity);
  TextTable table{{{"method"},
                   {"worst error"},
                   {"convergence"},
                   {"CPU/step", true, 2},
                   {"CPU/simulated s", true, 1},
                   {"spread", true, 3},
                   {""}}};
  std::size_t left_out = 0;
  for (const MethodCurve& curve : scene.curves) {
    if (!has_run(curve)) continue;  // said below
    if (!style.all_observables && !is_main_curve(curve, quantity)) {
      ++left_out;
      continue;
    }
    table.rows.push_back({{label_of(curve)},
                          {errors_text(curve, quantity, dimension)},
                          convergence_cell(curve, quantity),
                          cost_cell(curve, &WorkCost::per_step, Tone::faint),
                          cost_cell(curve, &WorkCost::per_simulated_second),
                          {spread_text(curve), Tone::faint},
                          {is_on_front(curve, quantity) ? "◆" : "", Tone::strong}});
  }
  std::string text = fmt::format(
      "\n  {}\n", inked(printable(quantity_head(scene, quantity)), Tone::strong, style));
  text += terminal_table(std::move(table), style, 2);
  if (left_out > 0)
    text +=
        paragraph("… ", fmt::format("{} with other iterations, none better and cheaper", left_out),
                  Tone::faint, style);
  return text;
}

/// "bullet 60 … 16000 Hz, contact 0.001 … 1e-12": what the errors go along.
std::string knobs_text(const PrecisionScene& scene) {
  std::vector<std::string> parts;
  std::set<std::string> known;
  for (const MethodCurve& curve : scene.curves) {
    if (!has_run(curve) || curve.kind == MethodCurve::Kind::event) continue;
    const std::string name =
        curve.kind == MethodCurve::Kind::engine ? curve.engine : label_of(curve);
    const std::string what = curve.kind == MethodCurve::Kind::contact      ? " at a tolerance of"
                             : curve.kind == MethodCurve::Kind::fixed_step ? " at steps of"
                                                                           : "";
    if (known.insert(name).second)
      parts.push_back(fmt::format("{}{} {}", name, what,
                                  from_to(knob_text(curve.kind, curve.points.front().knob),
                                          knob_text(curve.kind, curve.points.back().knob))));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string scene_block(const PrecisionScene& scene, const TableStyle& style) {
  std::size_t phases = 0;
  for (const MethodCurve& curve : scene.curves)
    for (const WorkPrecision& point : curve.points) phases = std::max(phases, point.phases);
  std::string text = inked(printable(scene.scenario.name), Tone::strong, style);
  text += fmt::format("  {} of simulated time, worst of up to {} phases\n",
                      slipcheck::quantity(scene.simulated, kTime, 3), phases);
  if (!scene.scenario.title.empty())
    text += paragraph("", scene.scenario.title, Tone::plain, style);
  text += paragraph("", knobs_text(scene), Tone::faint, style);
  for (const std::string& quantity : shown_quantities(scene, style.all_observables))
    text += quantity_block(scene, quantity, style);
  std::string troubles;
  for (const MethodCurve& curve : scene.curves)
    for (const std::string& trouble : troubles_of(curve))
      troubles += paragraph("! " + printable(label_of(curve)) + ": ", trouble, Tone::bad, style);
  return text + (troubles.empty() ? "" : "\n" + troubles) + "\n";
}

std::string summary(const std::vector<PrecisionScene>& scenes, const TableStyle& style) {
  std::vector<ConvergenceCounts> methods = convergence_counts(scenes);
  if (!style.all_observables) std::erase_if(methods, &ConvergenceCounts::other_iterations);
  const TextTable all = convergence_table(methods);
  TextTable judged = all.with({0, 1, 2, 3, 4, 9}), trajectory = all.with({0, 5, 6, 7, 8});
  judged.columns[1].header = trajectory.columns[1].header = "exact";
  const auto head = [&](const std::string& what) {
    return fmt::format("{}: {}\n",
                       inked("Of " + counted(scenes.size(), "scene"), Tone::strong, style), what);
  };
  return head("effective restitution, or the worst of what has a tolerance") +
         terminal_table(std::move(judged), style, 2) + "\n" + head("the trajectory") +
         terminal_table(std::move(trajectory), style, 2) +
         paragraph("◆ ",
                   "no other engine (or solver of the reference) is cheaper and no worse, in some "
                   "quantity at some setting",
                   Tone::faint, style);
}

}  // namespace

std::string precision_table(const std::vector<PrecisionScene>& scenes, const TableStyle& style) {
  std::string text;
  for (const PrecisionScene& scene : scenes) text += scene_block(scene, style);
  return scenes.size() < 2 ? text : text + summary(scenes, style);
}

}  // namespace slipcheck
