#include "studies/sweep/store_query.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "scenario/observable_key.h"
#include "scenario/rules/rules.h"
#include "scenario/units.h"
#include "studies/sweep/scene_path.h"
#include "studies/sweep/sweep_store.h"

namespace slipcheck {
namespace {

/// A column and how SQL comes by it from a row of `runs`.
struct Found {
  QueryColumn column;
  std::string sql;
};

/// Statistics of an observable: from `observables`, and from `reference`.
constexpr std::array<std::string_view, 9> kOfRun = {
    "median", "min", "max", "missing", "error", "error_median", "tolerance", "verdict", "absolute"};
constexpr std::array<std::string_view, 3> kOfReference = {"reference", "uncertainty",
                                                          "closed_form"};

std::string unit_of(const std::string& observable) {
  const ObservableName* known = observable_key(observable).known();
  if (known == nullptr) return "";
  const Dimension& dimension = known->dimension;
  return dimension.angle == 1 && dimension.time == 0 ? "rad" : dimension.si;
}

/// The names that a store knows.
class StoreNames {
 public:
  explicit StoreNames(SqliteFile& store) : head_(head_of(store)) {
    SqliteStatement columns(store, "SELECT name FROM pragma_table_info('runs')");
    while (columns.step()) runs_.push_back(columns.text(0));
    SqliteStatement names(store, "SELECT name, id FROM names");
    while (names.step()) observables_[names.text(0)] = names.integer(1);
  }

  const StoreHead& head() const { return head_; }

  Found find(const std::string& written) const {
    const std::string name = dotted(written);
    if (std::ranges::count(runs_, name) > 0)
      return {{name, unit_of_run(name)}, "r." + quoted_name(name)};
    if (const auto found = observables_.find(written); found != observables_.end())
      return statistic(written, found->second, "median", written);
    const std::size_t dot = written.rfind('.');
    if (dot != std::string::npos) {
      const std::string observable = written.substr(0, dot), rest = written.substr(dot + 1);
      const auto found = observables_.find(observable);
      const bool is_known =
          std::ranges::count(kOfRun, rest) + std::ranges::count(kOfReference, rest) > 0;
      if (found != observables_.end() && is_known)
        return statistic(observable, found->second, rest, written);
    }
    throw BadQuery(fmt::format("must be a column of the store{}, got {}",
                               did_you_mean(written, all()), written));
  }

 private:
  std::string unit_of_run(const std::string& name) const {
    if (name == "rate") return "Hz";
    if (name == "cpu_seconds" || name == "seconds") return "s";
    const auto parameter = std::ranges::find(head_.columns, name, &StoreColumn::name);
    return parameter == head_.columns.end() ? "" : parameter->unit;
  }

  static Found statistic(const std::string& observable, std::int64_t id, const std::string& which,
                         const std::string& name) {
    if (std::ranges::count(kOfReference, which) > 0)
      return {{name, unit_of(observable)},
              fmt::format("(SELECT f.{} FROM reference f WHERE f.scene = r.scene AND "
                          "f.observable = {})",
                          which == "reference" ? "value" : which, id)};
    const bool has_unit = which == "median" || which == "min" || which == "max";
    return {{name, has_unit ? unit_of(observable) : ""},
            fmt::format("(SELECT o.{} FROM observables o WHERE o.run = r.run AND "
                        "o.observable = {})",
                        which, id)};
  }

  std::vector<std::string> all() const {
    std::vector<std::string> names = runs_;
    for (const auto& [name, id] : observables_) names.push_back(name);
    return names;
  }

  StoreHead head_;
  std::vector<std::string> runs_;
  std::map<std::string, std::int64_t> observables_;
};

SqliteValue value_of(const std::string& text) {
  try {
    return parse_number(text);
  } catch (const BadQuantity&) {
    return text;
  }
}

/// A filter as SQL with a place for each of its values.
struct Condition {
  std::string sql;
  std::vector<SqliteValue> values;
};

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(at, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string::npos) return parts;
    begin = end + 1;
  }
}

