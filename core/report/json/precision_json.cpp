#include "report/json/precision_json.h"

#include "report/json/json_number.h"
#include "report/terminal/text.h"

namespace slipcheck {
namespace {

using Json = nlohmann::ordered_json;

Json grid_json(const PrecisionGrid& grid) {
  return {{"engines", grid.engines.engines},
          {"precisions", grid.engines.precisions},
          {"profiles", grid.engines.profiles},
          {"rates", grid.rates},
          {"iterations", grid.iterations},
          {"tolerances", grid.tolerances},
          {"steps_per_contact", grid.steps_per_contact},
          {"repeats", grid.repeats}};
}

Json errors_json(const PhaseErrors& errors) {
  Json json;
  add_reason(json, errors.reason);
  put_number(json, "worst", errors.worst, errors.reason);
  put_number(json, "median", errors.median, errors.reason);
  put_number(json, "rms", errors.rms, errors.reason);
  if (errors.absolute) json["absolute"] = true;
  if (errors.tolerance) put_number(json, "tolerance", *errors.tolerance);
  return json;
}

Json point_json(const WorkPrecision& point) {
  Json json;
  put_number(json, "knob", point.knob);
  json["status"] = name_of(point.status);
  add_reason(json, point.reason);
  json["phases"] = point.phases;
  Json& errors = json["errors"] = Json::object();
  for (const auto& [quantity, error] : point.errors) errors[quantity] = errors_json(error);
  if (point.cost) {
    Json& cost = json["cost"];
    put_number(cost, "cpu_per_step", point.cost->per_step);
    put_number(cost, "cpu_per_simulated_second", point.cost->per_simulated_second);
    put_number(cost, "spread", point.cost->spread);
    cost["repeats"] = point.cost->repeats;
  }
  json["pareto"] = point.pareto;
  return json;
}

Json convergence_json(const Convergence& convergence) {
  // Only what converges has an order.
  const bool has_order = convergence.kind == Convergence::Kind::converges;
  const std::string no_order = has_order ? "" : "no order is fitted to what does not fall";
  Json json{{"kind", name_of(convergence.kind)}, {"words", words_of(convergence)}};
  put_number(json, "order", convergence.order, no_order);
  put_number(json, "order_error", convergence.order_error, no_order);
  put_number(json, "coarsest", convergence.coarsest, "no point has an error");
  put_number(json, "finest", convergence.finest, "no point has an error");
  put_number(json, "largest", convergence.largest, "no point has an error");
  return json;
}

Json curve_json(const MethodCurve& curve) {
  Json json{{"method", valid_utf8(label_of(curve))}, {"kind", name_of(curve.kind)}};
  if (curve.kind == MethodCurve::Kind::engine) {
    json["engine"] = curve.engine;
    json["version"] = curve.version;
    json["precision"] = curve.precision;
    json["profile"] = valid_utf8(curve.profile);
    json["settings"] = settings_json(curve.settings);
  }
  if (curve.iterations) json["iterations"] = *curve.iterations;
  Json& convergence = json["convergence"] = Json::object();
  for (const auto& [quantity, falls] : curve.convergence)
    convergence[quantity] = convergence_json(falls);
  Json& points = json["points"] = Json::array();
  for (const WorkPrecision& point : curve.points) points.push_back(point_json(point));
  return json;
}

Json scene_json(const PrecisionScene& scene) {
  Json json{
      {"name", valid_utf8(scene.scenario.name)}, {"title", valid_utf8(scene.scenario.title)},
      {"file", valid_utf8(scene.scenario.file)}, {"sha256", scene.scenario.sha256},
      {"text", valid_utf8(scene.scenario.text)}, {"reference_solver", scene.reference.solver}};
  put_number(json, "simulated", scene.simulated);
  put_number(json, "path_length", scene.path_length);
  Json& curves = json["curves"] = Json::array();
  for (const MethodCurve& curve : scene.curves) curves.push_back(curve_json(curve));
  return json;
}

}  // namespace

Json json_of(const std::vector<PrecisionScene>& scenes, const PrecisionGrid& grid) {
  Json json{{"schema", "slipcheck-precision/1"}};
  put_context(json);
  json["grid"] = grid_json(grid);
  Json& list = json["scenes"] = Json::array();
  for (const PrecisionScene& scene : scenes) list.push_back(scene_json(scene));
  return json;
}

}  // namespace slipcheck
