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

/// From the coarsest to the finest, "0.14 → 0.14".
std::string from_to(const std::string& first, const std::string& last) {
  return first == last ? first : fmt::format("{} → {}", first, last);
}

/// The first or the last point of a curve that has what is asked for.
template <class Has>
const WorkPrecision* end_of(const MethodCurve& curve, bool last, Has has) {
  if (last) {
    const auto found = std::find_if(curve.points.rbegin(), curve.points.rend(), has);
    return found == curve.points.rend() ? nullptr : &*found;
  }
  const auto found = std::find_if(curve.points.begin(), curve.points.end(), has);
  return found == curve.points.end() ? nullptr : &*found;
}

std::string errors_text(const MethodCurve& curve, const std::string& quantity,
                        const Dimension& dimension) {
  const auto has = [&](const WorkPrecision& point) {
    const PhaseErrors* errors = errors_of(point, quantity);
    return errors && std::isfinite(errors->worst);
  };
  const WorkPrecision* first = end_of(curve, false, has);
  if (!first) return "–";
  const auto text = [&](const WorkPrecision& point) {
    return short_error(errors_of(point, quantity)->worst, dimension);
  };
  if (curve.points.size() == 1) return text(*first);
  return fmt::format("{} → {}", text(*first), text(*end_of(curve, true, has)));
}

std::string cost_text(const MethodCurve& curve, double WorkCost::*cost) {
  const auto has = [](const WorkPrecision& point) { return point.cost.has_value(); };
  const WorkPrecision* first = end_of(curve, false, has);
  if (!first) return "–";
  return from_to(short_error((*first->cost).*cost, kTime),
                 short_error((*end_of(curve, true, has)->cost).*cost, kTime));
}

/// The largest spread of the times.
std::string spread_text(const MethodCurve& curve) {
  double spread = kNotObserved;
  for (const WorkPrecision& point : curve.points)
    if (point.cost) spread = std::fmax(spread, point.cost->spread);
  return std::isnan(spread) ? "–" : fmt::format("{:.0f} %", 100 * spread);
}

Tone ink_of(Convergence::Kind kind) {
  switch (kind) {
    case Convergence::Kind::exact:
    case Convergence::Kind::converges:
      return Tone::good;
    case Convergence::Kind::does_not_converge:
      return Tone::bad;
    case Convergence::Kind::unknown:
      break;
  }
  return Tone::faint;
}

Cell convergence_cell(const MethodCurve& curve, const std::string& quantity) {
  const auto found = curve.convergence.find(quantity);
  if (found == curve.convergence.end()) return {"–", Tone::faint};
  return {words_of(found->second), ink_of(found->second.kind)};
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
  std::vector<std::vector<Cell>> rows;
  std::size_t left_out = 0;
  for (const MethodCurve& curve : scene.curves) {
    if (!has_run(curve)) continue;  // said below
    if (!style.all_observables && !is_main_curve(curve, quantity)) {
      ++left_out;
      continue;
    }
    rows.push_back({{printable(label_of(curve))},
                    {errors_text(curve, quantity, dimension)},
                    convergence_cell(curve, quantity),
                    {cost_text(curve, &WorkCost::per_step), Tone::faint},
                    {cost_text(curve, &WorkCost::per_simulated_second)},
                    {spread_text(curve), Tone::faint},
                    {is_on_front(curve, quantity) ? "◆" : "", Tone::strong}});
  }
  std::string text = fmt::format(
      "\n  {}\n", inked(printable(quantity_head(scene, quantity)), Tone::strong, style));
  text += aligned({{"method"},
                   {"worst error"},
                   {"convergence"},
                   {"CPU/step", true, 2},
                   {"CPU/simulated s", true, 1},
                   {"spread", true, 3},
                   {""}},
                  std::move(rows), style, 2);
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
  const auto cell = [](std::size_t number, Tone ink) {
    return number > 0 ? Cell{std::to_string(number), ink} : Cell{"·", Tone::faint};
  };
  const auto row = [&](const std::string& method, const std::array<std::size_t, 4>& kinds) {
    return std::vector<Cell>{{printable(method)},
                             cell(kinds[0], Tone::good),
                             cell(kinds[1], Tone::good),
                             cell(kinds[2], Tone::bad),
                             cell(kinds[3], Tone::faint)};
  };
  const std::vector<Column> columns = {
      {"method"}, {"exact", true}, {"converges", true}, {"does not", true}, {"not known", true}};
  std::vector<std::vector<Cell>> judged, trajectory;
  for (const ConvergenceCounts& counts : convergence_counts(scenes)) {
    if (counts.other_iterations && !style.all_observables) continue;
    judged.push_back(row(counts.method, counts.judged));
    judged.back().push_back(cell(counts.on_front, Tone::strong));
    trajectory.push_back(row(counts.method, counts.trajectory));
  }
  std::vector<Column> with_front = columns;
  with_front.push_back({"◆", true, 1});
  const auto head = [&](const std::string& what) {
    return fmt::format(
        "{}: {}\n",
        inked(fmt::format("Of {} scene{}", scenes.size(), scenes.size() == 1 ? "" : "s"),
              Tone::strong, style),
        what);
  };
  return head("effective restitution, or the worst of what has a tolerance") +
         aligned(with_front, std::move(judged), style, 2) + "\n" + head("the trajectory") +
         aligned(columns, std::move(trajectory), style, 2) +
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
