#include "report/json/json_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/lacks.h"
#include "report/json/common_fields.h"
#include "report/rows/selection.h"
#include "report/rows/told_verdict.h"
#include "report/rows/verdict_look.h"
#include "scenario/tolerances.h"

namespace slipcheck {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// --- series of a box -----------------------------------------------------------------------------

constexpr std::size_t kMostPoints = 2000;  ///< of a series

constexpr std::pair<const char*, std::vector<double> BoxSeries::*> kSeries[] = {
    {"time", &BoxSeries::time},
    {"height", &BoxSeries::height},
    {"kinetic_energy", &BoxSeries::kinetic_energy},
    {"rotational_energy", &BoxSeries::rotational_energy},
    {"collision_rate", &BoxSeries::collision_rate}};

/// Every `stride`-th of the values from the first on.
std::vector<double> thinned(const std::vector<double>& values, std::size_t stride) {
  std::vector<double> kept;
  for (std::size_t k = 0; k < values.size(); k += stride) kept.push_back(values[k]);
  return kept;
}

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

// --- what a scene tells beside its records -------------------------------------------------------

/// An observable of the reference, or why there is none.
struct ShownObservable {
  std::optional<double> value, uncertainty;
  std::string why;  ///< there is none, or no bound
};

/// Why an uncertainty has no bound.
std::string no_bound(const ReferenceResult& reference) {
  if (reference.box)
    return fmt::format("the uncertainty is not known: of fewer than {} samples a mean has no error",
                       kFewestForAnError);
  return "the uncertainty is unbounded: another rounding does not show the observable";
}

/// Also what a tolerance asks for and the reference does not show.
std::map<std::string, ShownObservable> shown_observables(const SceneRecord& scene) {
  std::map<std::string, ShownObservable> shown;
  for (const auto& [name, seen] : scene.reference.observables)
    shown.emplace(name,
                  ShownObservable{seen.value, seen.uncertainty,
                                  std::isinf(seen.uncertainty) ? no_bound(scene.reference) : ""});
  for (const auto& [name, reason] : absent_observables(scene))
    shown[name] = {std::nullopt, std::nullopt, reason};
  return shown;
}

/// What is absent the scene tells again; an uncertainty without a number has no bound.
ByName<UncertainValue> observables_of(const std::map<std::string, ShownObservable>& shown) {
  ByName<UncertainValue> observables;
  for (const auto& [name, seen] : shown)
    if (seen.value) observables[name] = {*seen.value, seen.uncertainty.value_or(kInfinity)};
  return observables;
}

/// By phase is shown what has a tolerance or is expected: not more, as there may be many phases.
std::vector<EngineRecord> shown_runs(const SceneRecord& scene) {
  std::vector<EngineRecord> runs = scene.runs;
  for (EngineRecord& run : runs)
    for (auto& [name, ensemble] : run.observables)
      if (!tolerance_of_part(scene.scenario, name) &&
          !(run.expect && run.expect->observables.contains(name)))
        ensemble.values.clear();
  return runs;
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
      const bool is_single = run.precision == "single";
      if (taken || rate != run.rate || run.scale != 1 || request->engine != run.engine ||
          request->profile != run.profile ||
          (request->precision &&
           is_single != (*request->precision == EngineRequest::Precision::single_)))
        continue;
      taken = true;
      run.expect = request->expect;
      break;
    }
}

}  // namespace

// --- fields --------------------------------------------------------------------------------------

template <class Fields>
void describe(Fields& f, BoxReference& box) {
  f("samples", box.samples);
  f("discarded_periods", box.discarded);
  f("steady", box.steady);
  std::size_t stride =
      std::max<std::size_t>(1, (box.series.time.size() + kMostPoints - 1) / kMostPoints);
  f("stride", stride);
  if constexpr (Fields::kReads)
    if (stride == 0 || stride > 1000000) f["stride"].fault("must be from 1 to 1000000");
  f.object("series", [&](auto& series) {
    std::size_t samples = 0;
    for (const auto& [key, member] : kSeries) {
      std::vector<double> kept = thinned(box.series.*member, stride);
      series(key, kept);
      if constexpr (Fields::kReads) {
        if (member == &BoxSeries::time) samples = kept.size();
        if (kept.size() != samples) series[key].fault("must be as long as time");
        box.series.*member = full_length(kept, stride, member == &BoxSeries::time);
      }
    }
  });
}

template <class Fields>
void describe(Fields& f, ShownObservable& shown) {
  f.or_null("value", shown.value);
  f.or_null("uncertainty", shown.uncertainty, shown.why);
  if constexpr (Fields::kReads)
    if (shown.uncertainty.value_or(0) < 0) f["uncertainty"].fault("must be >= 0");
}

