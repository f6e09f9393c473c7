#include "report/files/stability_csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/rows/csv_rows.h"
#include "report/rows/stability_rows.h"

namespace slipcheck {
namespace {

CsvValue optional_number(const std::optional<double>& value) {
  return value.value_or(kNotObserved);
}

/// The reference has neither settings nor phases; its uncertainty stands in place of the error.
std::vector<CsvValue> reference_row(const StabilityCase& scene) {
  const ReferenceOutcome& reference = scene.reference;
  const std::string none;
  const std::string outcome = reference.accurate  ? "accurate"
                              : reference.refused ? "refused"
                                                  : "failed";
  std::vector<CsvValue> row = {scene.scenario.name,
                               std::string("reference"),
                               none,
                               none,
                               none,
                               none,
                               none,
                               outcome,
                               reference.why,
                               reference.worst_uncertainty,
                               none,
                               none,
                               none,
                               none,
                               reference.cpu_seconds};
  row.resize(row.size() + kOutcomes, none);
  return row;
}

std::vector<CsvValue> run_row(const StabilityCase& scene, const StabilityRun& run) {
  const EngineRecord& record = run.record;
  std::vector<CsvValue> row = {
      scene.scenario.name,
      fmt::format("{} {} {}", record.engine, record.precision, record.profile),
      record.engine,
      record.version,
      record.precision,
      record.profile,
      record.rate,
      std::string(name_of(run.outcome)),
      run.why,
      run.worst_error,
      run.worst_observable,
      run.energy_gain,
      run.creep,
      run.depth,
      record.cpu_seconds};
  for (const std::size_t count : run.phases) row.emplace_back(static_cast<double>(count));
  return row;
}

}  // namespace

std::string stability_csv(const std::vector<StabilityCase>& cases) {
  std::vector<std::string> header = {
      "case",  "method",  "engine",     "version",     "precision",        "profile",
      "rate",  "outcome", "why",        "worst_error", "worst_observable", "energy_gain",
      "creep", "depth",   "cpu_seconds"};
  for (std::size_t k = 0; k < kOutcomes; ++k)
    header.push_back(fmt::format("phases {}", name_of(static_cast<Outcome>(k))));
  CsvRows rows(header);
  for (const StabilityCase& scene : cases) {
    rows.add(reference_row(scene));
    for (const StabilityRun& run : scene.runs) rows.add(run_row(scene, run));
  }
  return rows.text();
}

std::string limits_csv(const std::vector<Limit>& limits) {
  CsvRows rows({"kind", "method", "engine", "version", "precision", "profile", "scene", "good",
                "bad", "low", "high", "theory", "theory_name", "ratio_to_theory", "beyond", "why",
                "islands", "reason"});
  for (const Limit& limit : limits)
    rows.add({std::string(name_of(limit.kind)), label_of(limit), limit.method, limit.version,
              limit.precision, limit.profile, limit.scene, optional_number(limit.good),
              optional_number(limit.bad), limit.low, limit.high, optional_number(limit.theory),
              limit.theory_name, ratio_to_theory(limit),
              std::string(limit.bad ? name_of(limit.beyond) : ""), limit.why,
              fmt::format("{}", fmt::join(limit.islands, "; ")), limit.reason});
  return rows.text();
}

std::string maps_csv(const std::vector<OutcomeMap>& maps) {
  CsvRows rows({"map", "method", "precision", "profile", "x_label", "x", "y_label", "y", "outcome",
                "error_label", "worst_error"});
  for (const OutcomeMap& map : maps)
    for (std::size_t k = 0; k < map.outcome.size(); ++k) {
      const std::size_t columns = map.x.values.size();
      rows.add({map.name, map.method, map.precision, map.profile, map.x.label,
                map.x.values[k % columns], map.y.label, map.y.values[k / columns],
                std::string(name_of(map.outcome[k])), map.error_label,
                k < map.worst_error.size() ? map.worst_error[k] : kNotObserved});
    }
  return rows.text();
}

}  // namespace slipcheck
