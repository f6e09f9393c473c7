#include "report/json/versions_json.h"

#include <cmath>

#include "report/json/common_fields.h"

namespace slipcheck {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

/// One version's side of a change.
Json side_of(const EngineRecord& run, const VersionChange& change, double error) {
  Json side{{"version", run.version}, {"status", name_of(run.status)}};
  if (!run.reason.empty()) side["reason"] = run.reason;
  const auto found = run.observables.find(change.observable);
  if (found == run.observables.end()) return side;
  const EnsembleValue& value = found->second;
  side["min"] = number(value.min);
  side["median"] = number(value.median);
  side["max"] = number(value.max);
  side["values"] = Json::array();
  for (const double each : value.values) side["values"].push_back(number(each));
  side["worst_error_in_tolerances"] = number(error);
  return side;
}

Json json_of(const VersionChange& change) {
  Json entry{{"scene", change.scene->scenario.name},
             {"precision", change.after->precision},
             {"profile", change.after->profile},
             {"rate", change.after->rate}};
  if (!change.observable.empty()) entry["observable"] = change.observable;
  if (!change.twins.empty()) entry["twins"] = change.twins;
  entry["moved_in_tolerances"] = number(change.moved);
  const auto reference = change.scene->reference.observables.find(change.observable);
  if (reference != change.scene->reference.observables.end())
    entry["reference"] = number(reference->second.value);
  entry["before"] = side_of(*change.before, change, change.error_before);
  entry["after"] = side_of(*change.after, change, change.error_after);
  return entry;
}

}  // namespace

Json json_of(const VersionComparison& comparison, const std::vector<VersionChange>& changes) {
  Json file{{"schema", "slipcheck-versions/1"}};
  put_context(file);
  const VersionTotals totals = totals_of(comparison, changes);
  file["engine"] = comparison.engine;
  file["before"] = comparison.before;
  file["after"] = comparison.after;
  file["threshold"] = comparison.threshold;
  file["runs"] = totals.runs;
  file["compared"] = totals.compared;
  file["better"] = totals.better;
  file["worse"] = totals.worse;
  file["changes"] = Json::array();
  for (const VersionChange& change : changes) file["changes"].push_back(json_of(change));
  return file;
}

}  // namespace slipcheck