template <class Fields>
void describe_reference(Fields& f, SceneRecord& scene) {
  ReferenceResult& reference = scene.reference;
  SolvedRun& run = reference.run;
  f("solver", reference.solver);
  f("cpu_seconds", reference.cpu_seconds);
  f("end_time", run.end_time);
  f("reached", run.reached);
  f.reason(run.reason);
  f.if_any("failed", run.failed);
  f.if_any("left_out", reference.left_out);
  if constexpr (Fields::kReads) reference.first_contact = kInfinity;
  f.if_finite("first_contact", reference.first_contact);
  f("collisions", run.collisions);
  f.if_any("collapses", run.collapses);
  f("events", run.events);
  f("steps", run.steps);
  if constexpr (!Fields::kReads) {
    if (run.balance) f("energy_error", run.balance->error());
  } else if (f.has("energy_error")) {
    // Its parts are not known, but that it is off by so much of its scale.
    f("energy_error", run.balance.emplace(EnergyBalance{.energy = 0, .scale = 1}).energy);
  }
  f("statistics", reference.box);
  std::map<std::string, ShownObservable> shown;
  if constexpr (!Fields::kReads) shown = shown_observables(scene);
  f("observables", shown);
  f("closed_form", reference.closed_form);
  f("warnings", reference.warnings);
  if constexpr (Fields::kReads) reference.observables = observables_of(shown);
}

template <class Fields>
void describe(Fields& f, HeadingSpread& headings) {
  f("spread", headings.spread);
  f("phase", headings.phase);
}

template <class Fields>
void describe(Fields& f, EnsembleValue& ensemble) {
  f("median", ensemble.median);
  f("min", ensemble.min);
  f("max", ensemble.max);
  f.if_any("missing", ensemble.missing);
  f("headings", ensemble.headings);
  f.if_any("values", ensemble.values, "null where a phase does not show it");
}

template <class Fields>
void describe(Fields& f, Deviation& deviation) {
  f.untold("median", deviation.median);
  f.untold("max", deviation.max);
  f.untold("rms", deviation.rms);
  f.reason(deviation.reason, if_not_finite("the error", deviation.max));
  f("tolerance", deviation.tolerance);
  f.if_any("absolute", deviation.absolute);
  bool within = deviation.verdict <= Verdict::within;
  f("within", within);
  if (!deviation.tolerance) return;
  if constexpr (Fields::kReads) {  // files of version 0.1 have no verdict here
    deviation.verdict = within ? Verdict::within : Verdict::deviates;
    f.if_any("verdict", deviation.verdict);
  } else {
    f("verdict", deviation.verdict);
  }
}

/// Is written alone.
template <class Fields>
void describe(Fields& f, ExpectationResult& expected) {
  f("observable", expected.observable);
  f("statistic", expected.statistic);
  if (expected.statistic != ExpectationResult::Statistic::none) {
    f("low", expected.low);
    f("high", expected.high);
  }
  f.untold("value", expected.value);
  f("met", expected.met);
  f.reason(expected.reason, if_not_finite("the value", expected.value));
}

template <class Fields>
void describe(Fields& f, EngineRecord& run) {
  f("engine", run.engine);
  f("version", run.version);
  f("precision", run.precision);
  f("profile", run.profile);
  f("settings", run.settings);
  f("rate", run.rate);
  f.unless("scale", run.scale, 1.0);
  f("status", run.status);
  if (run.status != RunStatus::ok) f.reason(run.reason, "not known");
  f("cpu_seconds", run.cpu_seconds);
  f("steps", run.steps);
  f("phases", run.phases);
  f.unless("headings", run.headings, std::size_t{1});
  f("observables", run.observables);
  f("errors", run.errors);
  if (run.expect && run.expect->status)
    f.derived("expected_status", [&] { return *run.expect->status; });
  else if (run.expect)
    f.derived("expected", [&] { return run.expectations(); });
  describe_lacks(f, run.applied.not_represented);
  f("applied", run.applied.settings);
  f("warnings", run.warnings);
}

template <class Fields>
void describe(Fields& f, SceneRecord& scene) {
  f("scenario", scene.scenario);
  f.object("reference", [&](auto& reference) { describe_reference(reference, scene); });
  if constexpr (Fields::kReads)
    f("runs", scene.runs);
  else
    f("runs", shown_runs(scene));
  f.derived("verdict", [&] {
    return std::string(is_reference_alone(scene) ? "reference alone" : name_of(scene.verdict()));
  });
  f.derived("verdict_told", [&] {
    return std::string(is_reference_alone(scene) ? "reference alone"
                                                 : name_of(told_verdict(scene)));
  });
}

nlohmann::ordered_json json_of(const SceneRecord& scene) {
  nlohmann::ordered_json json{{"schema", "slipcheck-result/1"}};
  put_context(json);
  json.update(written(scene));
  return json;
}

nlohmann::ordered_json json_of(const std::vector<SceneRecord>& scenes) {
  if (scenes.size() == 1) return json_of(scenes.front());
  nlohmann::ordered_json json = {{"schema", "slipcheck-results/1"}};
  json["results"] = nlohmann::ordered_json::array();
  for (const SceneRecord& scene : scenes) json["results"].push_back(json_of(scene));
  return json;
}

SceneRecord read_result(const JsonNode& result) {
  auto scene = read_record<SceneRecord>(result);
  scene.scene = solved_scene(scene.scenario);
  add_expectations(scene.scenario, scene.runs);
  return scene;
}

}  // namespace slipcheck
