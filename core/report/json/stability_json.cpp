#include "report/json/stability_json.h"

#include <cmath>
#include <utility>

#include "report/json/json_number.h"
#include "report/rows/stability_rows.h"
#include "report/terminal/text.h"

namespace slipcheck {
namespace {

using Json = nlohmann::ordered_json;

/// Those that occur.
Json counts_json(const OutcomeCounts& counts) {
  Json json = Json::object();
  for (std::size_t k = 0; k < kOutcomes; ++k)
    if (counts[k] > 0) json[name_of(static_cast<Outcome>(k))] = counts[k];
  return json;
}

Json criteria_json(const OutcomeCriteria& criteria) {
  return {{"creep", criteria.creep},
          {"energy", criteria.energy},
          {"exploded", criteria.exploded},
          {"least_rest", criteria.least_rest},
          {"conserved", criteria.conserved}};
}

Json reference_json(const ReferenceOutcome& reference) {
  Json json{{"outcome", reference.accurate  ? "accurate"
                        : reference.refused ? "refused"
                                            : "failed"}};
  if (!reference.why.empty()) json["why"] = valid_utf8(reference.why);
  put_number(json, "worst_uncertainty", reference.worst_uncertainty,
             "no uncertainty stands beside a tolerance");
  put_number(json, "cpu_seconds", reference.cpu_seconds);
  return json;
}

Json run_json(const StabilityRun& run) {
  const EngineRecord& record = run.record;
  Json json{{"engine", record.engine},
            {"version", record.version},
            {"precision", record.precision},
            {"profile", valid_utf8(record.profile)},
            {"settings", settings_json(record.settings)}};
  put_number(json, "rate", record.rate);
  json["status"] = name_of(record.status);
  add_reason(json, record.reason);
  json["outcome"] = name_of(run.outcome);
  if (!run.why.empty()) json["why"] = valid_utf8(run.why);
  json["phases"] = counts_json(run.phases);
  put_number(json, "worst_error", run.worst_error, kNoError);
  json["worst_observable"] = run.worst_observable;
  put_number(json, "energy_gain", run.energy_gain, kNoEnergy);
  put_number(json, "creep", run.creep, kNothingRests);
  put_number(json, "depth", run.depth, kNoOverlap);
  put_number(json, "cpu_seconds", record.cpu_seconds);
  json["steps"] = record.steps;
  return json;
}

Json case_json(const StabilityCase& scene) {
  Json json{
      {"name", valid_utf8(scene.scenario.name)}, {"title", valid_utf8(scene.scenario.title)},
      {"file", valid_utf8(scene.scenario.file)}, {"sha256", scene.scenario.sha256},
      {"text", valid_utf8(scene.scenario.text)}, {"reference", reference_json(scene.reference)}};
  Json& runs = json["runs"] = Json::array();
  for (const StabilityRun& run : scene.runs) runs.push_back(run_json(run));
  return json;
}

Json totals_json(const StabilityOverview& overview) {
  Json json{{"reference",
             {{"accurate", overview.accurate},
              {"refused", overview.refused},
              {"failed", overview.failed}}}};
  for (std::size_t m = 0; m < overview.methods.size(); ++m)
    json[valid_utf8(overview.methods[m].label())] = counts_json(overview.totals[m]);
  return json;
}

Json limit_json(const Limit& limit) {
  Json json{{"kind", key_of(limit.kind)},
            {"method", limit.method},
            {"version", limit.version},
            {"precision", limit.precision},
            {"profile", valid_utf8(limit.profile)},
            {"scene", valid_utf8(limit.scene)}};
  add_reason(json, limit.reason);
  put_number(json, "good", limit.good.value_or(kNotObserved), kNoGood);
  put_number(json, "bad", limit.bad.value_or(kNotObserved), kNoBad);
  put_number(json, "low", limit.low);
  put_number(json, "high", limit.high);
  if (limit.bad) json["beyond"] = name_of(limit.beyond);
  if (!limit.why.empty()) json["why"] = valid_utf8(limit.why);
  json["islands"] = limit.islands;
  json["strays"] = limit.strays;
  if (limit.theory) {
    put_number(json, "theory", *limit.theory);
    json["theory_name"] = valid_utf8(limit.theory_name);
    put_number(json, "ratio_to_theory", ratio_to_theory(limit), kNoRatio);
  }
  return json;
}

Json axis_json(const OutcomeMap::Axis& axis) {
  return {{"label", valid_utf8(axis.label)},
          {"logarithmic", axis.logarithmic},
          {"values", axis.values}};
}

Json map_json(const OutcomeMap& map) {
  Json json{
      {"name", valid_utf8(map.name)}, {"title", valid_utf8(map.title)},     {"method", map.method},
      {"precision", map.precision},   {"profile", valid_utf8(map.profile)}, {"x", axis_json(map.x)},
      {"y", axis_json(map.y)}};
  const std::size_t columns = map.x.values.size();
  Json outcome = Json::array(), error = Json::array();
  bool any_null = false;
  for (std::size_t k = 0; k < map.outcome.size(); ++k) {
    if (k % columns == 0) {
      outcome.push_back(Json::array());
      error.push_back(Json::array());
    }
    outcome.back().push_back(name_of(map.outcome[k]));
    const double worst = k < map.worst_error.size() ? map.worst_error[k] : kNotObserved;
    error.back().push_back(std::isfinite(worst) ? Json(worst) : Json(nullptr));
    any_null |= !std::isfinite(worst);
  }
  json["outcome"] = std::move(outcome);
  json["worst_error"] = std::move(error);
  if (any_null) add_reason(json, "null where there is no error");
  json["error_label"] = valid_utf8(map.error_label);
  if (!map.theory.empty()) {
    json["theory"] = map.theory;
    json["theory_name"] = valid_utf8(map.theory_name);
  }
  return json;
}

}  // namespace

Json json_of(const std::vector<StabilityCase>& cases, const StabilityGrid& grid,
             const LimitResults& limits) {
  Json json{{"schema", "slipcheck-stability/1"}};
  put_context(json);
  json["criteria"] = criteria_json(grid.criteria);
  json["grid"] = {{"engines", grid.engines.engines},
                  {"precisions", grid.engines.precisions},
                  {"profiles", grid.engines.profiles},
                  {"rates", grid.rates}};
  json["totals"] = totals_json(overview_of(cases));
  for (const char* list : {"cases", "limits", "maps"}) json[list] = Json::array();
  for (const StabilityCase& scene : cases) json["cases"].push_back(case_json(scene));
  for (const Limit& limit : limits.limits) json["limits"].push_back(limit_json(limit));
  for (const OutcomeMap& map : limits.maps) json["maps"].push_back(map_json(map));
  return json;
}

}  // namespace slipcheck
