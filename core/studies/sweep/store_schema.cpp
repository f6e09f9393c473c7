#include "studies/sweep/store_schema.h"

#include <fmt/format.h>

#include <array>

namespace slipcheck {
namespace {

constexpr const char* kTables = R"(
CREATE TABLE sweep(key TEXT PRIMARY KEY, value) WITHOUT ROWID;
CREATE TABLE parameters(number INTEGER PRIMARY KEY, name TEXT NOT NULL, kind TEXT NOT NULL, unit TEXT NOT NULL);
CREATE TABLE names(id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE);
CREATE TABLE scenes(scene INTEGER PRIMARY KEY, solver TEXT, reached INTEGER, reason TEXT, warnings TEXT,
  cpu_seconds REAL);
CREATE TABLE reference(scene INTEGER, observable INTEGER, value REAL, uncertainty REAL, closed_form REAL,
  PRIMARY KEY(scene, observable)) WITHOUT ROWID;
CREATE TABLE observables(run INTEGER, observable INTEGER, median REAL, min REAL, max REAL, missing INTEGER,
  error REAL, error_median REAL, absolute INTEGER, tolerance REAL, verdict TEXT, per_phase BLOB,
  PRIMARY KEY(run, observable)) WITHOUT ROWID;
)";

constexpr const char* kView = R"(
CREATE VIEW results AS SELECT runs.*, names.name AS observable, median, min, max, missing, error, error_median,
  absolute, tolerance, observables.verdict AS observable_verdict, reference.value AS reference,
  reference.uncertainty, reference.closed_form
FROM runs JOIN observables USING(run) JOIN names ON names.id = observables.observable
LEFT JOIN reference ON reference.scene = runs.scene AND reference.observable = observables.observable;
)";

}  // namespace

std::string store_tables(const StoreHead& head) {
  std::string runs =
      "CREATE TABLE runs(run INTEGER PRIMARY KEY, scene INTEGER NOT NULL, engine TEXT, version "
      "TEXT, "
      "precision TEXT, profile TEXT, rate REAL, scale REAL, phases INTEGER, status TEXT NOT NULL, "
      "reason TEXT, verdict TEXT, warnings TEXT, phases_seen INTEGER, steps INTEGER, "
      "cpu_seconds REAL, seconds REAL";
  for (const StoreColumn& column : head.columns)
    if (column.kind == "scene" || column.kind == "setting") runs += ", " + quoted_name(column.name);
  return std::string(kTables) + runs + ");" + kView +
         fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {};", kStoreApplication,
                     kStoreSchema);
}

}  // namespace slipcheck
