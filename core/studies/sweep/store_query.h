#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "studies/sweep/sqlite.h"

namespace slipcheck {

/// A filter or column that a store has not; the message is a rule.
class BadQuery : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct StoreQuery {
  /// What a row is: a run; an observable of a run; a phase of an observable of a run.
  enum class Rows { runs, observables, phases };
  Rows rows = Rows::runs;
  std::vector<std::string> filters;  ///< "rate>=240", "engine=bullet,ode"; all of them hold
  std::vector<std::string> columns;  ///< of runs; empty: the number, what varies, status, errors
  std::string sort;                  ///< a column, before it - for the largest first; empty: run
  std::size_t limit = 0;             ///< of rows; 0: all
};

struct QueryColumn {
  std::string name, unit;  ///< SI; empty of words and pure numbers
};

struct QueryResult {
  std::vector<QueryColumn> columns;
  std::vector<std::vector<SqliteValue>> rows;
  std::size_t found = 0;  ///< rows without the limit
};

/// What a store says. A column is one of `runs`, a parameter, or an observable ("i.sliding_time",
/// its median) or a statistic of it ("i.sliding_time.max", docs/sweeps.md). Throws BadQuery and
/// SqliteFailure.
QueryResult query_store(SqliteFile& store, const StoreQuery& query);

}  // namespace slipcheck
