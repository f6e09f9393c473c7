#include "studies/sweep/sweep_store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <filesystem>
#include <limits>
#include <thread>
#include <utility>

#include "engine/engine_registry.h"
#include "scenario/tolerances.h"
#include "studies/sweep/store_schema.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

[[noreturn]] void refuse(const fs::path& path, const std::string& rule) {
  throw BadStore(fmt::format("{}: {}", path.string(), rule));
}

std::string joined_lines(const std::vector<std::string>& lines) {
  return fmt::format("{}", fmt::join(lines, "\n"));
}

/// Throws BadStore unless the data base is a store that this program can read.
void check_schema(SqliteFile& file, const fs::path& path) {
  if (file.integer_of("PRAGMA application_id") != kStoreApplication)
    refuse(path, "must be a store of slipcheck sweep");
  const std::int64_t schema = file.integer_of("PRAGMA user_version");
  if (schema != kStoreSchema)
    refuse(path, fmt::format("must be a store of schema {}, got {}", kStoreSchema, schema));
}

/// The rule that a data base breaks which SQLite does not take.
std::string rule_of(const SqliteFailure& failure) {
  if ((failure.code() & 0xFF) == SQLITE_NOTADB) return "must be a store of slipcheck sweep";
  return fmt::format("must be a store that can be read: {}", failure.what());
}

bool is_empty(SqliteFile& file) {
  return file.integer_of("PRAGMA application_id") == 0 &&
         file.integer_of("SELECT count(*) FROM sqlite_master") == 0;
}

/// What a writer that was killed had begun to start holds its lock until it is another program.
bool takes_lock(int file) {
  using namespace std::chrono_literals;
  const auto until = std::chrono::steady_clock::now() + 1s;
  while (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    if (std::chrono::steady_clock::now() >= until) return false;
    std::this_thread::sleep_for(10ms);
  }
  return true;
}

}  // namespace

std::unique_ptr<SqliteFile> open_store(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) refuse(path, "must be a readable file");
  try {
    auto file = std::make_unique<SqliteFile>(path, SqliteFile::Access::read);
    check_schema(*file, path);
    return file;
  } catch (const SqliteFailure& failure) {
    refuse(path, rule_of(failure));
  }
}

StoreHead head_of(SqliteFile& store) {
  StoreHead head;
  SqliteStatement values(store, "SELECT key, value FROM sweep");
  while (values.step()) {
    const std::string key = values.text(0);
    if (key == "name") head.name = values.text(1);
    if (key == "digest") head.digest = values.text(1);
    if (key == "runs") head.runs = static_cast<std::uint64_t>(values.integer(1));
    if (key == "program") head.program = values.text(1);
    if (key == "text") head.text = values.text(1);
  }
  SqliteStatement columns(store, "SELECT name, unit, kind FROM parameters ORDER BY number");
  while (columns.step())
    head.columns.push_back({columns.text(0), columns.text(1), columns.text(2)});
  return head;
}

namespace {

/// Throws BadStore unless the store is the one with this head.
void check_head(SqliteFile& file, const fs::path& path, const StoreHead& head) {
  check_schema(file, path);
  const StoreHead there = head_of(file);
  if (there.program != head.program)
    refuse(path,
           fmt::format("must be a store of this {}, got one of {}", head.program, there.program));
  if (there.digest != head.digest || there.runs != head.runs)
    refuse(path, fmt::format("must be the store of this sweep, {} of {} runs, got that of another, "
                             "{} of {} runs",
                             head.name, head.runs, there.name, there.runs));
}

std::vector<bool> done_in(SqliteFile& file, std::uint64_t count, bool but_failed) {
  std::vector<bool> done(count);
  SqliteStatement runs(file, but_failed ? "SELECT run FROM runs WHERE status NOT IN "
                                          "('crashed', 'timed_out', 'skipped')"
                                        : "SELECT run FROM runs");
  while (runs.step()) {
    const auto run = static_cast<std::uint64_t>(runs.integer(0));
    if (run < count) done[run] = true;
  }
  return done;
}

}  // namespace

std::vector<bool> runs_done(const fs::path& path, const StoreHead& head, bool but_failed) {
  const std::unique_ptr<SqliteFile> file = open_store(path);
  check_head(*file, path, head);
  return done_in(*file, head.runs, but_failed);
}

