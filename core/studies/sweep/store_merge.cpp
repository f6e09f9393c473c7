#include "studies/sweep/store_merge.h"

#include <fmt/format.h>

#include <system_error>

#include "studies/sweep/sweep_store.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

/// What a run's status counts for, the least first.
constexpr const char* kRank = "CASE {}.status WHEN 'ok' THEN 0 WHEN 'unstable' THEN 1 ELSE 2 END";

/// The statements that take over from the data base `other`.
std::string taking() {
  const std::string better = fmt::format("{} < {}", fmt::format(fmt::runtime(kRank), "theirs"),
                                         fmt::format(fmt::runtime(kRank), "ours"));
  return "CREATE TEMP TABLE taken AS SELECT theirs.run FROM other.runs AS theirs "
         "LEFT JOIN main.runs AS ours USING(run) WHERE ours.run IS NULL OR " +
         better +
         ";"
         "INSERT OR IGNORE INTO main.names(name) SELECT name FROM other.names ORDER BY id;"
         "INSERT OR REPLACE INTO main.runs SELECT * FROM other.runs "
         "WHERE run IN (SELECT run FROM temp.taken);"
         "DELETE FROM main.observables WHERE run IN (SELECT run FROM temp.taken);"
         "INSERT INTO main.observables SELECT o.run, ours.id, o.median, o.min, o.max, o.missing, "
         "o.error, o.error_median, o.absolute, o.tolerance, o.verdict, o.per_phase "
         "FROM temp.taken JOIN other.observables AS o USING(run) "
         "JOIN other.names AS theirs ON theirs.id = o.observable "
         "JOIN main.names AS ours ON ours.name = theirs.name;"
         "INSERT OR IGNORE INTO main.scenes SELECT * FROM other.scenes;"
         "INSERT OR IGNORE INTO main.reference SELECT r.scene, ours.id, r.value, r.uncertainty, "
         "r.closed_form FROM other.reference AS r JOIN other.names AS theirs "
         "ON theirs.id = r.observable JOIN main.names AS ours ON ours.name = theirs.name;";
}

void check_same(const fs::path& first, const StoreHead& head, const fs::path& path,
                const StoreHead& other) {
  if (other.digest != head.digest || other.runs != head.runs || other.columns != head.columns)
    throw BadStore(
        fmt::format("{}: must be a store of the same sweep as {}, {} of {} runs, got "
                    "that of another, {} of {} runs",
                    path.string(), first.string(), head.name, head.runs, other.name, other.runs));
  if (other.program != head.program)
    throw BadStore(fmt::format("{}: must be of the same program as {}, {}, got one of {}",
                               path.string(), first.string(), head.program, other.program));
}

}  // namespace

MergedStores merge_stores(const fs::path& into, const std::vector<fs::path>& from) {
  const StoreHead head = head_of(*open_store(from.front()));
  for (const fs::path& path : from) {
    std::error_code ignored;
    if (fs::equivalent(path, into, ignored))
      throw BadStore(
          fmt::format("{}: must not be among the stores that are put into it", into.string()));
    check_same(from.front(), head, path, head_of(*open_store(path)));
  }
  SweepStore store(into, head);
  MergedStores merged;
  for (const fs::path& path : from) {
    store.file().attach(path, "other");
    {
      SqliteTransaction transaction(store.file());
      store.file().execute(taking());
      merged.taken +=
          static_cast<std::size_t>(store.file().integer_of("SELECT count(*) FROM temp.taken"));
      store.file().execute("DROP TABLE temp.taken");
      transaction.commit();
    }
    store.file().execute("DETACH other");
  }
  merged.runs = static_cast<std::size_t>(store.file().integer_of("SELECT count(*) FROM runs"));
  merged.total = head.runs;
  return merged;
}

}  // namespace slipcheck
