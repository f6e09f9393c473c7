#include "report/json/precision_json.h"

#include "report/json/common_fields.h"

namespace slipcheck {

template <class Fields>
void describe(Fields& f, PrecisionGrid& grid) {
  f("engines", grid.engines.engines);
  f("precisions", grid.engines.precisions);
  f("profiles", grid.engines.profiles);
  f("rates", grid.rates);
  f("iterations", grid.iterations);
  f("tolerances", grid.tolerances);
  f("steps_per_contact", grid.steps_per_contact);
  f("repeats", grid.repeats);
}

template <class Fields>
void describe(Fields& f, PhaseErrors& errors) {
  f.reason(errors.reason);
  f("worst", errors.worst, errors.reason);
  f("median", errors.median, errors.reason);
  f("rms", errors.rms, errors.reason);
  f.if_any("absolute", errors.absolute);
  f("tolerance", errors.tolerance);
}

template <class Fields>
void describe(Fields& f, WorkCost& cost) {
  f("cpu_per_step", cost.per_step);
  f("cpu_per_simulated_second", cost.per_simulated_second);
  f("spread", cost.spread);
  f("repeats", cost.repeats);
}

template <class Fields>
void describe(Fields& f, WorkPrecision& point) {
  f("knob", point.knob);
  f("status", point.status);
  f.reason(point.reason);
  f("phases", point.phases);
  f("errors", point.errors);
  f("cost", point.cost);
  f("pareto", point.pareto);
}

template <class Fields>
void describe(Fields& f, Convergence& convergence) {
  f("kind", convergence.kind);
  f.derived("words", [&] { return words_of(convergence); });
  // Only what converges has an order.
  const bool has_order = convergence.kind == Convergence::Kind::converges;
  const char* no_order = has_order ? "" : "no order is fitted to what does not fall";
  f("order", convergence.order, no_order);
  f("order_error", convergence.order_error, no_order);
  f("coarsest", convergence.coarsest, "no point has an error");
  f("finest", convergence.finest, "no point has an error");
  f("largest", convergence.largest, "no point has an error");
}

template <class Fields>
void describe(Fields& f, MethodCurve& curve) {
  f.derived("method", [&] { return label_of(curve); });
  f("kind", curve.kind);
  if (curve.kind == MethodCurve::Kind::engine) {
    f("engine", curve.engine);
    f("version", curve.version);
    f("precision", curve.precision);
    f("profile", curve.profile);
    f("settings", curve.settings);
  }
  f("iterations", curve.iterations);
  f("convergence", curve.convergence);
  f("points", curve.points);
}

template <class Fields>
void describe(Fields& f, PrecisionScene& scene) {
  describe(f, scene.scenario);
  f("reference_solver", scene.reference.solver);
  f("simulated", scene.simulated);
  f("path_length", scene.path_length);
  f("curves", scene.curves);
}

nlohmann::ordered_json json_of(const std::vector<PrecisionScene>& scenes,
                               const PrecisionGrid& grid) {
  nlohmann::ordered_json json{{"schema", "slipcheck-precision/1"}};
  put_context(json);
  FieldWriter fields(json);
  fields("grid", grid);
  fields("scenes", scenes);
  return json;
}

std::vector<PrecisionScene> read_precision(const JsonNode& file) {
  return read_record<std::vector<PrecisionScene>>(file["scenes"]);
}

}  // namespace slipcheck