/// What is prepared once.
struct SweepStore::Statements {
  Statements(SqliteFile& file, std::size_t parameters)
      : run(file, "INSERT OR REPLACE INTO runs VALUES (" + places(17 + parameters) + ")"),
        forget(file, "DELETE FROM observables WHERE run = ?"),
        observable(file, "INSERT INTO observables VALUES (" + places(12) + ")"),
        scene(file, "INSERT OR IGNORE INTO scenes VALUES (" + places(6) + ")"),
        reference(file, "INSERT OR IGNORE INTO reference VALUES (" + places(5) + ")"),
        name(file, "INSERT INTO names(name) VALUES (?)") {}

  static std::string places(std::size_t count) {
    std::string text = "?";
    for (std::size_t k = 1; k < count; ++k) text += ",?";
    return text;
  }

  SqliteStatement run, forget, observable, scene, reference, name;
};

SweepStore::SweepStore(const fs::path& path, const StoreHead& head) : path_(path) {
  std::error_code ignored;
  const bool is_new = !fs::exists(path, ignored);
  lock_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock_ < 0) refuse(path, fmt::format("must be a file to write to: {}", std::strerror(errno)));
  const auto close_all = [&] {
    statements_.reset();
    file_.reset();
    ::close(lock_);
    if (!is_new) return;
    for (const char* end : {"", "-wal", "-shm", "-journal"})
      fs::remove(path.string() + end, ignored);
  };
  try {
    if (!takes_lock(lock_))
      refuse(path, "must be written by one process at a time, and another one writes it");
    file_ = std::make_unique<SqliteFile>(path, SqliteFile::Access::write);
    if (is_empty(*file_))
      create(head);
    else
      check_head(*file_, path_, head);
    file_->execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL");
    std::size_t parameters = 0;
    for (const StoreColumn& column : head.columns)
      if (column.kind == "scene" || column.kind == "setting") ++parameters;
    statements_ = std::make_unique<Statements>(*file_, parameters);
    runs_ = head.runs;
    SqliteStatement names(*file_, "SELECT name, id FROM names");
    while (names.step()) names_[names.text(0)] = names.integer(1);
    SqliteStatement scenes(*file_, "SELECT scene FROM scenes");
    while (scenes.step()) scenes_.insert(static_cast<std::uint64_t>(scenes.integer(0)));
  } catch (const SqliteFailure& failure) {
    const std::string rule = rule_of(failure);
    close_all();
    refuse(path, rule);
  } catch (...) {
    close_all();
    throw;
  }
}

SweepStore::~SweepStore() {
  statements_.reset();
  try {
    sqlite3_busy_timeout(file_->get(), 0);
    file_->execute("PRAGMA journal_mode = DELETE");  // one file, where nobody reads it now
  } catch (const std::exception&) {
  }
  file_.reset();
  ::close(lock_);  // after SQLite: closing any descriptor of the file lets its locks go
}

void SweepStore::create(const StoreHead& head) {
  file_->execute("PRAGMA journal_mode = WAL");
  SqliteTransaction transaction(*file_);
  file_->execute(store_tables(head));
  {
    SqliteStatement value(*file_, "INSERT INTO sweep VALUES (?, ?)");
    const auto put = [&](std::string_view key, const SqliteValue& what) {
      value.bind(1, key).bind(2, what).run();
    };
    put("name", head.name);
    put("digest", head.digest);
    put("runs", static_cast<std::int64_t>(head.runs));
    put("program", head.program);
    put("text", head.text);
    SqliteStatement column(*file_, "INSERT INTO parameters(name, kind, unit) VALUES (?, ?, ?)");
    for (const StoreColumn& each : head.columns)
      column.bind(1, std::string_view(each.name))
          .bind(2, std::string_view(each.kind))
          .bind(3, std::string_view(each.unit))
          .run();
  }
  transaction.commit();
}

std::int64_t SweepStore::name_id(std::string_view name) {
  const auto [known, is_new] = names_.try_emplace(std::string(name), 0);
  if (is_new) {
    statements_->name.bind(1, name).run();
    known->second = sqlite3_last_insert_rowid(file_->get());
    new_names_.emplace_back(name);
  }
  return known->second;
}

void SweepStore::add_scene(const FinishedRun& run) {
  if (run.reference == nullptr || scenes_.contains(run.scene)) return;
  const ReferenceResult& reference = *run.reference;
  const auto scene = static_cast<std::int64_t>(run.scene);
  statements_->scene.bind(1, scene)
      .bind(2, std::string_view(reference.solver))
      .bind(3, std::int64_t{reference.run.reached ? 1 : 0})
      .bind(4, std::string_view(reference.run.reason))
      .bind(5, std::string_view(joined_lines(reference.warnings)))
      .bind(6, reference.cpu_seconds)
      .run();
  for (const auto& [name, value] : reference.observables) {
    const auto closed = reference.closed_form.find(name);
    statements_->reference.bind(1, scene)
        .bind(2, name_id(name))
        .bind(3, value.value)
        .bind(4, value.uncertainty)
        .bind(5, closed == reference.closed_form.end() ? kNone : closed->second)
        .run();
  }
}