Condition condition_of(const std::string& filter, const StoreNames& names) {
  const std::size_t sign = filter.find_first_of("=<>!");
  const std::size_t end = filter.find_first_not_of("=<>!", sign);
  std::string operation = filter.substr(std::min(sign, filter.size()), end - sign);
  if (operation == "==") operation = "=";
  const bool is_known = operation == "=" || operation == "!=" || operation == "<" ||
                        operation == "<=" || operation == ">" || operation == ">=";
  if (sign == std::string::npos || sign == 0 || end == std::string::npos || !is_known)
    throw BadQuery(fmt::format(
        "must be a column, one of = != < <= > >=, and a value, as in rate>=240, got {}", filter));
  Condition condition;
  const std::string sql = names.find(filter.substr(0, sign)).sql;
  const std::vector<std::string> values = split(filter.substr(end), ',');
  if (values.size() > 1 && operation != "=" && operation != "!=")
    throw BadQuery(fmt::format("must compare with one value, got {}", filter));
  for (const std::string& value : values) condition.values.push_back(value_of(value));
  std::string places = "?";
  for (std::size_t k = 1; k < values.size(); ++k) places += ", ?";
  if (operation == "=" || operation == "!=")
    condition.sql = fmt::format("{} {} ({})", sql, operation == "=" ? "IN" : "NOT IN", places);
  else  // what is no number is neither more nor less than one
    condition.sql =
        fmt::format("(typeof({0}) <> 'text' OR typeof(?) = 'text') AND {0} {1} ?", sql, operation);
  if (operation != "=" && operation != "!=") condition.values.push_back(condition.values.front());
  return condition;
}

/// The number, what varies and what became of it.
std::vector<std::string> run_columns(const StoreHead& head) {
  std::vector<std::string> columns = {"run"};
  for (const StoreColumn& column : head.columns) columns.push_back(column.name);
  for (const char* name : {"engine"})
    if (std::ranges::count(columns, name) == 0) columns.emplace_back(name);
  columns.emplace_back("status");
  return columns;
}

/// And medians and errors of what has a tolerance; of the reference alone what it shows.
std::vector<std::string> default_columns(SqliteFile& store, const StoreHead& head) {
  std::vector<std::string> columns = run_columns(head);
  SqliteStatement judged(store,
                         "SELECT name FROM names WHERE id IN (SELECT DISTINCT observable FROM "
                         "observables WHERE tolerance IS NOT NULL) ORDER BY name");
  bool any = false;
  while (judged.step()) {
    any = true;
    columns.push_back(judged.text(0));
    columns.push_back(judged.text(0) + ".error");
  }
  if (any || store.integer_of("SELECT count(*) FROM observables") > 0) return columns;
  std::erase(columns, "engine");
  SqliteStatement shown(store,
                        "SELECT name FROM names WHERE id IN (SELECT DISTINCT observable FROM "
                        "reference) ORDER BY name");
  while (shown.step()) columns.push_back(shown.text(0) + ".reference");
  return columns;
}

/// The columns of a row that is no run.
void add_long(StoreQuery::Rows rows, std::vector<Found>& columns) {
  const auto add = [&](const char* name, const char* sql) { columns.push_back({{name, ""}, sql}); };
  add("observable", "n.name");
  if (rows == StoreQuery::Rows::phases) {
    add("phase", "0");
    add("value", "o.per_phase");
  } else {
    for (const char* name : {"median", "min", "max", "missing"})
      columns.push_back({{name, ""}, std::string("o.") + name});
  }
  add("reference", "f.value");
  add("uncertainty", "f.uncertainty");
  if (rows == StoreQuery::Rows::phases) return;
  for (const char* name : {"error", "error_median", "tolerance", "verdict"})
    columns.push_back({{name, ""}, std::string("o.") + name});
}

constexpr const char* kLongJoin =
    " JOIN observables o ON o.run = r.run JOIN names n ON n.id = o.observable"
    " LEFT JOIN reference f ON f.scene = r.scene AND f.observable = o.observable";

