#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/output.h"
#include "report/files/files.h"
#include "report/rows/query_rows.h"
#include "report/terminal/table_style.h"
#include "studies/sweep/store_query.h"
#include "studies/sweep/sweep_store.h"

namespace slipcheck {
namespace {

/// Rows on a terminal, unless told.
constexpr std::size_t kShownRows = 40;

struct QueryArguments {
  std::string store, csv, json;
  StoreQuery query;
  bool observables = false, phases = false;
};

int query(QueryArguments& arguments) {
  check_output("--csv", arguments.csv, false);
  check_output("--json", arguments.json, false);
  StoreQuery& asked = arguments.query;
  if (arguments.observables) asked.rows = StoreQuery::Rows::observables;
  if (arguments.phases) asked.rows = StoreQuery::Rows::phases;
  const bool is_table = arguments.csv.empty() && arguments.json.empty();
  if (is_table && asked.limit == 0) asked.limit = kShownRows;
  QueryResult result;
  try {
    result = query_store(*open_store(arguments.store), asked);
  } catch (const BadQuery& bad) {
    throw BadOption(fmt::format("{}: {}", arguments.store, bad.what()));
  } catch (const SqliteFailure& failure) {
    throw BadStore(
        fmt::format("{}: must be a store that can be read: {}", arguments.store, failure.what()));
  }
  write_json(arguments.json, [&] { return query_json(result) + "\n"; });
  write_json(arguments.csv, [&] { return query_csv(result); });
  if (!is_table) return kWithinTolerance;
  fmt::print("{}", terminal_table(query_table(result), table_style(), 0));
  if (result.found > result.rows.size())
    fmt::print("… and {} more rows (--limit, --csv)\n", result.found - result.rows.size());
  return kWithinTolerance;
}

}  // namespace

void add_query_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("query", "Print what a sweep's store holds, by filters");
  auto arguments = std::make_shared<QueryArguments>();
  command->add_option("STORE", arguments->store, "Of slipcheck sweep or merge")->required();
  command->add_option("FILTER", arguments->query.filters,
                      "Columns compared with values, which all hold: engine=bullet,ode "
                      "rate>=240 'status!=ok'");
  command
      ->add_option("--columns", arguments->query.columns,
                   "Of runs, parameters and observables, with commas: rate,i.sliding_time.max")
      ->delimiter(',');
  command->add_option("--sort", arguments->query.sort,
                      "By this column, after a - the largest first");
  command->add_option("--limit", arguments->query.limit,
                      "At most so many rows; 0: all, of a table "
                      "40");
  auto* observables =
      command->add_flag("--long", arguments->observables, "A row for each observable of each run");
  command
      ->add_flag("--phases", arguments->phases,
                 "A row for each phase of each observable with a tolerance")
      ->excludes(observables);
  command->add_option("--csv", arguments->csv, "Write CSV here; - is stdout");
  command->add_option("--json", arguments->json, "Write JSON here; - is stdout");
  accept_quiet(*command);
  command->footer(
      "Example:\n  slipcheck query lottery.db engine=bullet 'rate>=240' status=ok --csv -");
  command->callback([arguments, &exit_code] { exit_code = query(*arguments); });
}

}  // namespace slipcheck
