#include "report/json/read_result.h"

#include <cmath>
#include <limits>
#include <utility>

#include "report/json/read_parts.h"

namespace slipcheck {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A series of which every `stride`-th sample is there, in its full length: values stay, times go
/// on evenly.
std::vector<double> full_length(const std::vector<double>& kept, std::size_t stride, bool is_time) {
  std::vector<double> values;
  values.reserve(kept.size() * stride);
  double rise = 0;  // to the next sample that is there
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (is_time && k + 1 < kept.size()) rise = kept[k + 1] - kept[k];
    for (std::size_t part = 0; part < stride; ++part)
      values.push_back(kept[k] + rise * static_cast<double>(part) / static_cast<double>(stride));
  }
  return values;
}

BoxReference read_statistics(const JsonNode& json) {
  BoxReference box;
  box.samples = json.count("samples");
  box.discarded = json.count("discarded_periods");
  box.steady = json.flag("steady");
  const std::size_t stride = json.count("stride");
  if (stride == 0 || stride > 1000000) json.fault("stride", "must be from 1 to 1000000");
  const JsonNode series = json.at("series");
  const std::vector<double> time = series.numbers("time");
  box.series.time = full_length(time, stride, true);
  for (const auto& [key, values] : {std::pair{"height", &box.series.height},
                                    {"kinetic_energy", &box.series.kinetic_energy},
                                    {"rotational_energy", &box.series.rotational_energy},
                                    {"collision_rate", &box.series.collision_rate}}) {
    *values = series.numbers(key);
    if (values->size() != time.size()) series.fault(key, "must be as long as time");
    *values = full_length(*values, stride, false);
  }
  return box;
}

ReferenceResult read_reference(const JsonNode& json) {
  ReferenceResult reference;
  reference.solver = json.text("solver");
  reference.cpu_seconds = json.number("cpu_seconds");
  reference.run.end_time = json.number("end_time");
  reference.run.reached = json.flag("reached");
  reference.run.reason = json.own_reason();
  reference.run.failed = json.flag_or("failed", false);
  reference.first_contact = json.number_or("first_contact", kInfinity);
  reference.run.collisions = json.count("collisions");
  reference.run.collapses = json.count_or("collapses", 0);
  reference.run.events = json.count("events");
  reference.run.steps = json.count("steps");
  // Its parts are not known, but that it is off by so much of its scale.
  if (json.has("energy_error"))
    reference.run.balance = EnergyBalance{.energy = json.number("energy_error"), .scale = 1};
  if (json.has("statistics")) reference.box = read_statistics(json.at("statistics"));
  for (const auto& [name, entry] : json.members("observables")) {
    UncertainValue value{entry.number("value"), entry.number("uncertainty")};
    // What has no value for another reason is absent, which the scene tells again.
    if (std::isnan(value.value) && !entry.has_reason("value is not a number")) continue;
    // Why it has no bound is said in other words than that it is infinite.
    if (std::isnan(value.uncertainty) && !entry.has_reason("uncertainty is not a number"))
      value.uncertainty = kInfinity;
    reference.observables[name] = value;
  }
  for (const auto& [name, setting] : read_settings(json, "closed_form")) {
    const double* value = std::get_if<double>(&setting);
    if (!value) json.at("closed_form").fault(name, "must be a number");
    reference.closed_form[name] = *value;
  }
  reference.warnings = json.texts("warnings");
  return reference;
}

EnsembleValue read_ensemble(const JsonNode& json) {
  EnsembleValue ensemble;
  ensemble.median = json.number("median");
  ensemble.min = json.number("min");
  ensemble.max = json.number("max");
  ensemble.missing = json.count_or("missing", 0);
  if (json.has("values")) ensemble.values = json.numbers("values");
  return ensemble;
}

Deviation read_deviation(const JsonNode& json) {
  Deviation deviation;
  deviation.median = json.number("median");
  deviation.max = json.has_reason("the error is infinite") ? kInfinity : json.number("max");
  deviation.rms = json.number("rms");
  deviation.reason = json.own_reason({"the error is infinite", "the error is not a number"});
  if (json.has("tolerance")) deviation.tolerance = json.number("tolerance");
  deviation.absolute = json.flag_or("absolute", false);
  const bool within = json.flag("within");
  if (deviation.tolerance)  // files of version 0.1 have no verdict here
    deviation.verdict =
        json.has("verdict")
            ? json.one_of<Verdict>("verdict", 4, [](Verdict verdict) { return name_of(verdict); })
        : within ? Verdict::within
                 : Verdict::deviates;
  return deviation;
}

EngineRecord read_run(const JsonNode& json) {
  EngineRecord run;
  run.engine = json.text("engine");
  run.version = json.text("version");
  run.precision = json.text("precision");
  run.profile = json.text("profile");
  run.settings = read_settings(json, "settings");
  run.rate = json.number("rate");
  run.status = read_status(json);
  run.reason = json.own_reason();
  run.cpu_seconds = json.number("cpu_seconds");
  run.steps = json.count("steps");
  run.phases = json.count("phases");
  for (const auto& [name, ensemble] : json.members("observables"))
    run.observables[name] = read_ensemble(ensemble);
  for (const auto& [name, deviation] : json.members("errors"))
    run.errors[name] = read_deviation(deviation);
  run.applied.not_represented = json.texts("not_represented");
  run.applied.settings = read_settings(json, "applied");
  run.warnings = json.texts("warnings");
  return run;
}

/// What the scene expects of its runs: each of them takes the first request of its kind that no
/// other run has taken.
void add_expectations(const Scenario& scenario, std::vector<EngineRecord>& runs) {
  struct Request {
    const EngineRequest* request;
    double rate;
    bool taken;
  };
  std::vector<Request> requests;
  for (const EngineRequest& request : scenario.compare.engines)
    for (const double rate : request.rates) requests.push_back({&request, rate, false});
  for (EngineRecord& run : runs)
    for (auto& [request, rate, taken] : requests) {
      const bool is_single = request->precision == EngineRequest::Precision::single_;
      if (taken || rate != run.rate || request->engine != run.engine ||
          request->profile != run.profile || run.precision != (is_single ? "single" : "double"))
        continue;
      taken = true;
      run.expect = request->expect;
      break;
    }
}

}  // namespace

SceneRecord read_result(const JsonNode& result) {
  SceneRecord scene;
  scene.scenario = read_scenario(result.at("scenario"));
  scene.scene = solved_scene(scene.scenario);
  scene.reference = read_reference(result.at("reference"));
  for (const JsonNode& run : result.list("runs")) scene.runs.push_back(read_run(run));
  add_expectations(scene.scenario, scene.runs);
  return scene;
}

}  // namespace slipcheck
