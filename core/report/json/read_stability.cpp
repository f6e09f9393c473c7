#include <fmt/format.h>

#include <optional>

#include "report/json/read_parts.h"
#include "report/json/read_studies.h"
#include "report/json/stability_json.h"
#include "report/rows/stability_rows.h"

namespace slipcheck {
namespace {

Outcome read_outcome(const JsonNode& json, const std::string& key) {
  return json.one_of<Outcome>(key, kOutcomes, [](Outcome outcome) { return name_of(outcome); });
}

OutcomeCriteria read_criteria(const JsonNode& json) {
  OutcomeCriteria criteria;
  criteria.creep = json.number("creep");
  criteria.energy = json.number("energy");
  criteria.exploded = json.number("exploded");
  criteria.least_rest = json.number("least_rest");
  criteria.conserved = json.number("conserved");
  return criteria;
}

ReferenceOutcome read_reference(const JsonNode& json) {
  static constexpr const char* kNames[] = {"accurate", "refused", "failed"};
  const auto which =
      json.one_of<std::size_t>("outcome", 3, [](std::size_t k) { return kNames[k]; });
  ReferenceOutcome reference;
  reference.accurate = which == 0;
  reference.refused = which == 1;
  reference.why = json.text_or("why", "");
  reference.worst_uncertainty = json.number("worst_uncertainty");
  reference.cpu_seconds = json.number("cpu_seconds");
  return reference;
}

OutcomeCounts read_counts(const JsonNode& json) {
  OutcomeCounts counts{};
  for (std::size_t k = 0; k < kOutcomes; ++k)
    counts[k] = json.count_or(name_of(static_cast<Outcome>(k)), 0);
  return counts;
}

StabilityRun read_run(const JsonNode& json) {
  StabilityRun run;
  run.record.engine = json.text("engine");
  run.record.version = json.text("version");
  run.record.precision = json.text("precision");
  run.record.profile = json.text("profile");
  run.record.settings = read_settings(json, "settings");
  run.record.rate = json.number("rate");
  run.record.status = read_status(json);
  run.record.reason = json.own_reason({kNoError, kNoEnergy, kNothingRests, kNoOverlap});
  run.record.cpu_seconds = json.number("cpu_seconds");
  run.record.steps = json.count("steps");
  run.outcome = read_outcome(json, "outcome");
  run.why = json.text_or("why", "");
  run.phases = read_counts(json.at("phases"));
  run.worst_error = json.number("worst_error");
  run.worst_observable = json.text("worst_observable");
  run.energy_gain = json.number("energy_gain");
  run.creep = json.number("creep");
  run.depth = json.number("depth");
  return run;
}

Limit read_limit(const JsonNode& json) {
  Limit limit;
  limit.kind = json.one_of<Limit::Kind>("kind", 4, [](Limit::Kind kind) { return key_of(kind); });
  limit.method = json.text("method");
  limit.version = json.text("version");
  limit.precision = json.text("precision");
  limit.profile = json.text("profile");
  limit.scene = json.text("scene");
  limit.good = json.find_number("good");
  limit.bad = json.find_number("bad");
  limit.low = json.number("low");
  limit.high = json.number("high");
  if (limit.bad) limit.beyond = read_outcome(json, "beyond");
  limit.why = json.text_or("why", "");
  limit.islands = json.numbers("islands");
  limit.strays = json.numbers("strays");
  if (json.has("theory")) {
    limit.theory = json.number("theory");
    limit.theory_name = json.text("theory_name");
  }
  limit.reason = json.own_reason({kNoGood, kNoBad, kNoRatio});
  return limit;
}

OutcomeMap::Axis read_axis(const JsonNode& json) {
  return {json.text("label"), json.flag("logarithmic"), json.numbers("values")};
}

/// The cells of a map, row by row, through `read`, which says nothing of what is none.
template <class Value, class Read>
std::vector<Value> read_cells(const JsonNode& json, const std::string& key, const OutcomeMap& map,
                              const char* rule, Read read) {
  const std::size_t height = map.y.values.size(), width = map.x.values.size();
  const auto& rows = json.list_of(key);
  if (rows.size() != height) json.fault(key, "must have a list for each value of y");
  std::vector<Value> cells;
  for (std::size_t r = 0; r < height; ++r) {
    const std::string place = fmt::format("{}[{}]", json.place_of(key), r);
    if (!rows[r].is_array() || rows[r].size() != width)
      throw_bad_results(json.file(), place, "must be a list with one for each value of x",
                        &rows[r]);
    for (const nlohmann::json& value : rows[r]) {
      const std::optional<Value> cell = read(value);
      if (!cell)
        throw_bad_results(json.file(), fmt::format("{}[{}]", place, cells.size() % width), rule,
                          &value);
      cells.push_back(*cell);
    }
  }
  return cells;
}

std::optional<Outcome> outcome_of(const nlohmann::json& value) {
  for (std::size_t k = 0; k < kOutcomes; ++k)
    if (value == name_of(static_cast<Outcome>(k))) return static_cast<Outcome>(k);
  return std::nullopt;
}

std::optional<double> number_of(const nlohmann::json& value) {
  if (value.is_null()) return kNotObserved;
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

OutcomeMap read_map(const JsonNode& json) {
  OutcomeMap map;
  map.name = json.text("name");
  map.title = json.text("title");
  map.method = json.text("method");
  map.precision = json.text("precision");
  map.profile = json.text("profile");
  map.x = read_axis(json.at("x"));
  map.y = read_axis(json.at("y"));
  map.outcome = read_cells<Outcome>(json, "outcome", map, "must be an outcome's name", outcome_of);
  map.worst_error =
      read_cells<double>(json, "worst_error", map, "must be a number or null", number_of);
  map.error_label = json.text("error_label");
  if (!json.has("theory")) return map;
  for (const nlohmann::json& point : json.list_of("theory")) {
    if (!point.is_array() || point.size() != 2 || !point[0].is_number() || !point[1].is_number())
      json.fault("theory", "must be a list of [x, y]");
    map.theory.emplace_back(point[0].get<double>(), point[1].get<double>());
  }
  map.theory_name = json.text("theory_name");
  return map;
}

}  // namespace

StabilityFile read_stability(const JsonNode& file) {
  StabilityFile result;
  result.criteria = read_criteria(file.at("criteria"));
  for (const JsonNode& json : file.list("cases")) {
    StabilityCase& scene = result.cases.emplace_back();
    scene.scenario = read_scenario(json);
    scene.reference = read_reference(json.at("reference"));
    for (const JsonNode& run : json.list("runs")) scene.runs.push_back(read_run(run));
  }
  for (const JsonNode& limit : file.list("limits"))
    result.limits.limits.push_back(read_limit(limit));
  for (const JsonNode& map : file.list("maps")) result.limits.maps.push_back(read_map(map));
  return result;
}

}  // namespace slipcheck
