#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/grid_options.h"
#include "app/interrupt.h"
#include "app/load_files.h"
#include "app/number_range.h"
#include "app/output.h"
#include "app/progress_bar.h"
#include "app/say.h"
#include "report/charts/report_charts.h"
#include "report/files/files.h"
#include "report/files/precision_csv.h"
#include "report/html/report_page.h"
#include "report/json/precision_json.h"
#include "report/rows/context.h"
#include "report/terminal/precision_table.h"
#include "studies/precision/precision.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

struct PrecisionArguments {
  GridArguments common;
  PrecisionGrid grid;
  bool all = false;
};

int exit_code_of(const std::vector<PrecisionScene>& scenes) {
  if (interrupted()) return kInterrupted;
  for (const PrecisionScene& scene : scenes)
    for (const MethodCurve& curve : scene.curves)
      for (const WorkPrecision& point : curve.points)
        if (point.status != RunStatus::ok && point.status != RunStatus::skipped)
          return kEngineFailed;
  return kWithinTolerance;
}

void write_folder(const fs::path& directory, const std::vector<PrecisionScene>& scenes,
                  const PrecisionGrid& grid, const std::string& command) {
  fs::create_directories(directory);
  write_file_atomically(directory / "precision.json", json_of(scenes, grid).dump() + "\n");
  write_file_atomically(directory / "precision.csv", precision_csv(scenes));
  write_file_atomically(directory / "convergence.csv", convergence_csv(scenes));
  ReportContent content;
  content.context = context();
  content.commands = {command};
  content.precision = scenes;
  write_file_atomically(directory / "precision.html", report_page(content));
  write_charts_if_drawn(directory, report_charts(content, ChartExtent::all).all());
}

int measure(PrecisionArguments& arguments) {
  GridArguments& common = arguments.common;
  complete(common);
  watch_for_interrupts();
  std::vector<Scenario> scenarios = load_files(common.files);
  arguments.grid.engines = common.engines;
  std::ranges::sort(arguments.grid.rates);

  if (!common.quiet) say("{}", debug_build_warning());
  std::vector<PrecisionScene> scenes;
  {
    ProgressBar bar("measuring", !common.quiet);
    common.options.progress = [&](std::size_t done, std::size_t total) { bar.set(done, total); };
    scenes = run_precision(std::move(scenarios), arguments.grid, common.options);
  }
  write_json(common.json, [&] { return json_of(scenes, arguments.grid).dump() + "\n"; });
  if (!common.directory.empty())
    write_folder(common.directory, scenes, arguments.grid,
                 fmt::format("slipcheck precision {}", fmt::join(common.files, " ")));
  if (!common.quiet) {
    if (common.json != "-") {
      const TableStyle style = table_style(arguments.all);
      fmt::print("{}", precision_table(scenes, style));
    }
    if (!common.directory.empty())
      say("{}\n", (fs::path(common.directory) / "precision.html").string());
    if (interrupted()) say("interrupted: what had finished is kept\n");
  }
  return exit_code_of(scenes);
}

}  // namespace

void add_precision_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "precision",
      "Error against run time, over rates and solver settings, of engines and of the "
      "reference's own solvers");
  auto arguments = std::make_shared<PrecisionArguments>();
  arguments->common.options.phases = 16;
  command->add_option("FILE", arguments->common.files, "Scenario files")->required();
  add_grid_options(*command, arguments->common);
  command
      ->add_option("--rates", arguments->grid.rates, "Steps per second, separated by commas [Hz]")
      ->delimiter(',')
      ->check(positive_number())
      ->capture_default_str();
  command
      ->add_option("--iterations", arguments->grid.iterations,
                   "Of the engine's solver, beside the profile's own, separated by commas")
      ->delimiter(',')
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command
      ->add_option("--repeats", arguments->grid.repeats,
                   "Of each timing, of which the least counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_flag("--all", arguments->all,
                    "Show every quantity and every number of iterations, not the main ones alone");
  command->footer(
      "Exit codes: 0 all was measured, 3 an engine crashed, hung or became unstable in a run.\n\n"
      "Examples:\n"
      "  slipcheck precision scenarios/symmetric-30cms.yaml --out results/precision\n"
      "  slipcheck precision scene.yaml --profiles default,mine.yaml --precisions double");
  command->callback([arguments, &exit_code] { exit_code = measure(*arguments); });
}

}  // namespace slipcheck
