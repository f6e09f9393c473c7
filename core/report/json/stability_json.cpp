#include "report/json/stability_json.h"

#include "report/json/common_fields.h"
#include "report/rows/stability_rows.h"

namespace slipcheck {
namespace {

/// How the reference came out.
enum class ReferenceEnd { accurate, refused, failed };

}  // namespace

template <>
inline constexpr std::array kNamesOf<ReferenceEnd> = {"accurate", "refused", "failed"};

/// Those that occur.
template <class Fields>
void describe(Fields& f, OutcomeCounts& counts) {
  for (std::size_t k = 0; k < kOutcomes; ++k) f.if_any(kNamesOf<Outcome>[k], counts[k]);
}

template <class Fields>
void describe(Fields& f, OutcomeCriteria& criteria) {
  f("creep", criteria.creep);
  f("energy", criteria.energy);
  f("exploded", criteria.exploded);
  f("least_rest", criteria.least_rest);
  f("conserved", criteria.conserved);
}

template <class Fields>
void describe(Fields& f, StabilityGrid& grid) {
  f("engines", grid.engines.engines);
  f("precisions", grid.engines.precisions);
  f("profiles", grid.engines.profiles);
  f("rates", grid.rates);
}

template <class Fields>
void describe(Fields& f, ReferenceOutcome& reference) {
  ReferenceEnd end = reference.accurate  ? ReferenceEnd::accurate
                     : reference.refused ? ReferenceEnd::refused
                                         : ReferenceEnd::failed;
  f("outcome", end);
  if constexpr (Fields::kReads) {
    reference.accurate = end == ReferenceEnd::accurate;
    reference.refused = end == ReferenceEnd::refused;
  }
  f.if_any("why", reference.why);
  f("worst_uncertainty", reference.worst_uncertainty, "no uncertainty stands beside a tolerance");
  f("cpu_seconds", reference.cpu_seconds);
}

template <class Fields>
void describe(Fields& f, StabilityRun& run) {
  EngineRecord& record = run.record;
  f("engine", record.engine);
  f("version", record.version);
  f("precision", record.precision);
  f("profile", record.profile);
  f("settings", record.settings);
  f("rate", record.rate);
  f("status", record.status);
  f.reason(record.reason);
  f("outcome", run.outcome);
  f.if_any("why", run.why);
  f("phases", run.phases);
  f("worst_error", run.worst_error, "no error could be taken");
  f("worst_observable", run.worst_observable);
  f("energy_gain", run.energy_gain, "no energy could be taken");
  f("creep", run.creep, "nothing rests in the reference");
  f("depth", run.depth, "no overlap could be taken");
  f("cpu_seconds", record.cpu_seconds);
  f("steps", record.steps);
}

template <class Fields>
void describe(Fields& f, StabilityCase& scene) {
  describe(f, scene.scenario);
  f("reference", scene.reference);
  f("runs", scene.runs);
}

template <class Fields>
void describe(Fields& f, Limit& limit) {
  f("kind", limit.kind);
  f("method", limit.method);
  f("version", limit.version);
  f("precision", limit.precision);
  f("profile", limit.profile);
  f("scene", limit.scene);
  f.reason(limit.reason);
  f.or_null("good", limit.good, "no value was found good");
  f.or_null("bad", limit.bad, "no value was found bad");
  f("low", limit.low);
  f("high", limit.high);
  if (limit.bad) f("beyond", limit.beyond);
  f.if_any("why", limit.why);
  f("islands", limit.islands);
  f("strays", limit.strays);
  f("theory", limit.theory);
  if (!limit.theory) return;
  f("theory_name", limit.theory_name);
  f.derived(
      "ratio_to_theory", [&] { return ratio_to_theory(limit); }, "there is no limit to divide");
}

template <class Fields>
void describe(Fields& f, OutcomeMap::Axis& axis) {
  f("label", axis.label);
  f("logarithmic", axis.logarithmic);
  f("values", axis.values);
}

/// The cells of a map, row by row.
template <class Fields, class Value>
void describe_cells(Fields& f, const char* key, const OutcomeMap& map, std::vector<Value>& cells,
                    const char* why = "") {
  const std::size_t width = map.x.values.size();
  if constexpr (Fields::kReads) {
    for (const JsonNode& row : f[key].items(map.y.values.size()))
      for (const JsonNode& cell : row.items(width)) FieldReader::read(cell, cells.emplace_back());
  } else {
    std::vector<std::vector<Value>> rows;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (k % width == 0) rows.emplace_back();
      rows.back().push_back(cells[k]);
    }
    f(key, rows, why);
  }
}

template <class Fields>
void describe(Fields& f, OutcomeMap& map) {
  f("name", map.name);
  f("title", map.title);
  f("method", map.method);
  f("precision", map.precision);
  f("profile", map.profile);
  f("x", map.x);
  f("y", map.y);
  describe_cells(f, "outcome", map, map.outcome);
  describe_cells(f, "worst_error", map, map.worst_error, "null where there is no error");
  f("error_label", map.error_label);
  f.if_any("theory", map.theory);
  if (!map.theory.empty()) f("theory_name", map.theory_name);
}

nlohmann::ordered_json json_of(const std::vector<StabilityCase>& cases, const StabilityGrid& grid,
                               const LimitResults& limits) {
  nlohmann::ordered_json json{{"schema", "slipcheck-stability/1"}};
  put_context(json);
  FieldWriter fields(json);
  fields("criteria", grid.criteria);
  fields("grid", grid);
  const StabilityOverview overview = overview_of(cases);
  fields.object("totals", [&](auto& totals) {
    totals.object("reference", [&](auto& reference) {
      reference("accurate", overview.accurate);
      reference("refused", overview.refused);
      reference("failed", overview.failed);
    });
    for (std::size_t m = 0; m < overview.methods.size(); ++m)
      totals(valid_utf8(overview.methods[m].label()), overview.totals[m]);
  });
  fields("cases", cases);
  fields("limits", limits.limits);
  fields("maps", limits.maps);
  return json;
}

StabilityFile read_stability(const JsonNode& file) {
  StabilityFile result;
  FieldReader fields(file);
  fields("criteria", result.criteria);
  fields("cases", result.cases);
  fields("limits", result.limits.limits);
  fields("maps", result.limits.maps);
  return result;
}

}  // namespace slipcheck
