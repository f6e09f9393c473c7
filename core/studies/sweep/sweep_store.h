#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "studies/sweep/sqlite.h"

namespace slipcheck {

/// A file that is no store, or none for this sweep; the message is `path: rule, got value`.
class BadStore : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline constexpr int kStoreSchema = 1;

/// A column of `runs` that a parameter has.
struct StoreColumn {
  std::string name;  ///< the parameter's
  std::string unit;  ///< SI; empty of a pure number and a word
  std::string kind;  ///< "scene", "setting", "engine", …
  bool operator==(const StoreColumn&) const = default;
};

/// Which sweep a store holds, and what made it.
struct StoreHead {
  std::string name;        ///< the scene's
  std::string digest;      ///< of what the sweep says, and of the profiles that it takes
  std::uint64_t runs = 0;  ///< of the whole sweep
  std::string program;     ///< "slipcheck 0.1.0 (0123456)"
  std::string text;        ///< the file
  std::vector<StoreColumn> columns;
};

/// A run that has come to its end, one way or another.
struct FinishedRun {
  std::uint64_t run = 0, scene = 0;
  std::size_t phases = 0;                ///< asked for
  std::vector<SqliteValue> parameters;   ///< of scene and settings, in the order of the columns
  const EngineRecord* record = nullptr;  ///< null: of the reference alone
  const Scenario* scenario = nullptr;    ///< null where the scene itself was refused
  const ReferenceResult* reference = nullptr;
  EngineRecord::Status status = EngineRecord::Status::skipped;
  std::string reason;
  double seconds = 0;  ///< of wall time
};

/// Opens a store to read; throws BadStore unless it is one of this version's schema.
std::unique_ptr<SqliteFile> open_store(const std::filesystem::path& path);
StoreHead head_of(SqliteFile& store);

/// The runs that a store has already, as SweepStore::done() says it, without writing to it. Throws
/// BadStore as SweepStore does.
std::vector<bool> runs_done(const std::filesystem::path& path, const StoreHead& head,
                            bool but_failed);

/// The store of one sweep, to write to: an SQLite data base in write-ahead mode, to which each run
/// is committed by itself. One process writes at a time. Whatever ends the process, the file opens
/// again and holds all runs that were added.
class SweepStore {
 public:
  /// Opens the store or makes it, of which nothing stays where it is refused. Throws BadStore where
  /// it is of another schema, sweep or program, where another process writes it, and where it
  /// cannot be written.
  SweepStore(const std::filesystem::path& path, const StoreHead& head);
  ~SweepStore();
  SweepStore(const SweepStore&) = delete;
  SweepStore& operator=(const SweepStore&) = delete;

  /// From any thread. Throws SqliteFailure where it cannot be written; then nothing of the run is.
  void add(const FinishedRun& run);

  /// The runs that are there; without those that may come out otherwise another time (crashed,
  /// timed out, skipped) where `but_failed`.
  std::vector<bool> done(bool but_failed);
  /// How many runs there are of each status.
  std::map<std::string, std::size_t> statuses();
  /// Versions of engines that have run: engine, precision, version.
  std::vector<std::array<std::string, 3>> engines();

  SqliteFile& file() { return *file_; }

 private:
  struct Statements;

  void create(const StoreHead& head);
  std::int64_t name_id(std::string_view name);
  void add_scene(const FinishedRun& run);
  void add_observables(const FinishedRun& run);

  std::filesystem::path path_;
  int lock_ = -1;
  std::unique_ptr<SqliteFile> file_;
  std::unique_ptr<Statements> statements_;
  std::mutex mutex_;
  std::map<std::string, std::int64_t> names_;
  std::vector<std::string> new_names_;  ///< of the transaction that is open
  std::set<std::uint64_t> scenes_;
  std::uint64_t runs_ = 0;
};

}  // namespace slipcheck
