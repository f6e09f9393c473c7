#include "report/rows/precision_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "report/rows/comparison_rows.h"
#include "report/rows/quantity.h"
#include "report/rows/selection.h"
#include "report/terminal/text.h"
#include "scenario/observable_key.h"

namespace slipcheck {
namespace {

bool is_restitution(const std::string& name) {
  const ObservableKey key = observable_key(name);
  return key.observable == "effective_restitution" && !key.owner.empty();
}

/// Effective restitution first, the others in their order.
std::vector<std::string> in_order(const std::set<std::string>& names) {
  std::vector<std::string> result(names.begin(), names.end());
  std::stable_partition(result.begin(), result.end(), is_restitution);
  return result;
}

template <class Visit>
void for_each_error(const PrecisionScene& scene, Visit visit) {
  for (const MethodCurve& curve : scene.curves)
    for (const WorkPrecision& point : curve.points)
      for (const auto& [name, errors] : point.errors) visit(name, errors);
}

/// The worst of a curve's kinds in these quantities.
Convergence::Kind worst_kind(const MethodCurve& curve, const std::vector<std::string>& names) {
  using Kind = Convergence::Kind;
  std::set<Kind> kinds;
  for (const std::string& name : names) {
    const auto found = curve.convergence.find(name);
    kinds.insert(found == curve.convergence.end() ? Kind::unknown : found->second.kind);
  }
  for (const Kind kind : {Kind::does_not_converge, Kind::unknown, Kind::converges, Kind::exact})
    if (kinds.contains(kind)) return kind;
  return Kind::unknown;
}

}  // namespace

std::vector<std::string> judged_quantities(const PrecisionScene& scene) {
  std::set<std::string> judged, all;
  for_each_error(scene, [&](const std::string& name, const PhaseErrors& errors) {
    if (name == kTrajectory) return;
    all.insert(name);
    if (errors.tolerance) judged.insert(name);
  });
  return in_order(judged.empty() ? all : judged);
}

std::vector<std::string> shown_quantities(const PrecisionScene& scene, bool all) {
  std::vector<std::string> result = judged_quantities(scene);
  std::set<std::string> others;
  bool has_trajectory = false;
  for_each_error(scene, [&](const std::string& name, const PhaseErrors&) {
    if (name == kTrajectory)
      has_trajectory = true;
    else if (std::find(result.begin(), result.end(), name) == result.end())
      others.insert(name);
  });
  if (!all && !result.empty()) result.resize(1);
  if (has_trajectory) result.emplace_back(kTrajectory);
  if (all) result.insert(result.end(), others.begin(), others.end());
  return result;
}

const PhaseErrors* errors_of(const WorkPrecision& point, const std::string& quantity) {
  const auto found = point.errors.find(quantity);
  return found == point.errors.end() ? nullptr : &found->second;
}

const Dimension& error_dimension(const PrecisionScene& scene, const std::string& quantity) {
  bool absolute = false;
  for_each_error(scene, [&](const std::string& name, const PhaseErrors& errors) {
    absolute |= name == quantity && errors.absolute;
  });
  if (!absolute) return kPureNumber;
  return quantity == kTrajectory ? kLength : dimension_of(quantity);
}

std::string short_number(double value) {
  if (!std::isfinite(value)) return plain_number(value);
  std::string text = fmt::format("{:.2g}", value);
  // "1e-07" as "1e-7", "1e+05" as "1e5".
  if (const std::size_t e = text.find('e'); e != std::string::npos) {
    std::string digits = text.substr(e + 2);
    digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size() - 1));
    text = fmt::format("{}{}{}", text.substr(0, e + 1), text[e + 1] == '-' ? "-" : "", digits);
  }
  return text;
}

std::string short_error(double error, const Dimension& dimension) {
  if (dimension.si[0] == '\0' || !std::isfinite(error)) return short_number(error);
  const QuantityFormat format(error, dimension, 2);
  const double value = error / format.factor();
  // Two digits of what is read best in full: "160 µs" rather than "1.6e2 µs".
  const std::string number = value >= 100 && value < 1000
                                 ? fmt::format("{:.0f}", 10 * std::round(value / 10))
                                 : short_number(value);
  return fmt::format("{} {}", number, format.unit());
}

