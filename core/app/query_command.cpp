#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/output.h"
#include "report/charts/store_charts.h"
#include "report/files/files.h"
#include "report/html/store_page.h"
#include "report/rows/query_rows.h"
#include "report/terminal/table_style.h"
#include "studies/sweep/store_query.h"
#include "studies/sweep/sweep_store.h"

namespace slipcheck {
namespace {

/// Rows on a terminal, unless told.
constexpr std::size_t kShownRows = 40;

struct QueryArguments {
  std::string store, csv, json, html, svg, outcome;
  StoreQuery query;
  bool observables = false, phases = false;
};

/// The command that gives this page again, but for where it is written.
std::string command_of(const QueryArguments& arguments, const std::string& outcome) {
  return fmt::format("slipcheck query {} {}{}--of {}", arguments.store,
                     fmt::join(arguments.query.filters, " "),
                     arguments.query.filters.empty() ? "" : " ", outcome);
}

/// The page and the folder of charts that are asked for.
void write_views(const QueryArguments& arguments, SqliteFile& store) {
  if (arguments.html.empty() && arguments.svg.empty()) return;
  const std::string outcome = arguments.outcome.empty() ? usual_outcome(store) : arguments.outcome;
  if (outcome.empty()) throw BadQuery("must hold a value to draw: no run shows one");
  const StoreView view = view_of_store(store, arguments.query.filters, outcome);
  const std::vector<Chart> charts = store_charts(view);
  const ChartDrawings drawn = draw_charts(charts);
  if (!arguments.svg.empty()) {
    if (!drawn.trouble.empty()) throw std::runtime_error(drawn.trouble);
    write_charts(arguments.svg, charts, drawn, true);
  }
  if (arguments.html.empty()) return;
  StoreQuery runs = arguments.query;
  if (runs.limit == 0) runs.limit = kMostStoreRows;
  write_file_atomically(arguments.html,
                        store_page(view, query_store(store, runs), charts, drawn,
                                   head_of(store).program, command_of(arguments, outcome)));
}

int query(QueryArguments& arguments) {
  check_output("--csv", arguments.csv, false);
  check_output("--json", arguments.json, false);
  check_output("--html", arguments.html, false);
  check_output("--svg", arguments.svg, true);
  StoreQuery& asked = arguments.query;
  if (arguments.observables) asked.rows = StoreQuery::Rows::observables;
  if (arguments.phases) asked.rows = StoreQuery::Rows::phases;
  const bool is_table = arguments.csv.empty() && arguments.json.empty() && arguments.html.empty() &&
                        arguments.svg.empty();
  if (!arguments.outcome.empty() && arguments.html.empty() && arguments.svg.empty())
    throw BadOption("--of: must stand beside --html or --svg, which show this column");
  if (is_table && asked.limit == 0) asked.limit = kShownRows;
  QueryResult result;
  try {
    const std::unique_ptr<SqliteFile> store = open_store(arguments.store);
    result = query_store(*store, asked);
    write_views(arguments, *store);
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
  auto* phases = command
                     ->add_flag("--phases", arguments->phases,
                                "A row for each phase of each observable with a tolerance")
                     ->excludes(observables);
  auto* page =
      command->add_option("--html", arguments->html,
                          "Write one self-contained page here: which parameter tells most, "
                          "surfaces, scatters, parallel coordinates");
  auto* charts = command->add_option("--svg", arguments->svg,
                                     "Write a folder of these charts, with data and scripts");
  for (CLI::Option* each : {page, charts}) each->excludes(observables)->excludes(phases);
  command->add_option("--of", arguments->outcome,
                      "The column that --html and --svg show; else the first error of what has a "
                      "tolerance");
  command->add_option("--csv", arguments->csv, "Write CSV here; - is stdout");
  command->add_option("--json", arguments->json, "Write JSON here; - is stdout");
  accept_quiet(*command);
  command->footer(
      "Examples:\n"
      "  slipcheck query lottery.db engine=bullet 'rate>=240' status=ok --csv -\n"
      "  slipcheck query lottery.db --html lottery.html --of i-j.effective_restitution.error");
  command->callback([arguments, &exit_code] { exit_code = query(*arguments); });
}

}  // namespace slipcheck