void SweepStore::add_observables(const FinishedRun& run) {
  const auto number = static_cast<std::int64_t>(run.run);
  statements_->forget.bind(1, number).run();
  if (run.record == nullptr) return;
  std::set<std::string> names;
  for (const auto& [name, value] : run.record->observables) names.insert(name);
  for (const auto& [name, error] : run.record->errors) names.insert(name);
  SqliteStatement& insert = statements_->observable;
  for (const std::string& name : names) {
    insert.bind(1, number).bind(2, name_id(name));
    for (int k = 3; k <= 12; ++k) insert.bind_nothing(k);
    const auto value = run.record->observables.find(name);
    if (value != run.record->observables.end()) {
      const EnsembleValue& ensemble = value->second;
      insert.bind(3, ensemble.median).bind(4, ensemble.min).bind(5, ensemble.max);
      insert.bind(6, static_cast<std::int64_t>(ensemble.missing));
      if (tolerance_of_part(*run.scenario, name)) insert.bind_numbers(12, ensemble.values);
    }
    const auto error = run.record->errors.find(name);
    if (error != run.record->errors.end()) {
      const Deviation& deviation = error->second;
      insert.bind(7, deviation.max).bind(8, deviation.median);
      insert.bind(9, std::int64_t{deviation.absolute ? 1 : 0});
      if (deviation.tolerance) insert.bind(10, *deviation.tolerance);
      insert.bind(11, std::string_view(name_of(deviation.verdict)));
    }
    insert.run();
  }
}

void SweepStore::add(const FinishedRun& run) {
  const std::scoped_lock lock(mutex_);
  new_names_.clear();
  try {
    SqliteTransaction transaction(*file_);
    add_scene(run);
    SqliteStatement& insert = statements_->run;
    insert.bind(1, static_cast<std::int64_t>(run.run));
    insert.bind(2, static_cast<std::int64_t>(run.scene));
    for (int k = 3; k <= 16; ++k) insert.bind_nothing(k);
    if (run.record != nullptr) {
      const EngineRecord& record = *run.record;
      const std::string version =
          record.version.empty() ? engine_version(record.engine) : record.version;
      insert.bind(3, std::string_view(engine_family(record.engine)));
      insert.bind(4, std::string_view(version));
      insert.bind(5, std::string_view(record.precision));
      insert.bind(6, std::string_view(record.profile));
      insert.bind(7, record.rate).bind(8, record.scale);
      insert.bind(9, static_cast<std::int64_t>(run.phases));
      insert.bind(12, std::string_view(name_of(record.verdict())));
      insert.bind(13, std::string_view(joined_lines(record.warnings)));
      insert.bind(14, static_cast<std::int64_t>(record.phases));
      insert.bind(15, static_cast<std::int64_t>(record.steps));
      insert.bind(16, record.cpu_seconds);
    }
    insert.bind(10, std::string_view(name_of(run.status)));
    insert.bind(11, std::string_view(run.reason));
    insert.bind(17, run.seconds);
    for (std::size_t k = 0; k < run.parameters.size(); ++k)
      insert.bind(static_cast<int>(18 + k), run.parameters[k]);
    insert.run();
    add_observables(run);
    transaction.commit();
    scenes_.insert(run.scene);
  } catch (...) {
    for (const std::string& name : new_names_) names_.erase(name);  // gone with the rest
    throw;
  }
}

std::vector<bool> SweepStore::done(bool but_failed) { return done_in(*file_, runs_, but_failed); }

std::map<std::string, std::size_t> SweepStore::statuses() {
  std::map<std::string, std::size_t> counts;
  SqliteStatement rows(*file_, "SELECT status, count(*) FROM runs GROUP BY status");
  while (rows.step()) counts[rows.text(0)] = static_cast<std::size_t>(rows.integer(1));
  return counts;
}

std::vector<std::array<std::string, 3>> SweepStore::engines() {
  std::vector<std::array<std::string, 3>> engines;
  SqliteStatement rows(*file_,
                       "SELECT DISTINCT engine, precision, version FROM runs "
                       "WHERE engine IS NOT NULL AND version <> '' ORDER BY 1, 2, 3");
  while (rows.step()) engines.push_back({rows.text(0), rows.text(1), rows.text(2)});
  return engines;
}

}  // namespace slipcheck