std::string knob_text(MethodCurve::Kind kind, double knob) {
  switch (kind) {
    case MethodCurve::Kind::engine:
      return fmt::format("{:g} Hz", knob);
    case MethodCurve::Kind::contact:
      return short_number(knob);
    case MethodCurve::Kind::fixed_step:
      return short_error(knob, kTime);
    case MethodCurve::Kind::event:
      break;
  }
  return {};
}

std::string from_to(const std::string& first, const std::string& last) {
  return first == last ? first : fmt::format("{} → {}", first, last);
}

Cell cost_cell(const MethodCurve& curve, double WorkCost::*cost, Tone tone) {
  Cell cell{"–", tone};
  std::string first;
  for (const WorkPrecision& point : curve.points) {
    if (!point.cost) continue;
    const double time = (*point.cost).*cost;
    if (first.empty()) {
      first = short_error(time, kTime);
      cell.value = time;
    }
    cell.text = from_to(first, short_error(time, kTime));
  }
  return cell;
}

Tone tone_of(Convergence::Kind kind) {
  if (kind == Convergence::Kind::does_not_converge) return Tone::bad;
  return kind == Convergence::Kind::unknown ? Tone::faint : Tone::good;
}

bool is_on_front(const MethodCurve& curve, const std::string& quantity) {
  return std::any_of(curve.points.begin(), curve.points.end(),
                     [&](const WorkPrecision& point) { return point.pareto.contains(quantity); });
}

bool has_run(const MethodCurve& curve) {
  return std::ranges::any_of(
      curve.points, [](const WorkPrecision& point) { return point.status == RunStatus::ok; });
}

bool is_main_curve(const MethodCurve& curve, const std::string& quantity) {
  return !curve.iterations || is_on_front(curve, quantity);
}

std::vector<std::string> troubles_of(const MethodCurve& curve) {
  std::vector<std::string> result;
  std::set<std::string> known;
  const auto add = [&](const WorkPrecision& point, const std::string& trouble) {
    if (!known.insert(trouble).second) return;
    const std::string at = point.knob > 0 ? knob_text(curve.kind, point.knob) : "";
    result.push_back(at.empty() ? trouble : fmt::format("{}: {}", at, trouble));
  };
  for (const WorkPrecision& point : curve.points) {
    const std::string reason = printable(point.reason);
    if (point.status != RunStatus::ok)
      add(point,
          fmt::format("{}{}{}", status_text(point.status), reason.empty() ? "" : ": ", reason));
    else if (!reason.empty())
      add(point, reason);
  }
  return result;
}

std::vector<ConvergenceCounts> convergence_counts(const std::vector<PrecisionScene>& scenes) {
  std::vector<ConvergenceCounts> result;
  for (const PrecisionScene& scene : scenes) {
    std::vector<std::string> judged = judged_quantities(scene);
    if (!judged.empty() && is_restitution(judged.front()))
      std::erase_if(judged, [](const std::string& name) { return !is_restitution(name); });
    for (const MethodCurve& curve : scene.curves) {
      const std::string label = label_of(curve);
      auto counts = std::find_if(result.begin(), result.end(),
                                 [&](const ConvergenceCounts& c) { return c.method == label; });
      if (counts == result.end())
        counts = result.insert(result.end(), {label, curve.iterations.has_value(), {}, {}, 0});
      ++counts->judged[static_cast<std::size_t>(worst_kind(curve, judged))];
      ++counts->trajectory[static_cast<std::size_t>(worst_kind(curve, {kTrajectory}))];
      const auto best = [](const WorkPrecision& point) { return !point.pareto.empty(); };
      counts->on_front += std::any_of(curve.points.begin(), curve.points.end(), best);
    }
  }
  return result;
}

TextTable convergence_table(const std::vector<ConvergenceCounts>& methods) {
  TextTable table{{{"method"}}, {}, "Convergence over all scenes"};
  for (const char* exact : {"judged: exact", "trajectory: exact"})
    for (const char* kind : {exact, "converges", "does not", "not known"})
      table.columns.push_back({kind, true});
  table.columns.push_back({"◆", true, 1});
  for (const ConvergenceCounts& counts : methods) {
    std::vector<Cell>& row = table.rows.emplace_back(1, Cell{counts.method});
    for (const auto& kinds : {counts.judged, counts.trajectory})
      for (std::size_t k = 0; k < kinds.size(); ++k)
        row.push_back(count_cell(kinds[k], tone_of(static_cast<Convergence::Kind>(k))));
    row.push_back(count_cell(counts.on_front, Tone::strong));
  }
  return table;
}

}  // namespace slipcheck
