#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "report/charts/precision_charts.h"
#include "report/html/page_channel.h"
#include "report/html/page_data_parts.h"
#include "report/rows/outcome_look.h"
#include "report/rows/precision_rows.h"
#include "report/rows/stability_rows.h"
#include "report/terminal/text.h"

namespace slipcheck {

using Json = nlohmann::json;

namespace {

const char* knob_name(MethodCurve::Kind kind) {
  switch (kind) {
    case MethodCurve::Kind::engine:
      return "rate";
    case MethodCurve::Kind::contact:
      return "tolerance";
    case MethodCurve::Kind::fixed_step:
      return "step";
    case MethodCurve::Kind::event:
      break;
  }
  return "";
}

Json optional_number(const std::optional<double>& value) {
  return value ? page_number(*value) : Json();
}

Json point_data(const MethodCurve& curve, const WorkPrecision& point,
                const std::vector<std::string>& quantities) {
  std::string setting = knob_text(curve.kind, point.knob);
  if (curve.iterations) setting += fmt::format(", {:g} iterations", *curve.iterations);
  Json errors = Json::array(), front = Json::array();
  for (const std::string& quantity : quantities) {
    const PhaseErrors* found = errors_of(point, quantity);
    errors.push_back(found ? page_number(found->worst, 5) : Json());
    front.push_back(point.pareto.contains(quantity));
  }
  return {{"setting", setting},
          {"cost", point.cost ? page_number(point.cost->per_simulated_second, 5) : Json()},
          {"spread", point.cost ? page_number(point.cost->spread, 3) : Json()},
          {"errors", std::move(errors)},
          {"front", std::move(front)}};
}

Json map_data(const OutcomeMap& map, std::size_t number) {
  const auto numbers = [](const std::vector<double>& values) {
    Json list = Json::array();
    for (const double value : values) list.push_back(page_number(value, 5));
    return list;
  };
  const auto axis = [&](const OutcomeMap::Axis& each) {
    return Json{{"label", printable(each.label)},
                {"logarithmic", each.logarithmic},
                {"values", numbers(each.values)}};
  };
  Json cells = Json::array(), theory = Json::array();
  for (const Outcome outcome : map.outcome) cells.push_back(static_cast<int>(outcome));
  for (const auto& [x, y] : map.theory) theory.push_back({page_number(x, 5), page_number(y, 5)});
  return {{"id", fmt::format("map-{}", number)},
          {"title", printable(map.title)},
          {"x", axis(map.x)},
          {"y", axis(map.y)},
          {"cells", std::move(cells)},
          {"errors", numbers(map.worst_error)},
          {"error_label", printable(map.error_label)},
          {"theory", std::move(theory)},
          {"theory_name", printable(map.theory_name)}};
}

Json limits_data(const LimitGroup& group, std::size_t number) {
  Json rows = Json::array();
  for (const Limit* limit : group.limits)
    rows.push_back({{"label", printable(label_of(*limit))},
                    {"good", optional_number(limit->good)},
                    {"bad", optional_number(limit->bad)},
                    {"low", page_number(limit->low)},
                    {"high", page_number(limit->high)},
                    {"beyond", limit->bad ? Json(static_cast<int>(limit->beyond)) : Json()},
                    {"theory", optional_number(limit->theory)}});
  const bool is_step =
      group.kind == Limit::Kind::stable_step || group.kind == Limit::Kind::accurate_step;
  return {{"id", fmt::format("limits-{}", number)},
          {"title", printable(fmt::format("{}, {}", words_of(group.kind), group.scene))},
          {"unit", is_step ? "s" : ""},
          {"works", group.kind == Limit::Kind::length_scale ? "above" : "below"},
          {"rows", std::move(rows)}};
}

}  // namespace

Json precision_page_data(const PrecisionScene& scene) {
  const std::vector<std::string> names = drawn_quantities(scene);
  Json quantities = Json::array(), curves = Json::array();
  for (const std::string& name : names) {
    const std::string unit = error_dimension(scene, name).si;
    quantities.push_back(
        {{"name", printable(name)},
         {"label", printable(fmt::format("worst error of {}{}", name,
                                         unit.empty() ? "" : fmt::format(" [{}]", unit)))}});
  }
  for (const MethodCurve& curve : scene.curves) {
    const auto is_main = [&](const std::string& name) { return is_main_curve(curve, name); };
    if (!has_run(curve) || std::ranges::none_of(names, is_main)) continue;
    Json points = Json::array();
    for (const WorkPrecision& point : curve.points)
      if (point.status == RunStatus::ok) points.push_back(point_data(curve, point, names));
    curves.push_back({{"label", printable(label_of(curve))},
                      {"kind", name_of(curve.kind)},
                      {"engine", printable(curve.engine)},
                      {"precision", printable(curve.precision)},
                      {"profile", printable(curve.profile)},
                      {"knob", knob_name(curve.kind)},
                      {"points", std::move(points)}});
  }
  return {{"name", printable(scene.scenario.name)},
          {"quantities", std::move(quantities)},
          {"curves", std::move(curves)}};
}

Json stability_page_data(const LimitResults& results) {
  if (results.limits.empty() && results.maps.empty()) return nullptr;
  Json outcomes = Json::array(), maps = Json::array(), limits = Json::array();
  for (std::size_t k = 0; k < kOutcomes; ++k) {
    const auto outcome = static_cast<Outcome>(k);
    const OutcomeLook& look = look_of(outcome);
    outcomes.push_back({{"name", name_of(outcome)},
                        {"letter", look.letter},
                        {"usable", is_usable(outcome)},
                        {"fill", look.fill},
                        {"ink", look.ink}});
  }
  for (const OutcomeMap* map : complete_maps(results))
    maps.push_back(map_data(*map, maps.size() + 1));
  for (const LimitGroup& group : limit_groups(results.limits))
    limits.push_back(limits_data(group, limits.size() + 1));
  return {
      {"outcomes", std::move(outcomes)}, {"maps", std::move(maps)}, {"limits", std::move(limits)}};
}

}  // namespace slipcheck
