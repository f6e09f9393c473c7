#include "report/files/result_csv.h"

#include <map>
#include <set>

#include "base/by_name.h"
#include "report/rows/csv_rows.h"
#include "report/rows/selection.h"

namespace slipcheck {
namespace {

CsvValue count_of(std::size_t number) { return static_cast<double>(number); }
CsvValue truth(bool value) { return std::string(value ? "true" : "false"); }

void append(std::vector<CsvValue>& row, std::vector<CsvValue> more) {
  row.insert(row.end(), more.begin(), more.end());
}

std::vector<CsvValue> empty(std::size_t columns) {
  return std::vector<CsvValue>(columns, std::string());
}

/// scene … rate
std::vector<CsvValue> names_of(const SceneRecord& scene, const EngineRecord& run) {
  return {scene.scenario.name, run.engine, run.version, run.precision, run.profile, run.rate};
}

/// reference, uncertainty, closed_form
std::vector<CsvValue> reference_of(const ReferenceResult& reference, const std::string& name) {
  const UncertainValue* value = find_in(reference.observables, name);
  const double* exact = find_in(reference.closed_form, name);
  return {value ? value->value : kNotObserved, value ? value->uncertainty : kNotObserved,
          exact ? *exact : kNotObserved};
}

/// median … missing
std::vector<CsvValue> ensemble_of(const EngineRecord& run, const std::string& name) {
  const EnsembleValue* value = find_in(run.observables, name);
  // What is not there is missing in every phase.
  if (!value) return {kNotObserved, kNotObserved, kNotObserved, count_of(run.phases)};
  return {value->median, value->min, value->max, count_of(value->missing)};
}

/// median_error … within
std::vector<CsvValue> error_of(const EngineRecord& run, const std::string& name) {
  const Deviation* error = find_in(run.errors, name);
  if (!error) return empty(5);
  // Where the scene says what it expects of a run, tolerances do not judge it.
  const bool judged = error->tolerance && !run.expect;
  return {error->median, error->max, truth(error->absolute),
          error->tolerance.value_or(kNotObserved),
          judged ? truth(error->verdict == Verdict::within) : CsvValue(std::string())};
}

/// scale … heading_spread
std::vector<CsvValue> similarity_of(const EngineRecord& run, const EnsembleValue* value) {
  return {run.scale, count_of(run.headings),
          value && value->headings ? CsvValue(value->headings->spread) : CsvValue(std::string())};
}

std::string reason_of(const EngineRecord& run, const std::string& name,
                      const std::map<std::string, std::string>& absent) {
  if (const Deviation* error = find_in(run.errors, name); error && !error->reason.empty())
    return error->reason;
  const std::string* reason = find_in(absent, name);
  return reason ? *reason : "";
}

class ResultRows {
 public:
  explicit ResultRows(const SceneRecord& scene)
      : scene_(scene), absent_(absent_observables(scene)) {}

  void add_to(CsvRows& rows) const {
    if (scene_.runs.empty()) add_reference(rows);
    for (const EngineRecord& run : scene_.runs) {
      if (run.status == RunStatus::ok)
        add_run(run, rows);
      else
        add_trouble(run, rows);
    }
  }

 private:
  std::set<std::string> names(const EngineRecord* run) const {
    std::set<std::string> names;
    for (const auto& [name, value] : scene_.reference.observables) names.emplace(name);
    for (const auto& [name, reason] : absent_) names.insert(name);
    if (run)
      for (const auto& [name, value] : run->observables) names.insert(name);
    if (run)
      for (const auto& [name, error] : run->errors) names.insert(name);
    return names;
  }

  void add_reference(CsvRows& rows) const {
    for (const std::string& name : names(nullptr)) {
      std::vector<CsvValue> row = {scene_.scenario.name};
      append(row, empty(6));
      append(row, {CsvValue(name)});
      append(row, reference_of(scene_.reference, name));
      append(row, empty(9));
      const std::string* reason = find_in(absent_, name);
      append(row, {CsvValue(std::string()), CsvValue(reason ? *reason : std::string()),
                   CsvValue(scene_.reference.cpu_seconds), count_of(scene_.reference.run.steps)});
      append(row, empty(3));
      rows.add(row);
    }
  }

  void add_run(const EngineRecord& run, CsvRows& rows) const {
    for (const std::string& name : names(&run)) {
      std::vector<CsvValue> row = names_of(scene_, run);
      append(row, {CsvValue(std::string(name_of(run.status))), CsvValue(name)});
      append(row, reference_of(scene_.reference, name));
      append(row, ensemble_of(run, name));
      append(row, error_of(run, name));
      append(row, {count_of(run.phases), CsvValue(reason_of(run, name, absent_)),
                   CsvValue(run.cpu_seconds), count_of(run.steps)});
      append(row, similarity_of(run, find_in(run.observables, name)));
      rows.add(row);
    }
  }

  void add_trouble(const EngineRecord& run, CsvRows& rows) const {
    std::vector<CsvValue> row = names_of(scene_, run);
    append(row, {CsvValue(std::string(name_of(run.status)))});
    append(row, empty(13));
    append(row, {count_of(run.phases), CsvValue(run.reason), CsvValue(run.cpu_seconds),
                 count_of(run.steps)});
    append(row, similarity_of(run, nullptr));
    rows.add(row);
  }

  const SceneRecord& scene_;
  std::map<std::string, std::string> absent_;
};

}  // namespace

std::string results_csv(const std::vector<SceneRecord>& scenes) {
  CsvRows rows({"scene",        "engine",        "version",     "precision", "profile",
                "rate",         "status",        "observable",  "reference", "uncertainty",
                "closed_form",  "median",        "min",         "max",       "missing",
                "median_error", "max_error",     "absolute",    "tolerance", "within",
                "phases",       "reason",        "cpu_seconds", "steps",     "scale",
                "headings",     "heading_spread"});
  for (const SceneRecord& scene : scenes) ResultRows(scene).add_to(rows);
  return rows.text();
}

std::string phases_csv(const std::vector<SceneRecord>& scenes) {
  CsvRows rows({"scene", "engine", "version", "precision", "profile", "rate", "observable",
                "reference", "phase", "value", "scale", "heading"});
  for (const SceneRecord& scene : scenes)
    for (const EngineRecord& run : scene.runs)
      for (const auto& [name, ensemble] : run.observables) {
        if (!has_tolerance(scene.scenario, name)) continue;
        const UncertainValue* right = find_in(scene.reference.observables, name);
        const std::size_t phases = ensemble.values.size() / run.headings;
        for (std::size_t k = 0; k < ensemble.values.size(); ++k) {
          std::vector<CsvValue> row = names_of(scene, run);
          append(row, {CsvValue(name), CsvValue(right ? right->value : kNotObserved),
                       count_of(k % phases), CsvValue(ensemble.values[k]), CsvValue(run.scale),
                       count_of(k / phases)});
          rows.add(row);
        }
      }
  return rows.text();
}

}  // namespace slipcheck