class Query {
 public:
  Query(SqliteFile& store, const StoreQuery& query) : store_(store), query_(query), names_(store) {
    std::vector<std::string> columns = query.columns;
    if (columns.empty())
      columns = query.rows == StoreQuery::Rows::runs ? default_columns(store, names_.head())
                                                     : run_columns(names_.head());
    for (const std::string& name : columns) columns_.push_back(names_.find(name));
    if (query.rows != StoreQuery::Rows::runs) add_long(query.rows, columns_);
    source_ = " FROM runs r";
    if (query.rows != StoreQuery::Rows::runs) source_ += kLongJoin;
    std::string where;
    for (const std::string& filter : query.filters) {
      Condition condition = condition_of(filter);
      where += (where.empty() ? " WHERE " : " AND ") + condition.sql;
      values_.insert(values_.end(), condition.values.begin(), condition.values.end());
    }
    if (query.rows == StoreQuery::Rows::phases)
      where += std::string(where.empty() ? " WHERE " : " AND ") + "o.per_phase IS NOT NULL";
    source_ += where;
  }

  QueryResult run() {
    QueryResult result;
    std::string list;
    for (const Found& found : columns_) {
      result.columns.push_back(found.column);
      list += (list.empty() ? "" : ", ") + found.sql;
    }
    SqliteStatement rows(store_, "SELECT " + list + source_ + order());
    bind(rows);
    while (rows.step()) {
      std::vector<SqliteValue> row;
      for (int c = 0; c < rows.columns(); ++c) row.push_back(rows.value(c));
      if (query_.rows == StoreQuery::Rows::phases)
        add_phases(result, row, rows);
      else
        add(result, std::move(row));
    }
    return result;
  }

 private:
  /// `observable` too, where each is a row.
  Condition condition_of(const std::string& filter) const {
    const std::string_view name = "observable=";
    if (query_.rows == StoreQuery::Rows::runs || !filter.starts_with(name))
      return slipcheck::condition_of(filter, names_);
    return {"n.name = ?", {filter.substr(name.size())}};
  }

  std::string order() const {
    const std::string last = query_.rows == StoreQuery::Rows::runs ? "r.run" : "r.run, n.name";
    if (query_.sort.empty()) return " ORDER BY " + last;
    const bool falling = query_.sort.starts_with('-');
    return fmt::format(" ORDER BY {} {}, {}", names_.find(query_.sort.substr(falling ? 1 : 0)).sql,
                       falling ? "DESC" : "ASC", last);
  }

  void bind(SqliteStatement& statement) const {
    for (std::size_t k = 0; k < values_.size(); ++k)
      statement.bind(static_cast<int>(k + 1), values_[k]);
  }

  void add(QueryResult& result, std::vector<SqliteValue> row) const {
    ++result.found;
    if (query_.limit == 0 || result.rows.size() < query_.limit)
      result.rows.push_back(std::move(row));
  }

  void add_phases(QueryResult& result, const std::vector<SqliteValue>& row,
                  const SqliteStatement& rows) const {
    const auto phase = static_cast<std::size_t>(
        std::ranges::find(result.columns, "phase", &QueryColumn::name) - result.columns.begin());
    const std::vector<double> values = rows.numbers(static_cast<int>(phase + 1));
    for (std::size_t k = 0; k < values.size(); ++k) {
      std::vector<SqliteValue> each = row;
      each[phase] = static_cast<std::int64_t>(k);
      each[phase + 1] = values[k];
      add(result, std::move(each));
    }
  }

  SqliteFile& store_;
  const StoreQuery& query_;
  StoreNames names_;
  std::vector<Found> columns_;
  std::string source_;
  std::vector<SqliteValue> values_;
};

}  // namespace

QueryResult query_store(SqliteFile& store, const StoreQuery& query) {
  return Query(store, query).run();
}

}  // namespace slipcheck
