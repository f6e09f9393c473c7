#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/bundled_scenes.h"
#include "app/commands.h"
#include "app/grid_options.h"
#include "app/interrupt.h"
#include "app/load_files.h"
#include "app/number_range.h"
#include "app/output.h"
#include "app/progress_bar.h"
#include "app/say.h"
#include "engine/worker_pool.h"
#include "report/charts/report_charts.h"
#include "report/files/files.h"
#include "report/files/stability_csv.h"
#include "report/html/report_page.h"
#include "report/json/stability_json.h"
#include "report/rows/context.h"
#include "report/terminal/stability_table.h"
#include "studies/stability/limits.h"
#include "studies/stability/stability.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

struct StabilityArguments {
  GridArguments common;
  StabilityGrid grid;
  std::string limits = "auto";
  bool all = false;
};

struct StabilityResults {
  std::vector<StabilityCase> cases;
  LimitResults limits;
};

int exit_code_of(const std::vector<StabilityCase>& cases) {
  if (interrupted()) return kInterrupted;
  Outcome worst = Outcome::accurate;
  for (const StabilityCase& each : cases) {
    if (!each.reference.accurate && !each.reference.refused) return kEngineFailed;
    for (const StabilityRun& run : each.runs)
      if (run.outcome != Outcome::refused) worst = std::max(worst, run.outcome);
  }
  if (worst >= Outcome::exploded) return kEngineFailed;
  return worst > Outcome::accurate ? kDeviates : kWithinTolerance;
}

void write_folder(const fs::path& directory, const StabilityArguments& arguments,
                  const StabilityResults& results, const std::string& command) {
  fs::create_directories(directory);
  const auto& [cases, limits] = results;
  write_file_atomically(directory / "stability.json",
                        json_of(cases, arguments.grid, limits).dump(2) + "\n");
  write_file_atomically(directory / "stability.csv", stability_csv(cases));
  if (!limits.limits.empty())
    write_file_atomically(directory / "limits.csv", limits_csv(limits.limits));
  if (!limits.maps.empty()) write_file_atomically(directory / "maps.csv", maps_csv(limits.maps));
  ReportContent content;
  content.context = context();
  content.commands = {command};
  content.cases = cases;
  content.limits = limits;
  content.criteria = arguments.grid.criteria;
  write_file_atomically(directory / "stability.html", report_page(content));
  write_charts_if_drawn(directory, report_charts(content, ChartExtent::all).all());
}

StabilityResults run_all(StabilityArguments& arguments, std::vector<Scenario> cases) {
  GridArguments& common = arguments.common;
  common.options.pool = std::make_shared<WorkerPool>(common.options.workers, common.options.limits);
  StabilityResults results;
  {
    ProgressBar bar("catalogue", !common.quiet);
    common.options.progress = [&](std::size_t done, std::size_t total) { bar.set(done, total); };
    results.cases = run_stability(std::move(cases), arguments.grid, common.options);
  }
  if (arguments.limits == "yes" && !interrupted()) {
    ProgressBar bar("limits", !common.quiet);
    common.options.progress = [&](std::size_t done, std::size_t total) { bar.set(done, total); };
    LimitGrid grid;
    grid.engines = common.engines;
    grid.criteria = arguments.grid.criteria;
    results.limits = find_limits(grid, common.options);
  }
  return results;
}

int examine(StabilityArguments& arguments) {
  GridArguments& common = arguments.common;
  complete(common);
  const bool whole_catalogue = common.files.empty();
  if (whole_catalogue)
    for (const fs::path& file : bundled_scenes("extreme")) common.files.push_back(file.string());
  if (arguments.limits == "auto") arguments.limits = whole_catalogue ? "yes" : "no";
  watch_for_interrupts();
  std::vector<Scenario> cases = load_files(common.files);
  arguments.grid.engines = common.engines;
  std::ranges::sort(arguments.grid.rates);

  if (!common.quiet) say("{}", debug_build_warning());
  const StabilityResults results = run_all(arguments, std::move(cases));
  write_json(common.json,
             [&] { return json_of(results.cases, arguments.grid, results.limits).dump(2) + "\n"; });
  if (!common.directory.empty())
    write_folder(common.directory, arguments, results,
                 whole_catalogue
                     ? "slipcheck stability"
                     : fmt::format("slipcheck stability {}", fmt::join(common.files, " ")));
  if (!common.quiet) {
    if (common.json != "-") {
      const TableStyle style = table_style(arguments.all);
      fmt::print("{}", stability_table(results.cases, style));
      if (!results.limits.limits.empty()) fmt::print("{}", limits_table(results.limits, style));
    }
    if (!common.directory.empty())
      say("{}\n", (fs::path(common.directory) / "stability.html").string());
    if (interrupted()) say("interrupted: what had finished is kept\n");
  }
  return exit_code_of(results.cases);
}

}  // namespace

void add_stability_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "stability",
      "The stiff and extreme cases: how each engine comes out of them, and how far it "
      "works");
  auto arguments = std::make_shared<StabilityArguments>();
  arguments->common.options.phases = 16;
  command->add_option("FILE", arguments->common.files,
                      "Scenario files; else the catalogue, scenarios/extreme");
  add_grid_options(*command, arguments->common);
  command
      ->add_option("--rates", arguments->grid.rates,
                   "Steps per second, separated by commas [Hz]; else each scene's own")
      ->delimiter(',')
      ->check(positive_number());
  command
      ->add_option("--limits", arguments->limits,
                   "Limits by bisection and maps: yes, no, or auto: with the catalogue alone")
      ->check(CLI::IsMember({"auto", "yes", "no"}))
      ->capture_default_str();
  command->add_flag("--all", arguments->all, "Say of every case why");
  command->footer(
      "Exit codes: 0 all is accurate, 1 something is not, 3 an engine explodes, shows NaN, "
      "crashes\n"
      "or hangs.\n\n"
      "Examples:\n"
      "  slipcheck stability --out results/stability\n"
      "  slipcheck stability my-extreme.yaml --profiles default,tuned --precisions double");
  command->callback([arguments, &exit_code] { exit_code = examine(*arguments); });
}

}  // namespace slipcheck
