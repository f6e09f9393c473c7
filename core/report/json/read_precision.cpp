#include "report/json/read_parts.h"
#include "report/json/read_studies.h"

namespace slipcheck {
namespace {

PhaseErrors read_errors(const JsonNode& json) {
  PhaseErrors errors;
  errors.worst = json.number("worst");
  errors.median = json.number("median");
  errors.rms = json.number("rms");
  errors.absolute = json.flag_or("absolute", false);
  if (json.has("tolerance")) errors.tolerance = json.number("tolerance");
  errors.reason = json.own_reason();
  return errors;
}

WorkPrecision read_point(const JsonNode& json) {
  WorkPrecision point;
  point.knob = json.number("knob");
  point.status = read_status(json);
  point.reason = json.own_reason();
  point.phases = json.count("phases");
  for (const auto& [quantity, errors] : json.members("errors"))
    point.errors[quantity] = read_errors(errors);
  if (json.has("cost")) {
    const JsonNode cost = json.at("cost");
    point.cost = WorkCost{cost.number("cpu_per_step"), cost.number("cpu_per_simulated_second"),
                          cost.number("spread"), cost.count("repeats")};
  }
  for (const std::string& quantity : json.texts("pareto")) point.pareto.insert(quantity);
  return point;
}

Convergence read_convergence(const JsonNode& json) {
  return {json.one_of<Convergence::Kind>("kind", 4,
                                         [](Convergence::Kind kind) { return name_of(kind); }),
          json.number("order"),
          json.number("order_error"),
          json.number("coarsest"),
          json.number("finest"),
          json.number("largest")};
}

MethodCurve read_curve(const JsonNode& json) {
  MethodCurve curve;
  curve.kind = json.one_of<MethodCurve::Kind>("kind", 4,
                                              [](MethodCurve::Kind kind) { return name_of(kind); });
  if (curve.kind == MethodCurve::Kind::engine) {
    curve.engine = json.text("engine");
    curve.version = json.text("version");
    curve.precision = json.text("precision");
    curve.profile = json.text("profile");
    curve.settings = read_settings(json, "settings");
  }
  if (json.has("iterations")) curve.iterations = json.number("iterations");
  for (const auto& [quantity, falls] : json.members("convergence"))
    curve.convergence[quantity] = read_convergence(falls);
  for (const JsonNode& point : json.list("points")) curve.points.push_back(read_point(point));
  return curve;
}

}  // namespace

std::vector<PrecisionScene> read_precision(const JsonNode& file) {
  std::vector<PrecisionScene> scenes;
  for (const JsonNode& json : file.list("scenes")) {
    PrecisionScene& scene = scenes.emplace_back();
    scene.scenario = read_scenario(json);
    scene.reference.solver = json.text("reference_solver");
    scene.simulated = json.number("simulated");
    scene.path_length = json.number("path_length");
    for (const JsonNode& curve : json.list("curves")) scene.curves.push_back(read_curve(curve));
  }
  return scenes;
}

}  // namespace slipcheck
