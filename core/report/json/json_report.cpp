#include "report/json/json_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/json/json_number.h"
#include "report/rows/selection.h"
#include "report/rows/verdict_look.h"
#include "report/terminal/text.h"
#include "scenario/tolerances.h"

namespace slipcheck {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no words for what is not finite.
Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

const char* kind_of(double value) {
  return std::isnan(value) ? "is not a number" : value > 0 ? "is infinite" : "is minus infinite";
}

Json strings(const std::vector<std::string>& texts) {
  Json list = Json::array();
  for (const std::string& text : texts) list.push_back(valid_utf8(text));
  return list;
}

constexpr std::size_t kMostPoints = 2000;  ///< of a series

/// Every `stride`-th of the values from the first on.
Json thinned(const std::vector<double>& values, std::size_t stride) {
  Json list = Json::array();
  for (std::size_t k = 0; k < values.size(); k += stride) list.push_back(number_or_null(values[k]));
  return list;
}

Json statistics_json(const BoxReference& box) {
  Json json;
  json["samples"] = box.samples;
  json["discarded_periods"] = box.discarded;
  json["steady"] = box.steady;
  const std::size_t count = box.series.time.size();
  const std::size_t stride = std::max<std::size_t>(1, (count + kMostPoints - 1) / kMostPoints);
  json["stride"] = stride;
  Json& series = json["series"];
  series["time"] = thinned(box.series.time, stride);
  series["height"] = thinned(box.series.height, stride);
  series["kinetic_energy"] = thinned(box.series.kinetic_energy, stride);
  series["rotational_energy"] = thinned(box.series.rotational_energy, stride);
  series["collision_rate"] = thinned(box.series.collision_rate, stride);
  return json;
}

/// Why an uncertainty has no bound.
std::string no_bound(const ReferenceResult& reference) {
  if (reference.box)
    return fmt::format("the uncertainty is not known: of fewer than {} samples a mean has no error",
                       kFewestForAnError);
  return "the uncertainty is unbounded: another rounding does not show the observable";
}

Json reference_json(const SceneRecord& scene) {
  const ReferenceResult& reference = scene.reference;
  Json json;
  json["solver"] = reference.solver;
  put_number(json, "cpu_seconds", reference.cpu_seconds);
  put_number(json, "end_time", reference.run.end_time);
  json["reached"] = reference.run.reached;
  add_reason(json, reference.run.reason);
  if (reference.run.failed) json["failed"] = true;
  if (std::isfinite(reference.first_contact)) json["first_contact"] = reference.first_contact;
  json["collisions"] = reference.run.collisions;
  if (reference.run.collapses > 0) json["collapses"] = reference.run.collapses;
  json["events"] = reference.run.events;
  json["steps"] = reference.run.steps;
  if (reference.run.balance) put_number(json, "energy_error", reference.run.balance->error());
  if (reference.box) json["statistics"] = statistics_json(*reference.box);

  // In alphabetical order, what is absent between what is shown.
  std::map<std::string, Json> observables;
  for (const auto& [name, value] : reference.observables) {
    Json& entry = observables[name];
    put_number(entry, "value", value.value);
    put_number(entry, "uncertainty", value.uncertainty,
               std::isinf(value.uncertainty) ? no_bound(reference) : "");
  }
  for (const auto& [name, reason] : absent_observables(scene))
    observables[name] = {{"value", nullptr}, {"uncertainty", nullptr}, {"reason", reason}};
  json["observables"] = Json::object();
  for (auto& [name, entry] : observables) json["observables"][name] = std::move(entry);

  json["closed_form"] = Json::object();
  for (const auto& [name, value] : reference.closed_form)
    put_number(json["closed_form"], name, value);
  json["warnings"] = strings(reference.warnings);
  return json;
}

Json ensemble_json(const EnsembleValue& ensemble, bool with_values) {
  Json json;
  put_number(json, "median", ensemble.median);
  put_number(json, "min", ensemble.min);
  put_number(json, "max", ensemble.max);
  if (ensemble.missing > 0) json["missing"] = ensemble.missing;
  if (with_values) {
    json["values"] = Json::array();
    bool any_null = false;
    for (double value : ensemble.values) {
      json["values"].push_back(number_or_null(value));
      any_null |= !std::isfinite(value);
    }
    if (any_null) add_reason(json, "null where a phase does not show it");
  }
  return json;
}

Json deviation_json(const Deviation& deviation) {
  Json json;
  json["median"] = number_or_null(deviation.median);
  json["max"] = number_or_null(deviation.max);
  json["rms"] = number_or_null(deviation.rms);
  add_reason(json, deviation.reason);
  if (deviation.reason.empty() && !std::isfinite(deviation.max))
    add_reason(json, std::string("the error ") + kind_of(deviation.max));
  if (deviation.tolerance) put_number(json, "tolerance", *deviation.tolerance);
  if (deviation.absolute) json["absolute"] = true;
  json["within"] = deviation.verdict <= Verdict::within;
  if (deviation.tolerance) json["verdict"] = name_of(deviation.verdict);
  return json;
}

Json expectation_json(const ExpectationResult& expected) {
  Json json;
  json["observable"] = valid_utf8(expected.observable);
  json["statistic"] = name_of(expected.statistic);
  if (expected.statistic != ExpectationResult::Statistic::none) {
    put_number(json, "low", expected.low);
    put_number(json, "high", expected.high);
  }
  json["value"] = number_or_null(expected.value);
  json["met"] = expected.met;
  add_reason(json, expected.reason);
  if (expected.reason.empty() && !std::isfinite(expected.value))
    add_reason(json, std::string("the value ") + kind_of(expected.value));
  return json;
}

/// What is shown phase by phase, or expected of it: not more, as there may be many phases.
bool needs_values(const Scenario& scenario, const EngineRecord& run, const std::string& name) {
  return tolerance_of_part(scenario, name) ||
         (run.expect && run.expect->observables.contains(name));
}

Json run_json(const Scenario& scenario, const EngineRecord& run) {
  Json json;
  json["engine"] = valid_utf8(run.engine);
  json["version"] = valid_utf8(run.version);
  json["precision"] = run.precision;
  json["profile"] = valid_utf8(run.profile);
  json["settings"] = settings_json(run.settings);
  put_number(json, "rate", run.rate);
  json["status"] = name_of(run.status);
  if (run.status != EngineRecord::Status::ok)
    add_reason(json, run.reason.empty() ? "not known" : run.reason);
  put_number(json, "cpu_seconds", run.cpu_seconds);
  json["steps"] = run.steps;
  json["phases"] = run.phases;
  json["observables"] = Json::object();
  for (const auto& [name, ensemble] : run.observables)
    json["observables"][name] = ensemble_json(ensemble, needs_values(scenario, run, name));
  json["errors"] = Json::object();
  for (const auto& [name, deviation] : run.errors) json["errors"][name] = deviation_json(deviation);
  if (run.expect && run.expect->status) json["expected_status"] = name_of(*run.expect->status);
  if (run.expect && !run.expect->status) {
    json["expected"] = Json::array();
    for (const ExpectationResult& expected : run.expectations())
      json["expected"].push_back(expectation_json(expected));
  }
  json["not_represented"] = strings(run.applied.not_represented);
  json["applied"] = settings_json(run.applied.settings);
  json["warnings"] = strings(run.warnings);
  return json;
}

}  // namespace

Json json_of(const SceneRecord& scene) {
  const Scenario& scenario = scene.scenario;
  Json json{{"schema", "slipcheck-result/1"}};
  put_context(json);
  json["scenario"] = {{"name", valid_utf8(scenario.name)},
                      {"title", valid_utf8(scenario.title)},
                      {"file", valid_utf8(scenario.file)},
                      {"sha256", scenario.sha256},
                      {"text", valid_utf8(scenario.text)}};
  json["reference"] = reference_json(scene);
  json["runs"] = Json::array();
  for (const EngineRecord& run : scene.runs) json["runs"].push_back(run_json(scenario, run));
  json["verdict"] = is_reference_alone(scene) ? "reference alone" : name_of(scene.verdict());
  return json;
}

Json json_of(const std::vector<SceneRecord>& scenes) {
  if (scenes.size() == 1) return json_of(scenes.front());
  Json json;
  json["schema"] = "slipcheck-results/1";
  json["results"] = Json::array();
  for (const SceneRecord& scene : scenes) json["results"].push_back(json_of(scene));
  return json;
}

}  // namespace slipcheck
