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
#include "engine/engine_registry.h"
#include "engine/remote_engine.h"
#include "report/charts/report_charts.h"
#include "report/files/files.h"
#include "report/html/report_page.h"
#include "report/json/versions_json.h"
#include "report/rows/version_rows.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostShown = 20;  // on the terminal, without --all

struct VersionsArguments {
  GridArguments common;
  VersionComparison comparison;
  std::vector<double> rates = {240};
  bool all = false;
};

/// The name under which an engine is installed in a version, "rapier@0.19.3", or "bullet" where the
/// one that is there has that version. Throws BadOption.
std::string installed_name(const std::string& engine, const std::string& version) {
  std::vector<std::string> names;
  for (const EngineExecutable& each : find_engines()) {
    if (engine_family(each.engine) != engine) continue;
    const std::string named = engine_version(each.engine);
    if (named == version) return each.engine;
    if (!named.empty()) {
      names.push_back(named);
      continue;
    }
    try {
      const std::string found = RemoteEngine(each.command).info().version;
      if (found == version) return each.engine;
      names.push_back(found);
    } catch (const WorkerFailure&) {
    }
  }
  names.erase(std::unique(names.begin(), names.end()), names.end());
  throw BadOption(fmt::format(
      "{} {} is not installed ({}); slipcheck engines add {}@{} may have it", engine, version,
      names.empty() ? "there is no version of it"
                    : fmt::format("there are {}", fmt::join(names, ", ")),
      engine, version));
}

/// Each scene asks for all of the version before, then for the same of the one after.
void ask_for_both(std::vector<Scenario>& scenarios, const VersionsArguments& arguments) {
  const VersionComparison& comparison = arguments.comparison;
  EngineGrid grid = arguments.common.engines;
  grid.engines = {installed_name(comparison.engine, comparison.before),
                  installed_name(comparison.engine, comparison.after)};
  for (Scenario& scenario : scenarios) ask_for(scenario, grid, arguments.rates);
}

void write_folder(const fs::path& directory, const VersionComparison& comparison,
                  const std::vector<VersionChange>& changes, const std::string& command) {
  fs::create_directories(directory);
  write_file_atomically(directory / "versions.json", json_of(comparison, changes).dump(2) + "\n");
  ReportContent content;
  content.context = context();
  content.commands = {command};
  content.moved = {version_finding(comparison, changes),
                   version_table(comparison, changes, changes.size())};
  content.scenes = comparison.scenes;
  write_file_atomically(directory / "versions.html", report_page(content));
  write_charts_if_drawn(directory, report_charts(content, ChartExtent::page).all());
}

int exit_code_of(const VersionComparison& comparison, const std::vector<VersionChange>& changes) {
  if (interrupted()) return kInterrupted;
  const VersionTotals totals = totals_of(comparison, changes);
  if (totals.failed > 0) return kEngineFailed;
  return changes.empty() && totals.compared > 0 ? kWithinTolerance : kDeviates;
}

int compare(VersionsArguments& arguments) {
  GridArguments& common = arguments.common;
  complete(common);
  const bool all_scenes = common.files.empty();
  if (all_scenes)
    for (const fs::path& file : bundled_scenes()) common.files.push_back(file.string());
  watch_for_interrupts();
  std::vector<Scenario> scenarios = load_files(common.files);
  ask_for_both(scenarios, arguments);

  if (!common.quiet) say("{}", debug_build_warning());
  VersionComparison& comparison = arguments.comparison;
  {
    ProgressBar bar("comparing", !common.quiet);
    common.options.progress = [&](std::size_t done, std::size_t total) { bar.set(done, total); };
    comparison.scenes = run_scenes(std::move(scenarios), common.options);
  }
  const std::vector<VersionChange> changes = version_changes(comparison);
  write_json(common.json, [&] { return json_of(comparison, changes).dump(2) + "\n"; });
  if (!common.directory.empty())
    write_folder(common.directory, comparison, changes,
                 fmt::format("slipcheck versions {} {} {}{}{}", comparison.engine,
                             comparison.before, comparison.after, all_scenes ? "" : " ",
                             all_scenes ? "" : fmt::format("{}", fmt::join(common.files, " "))));
  if (!common.quiet) {
    if (common.json != "-") {
      const std::size_t most = arguments.all ? changes.size() : kMostShown;
      fmt::print("{}\n", version_finding(comparison, changes));
      if (!changes.empty())
        fmt::print("\n{}", terminal_table(version_table(comparison, changes, most),
                                          table_style(arguments.all), 2));
      if (changes.size() > most) fmt::print("  and {} more: --all\n", changes.size() - most);
    }
    if (!common.directory.empty())
      say("{}\n", (fs::path(common.directory) / "versions.html").string());
    if (interrupted()) say("interrupted: what had finished is kept\n");
  }
  return exit_code_of(comparison, changes);
}

}  // namespace

void add_versions_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "versions", "What changed between two versions of an engine, over the phases of each scene");
  auto arguments = std::make_shared<VersionsArguments>();
  arguments->common.engines.profiles = {"default"};
  VersionComparison& comparison = arguments->comparison;
  command->add_option("ENGINE", comparison.engine, "As in rapier")->required();
  command->add_option("BEFORE", comparison.before, "A version that is installed")->required();
  command->add_option("AFTER", comparison.after, "Another one")->required();
  command->add_option("FILE", arguments->common.files, "Scenario files; else all bundled ones");
  add_grid_options(*command, arguments->common, GridEngines::given);
  command->add_option("--rates", arguments->rates, "Steps per second, separated by commas [Hz]")
      ->delimiter(',')
      ->check(positive_number())
      ->capture_default_str();
  command
      ->add_option("--threshold", comparison.threshold,
                   "What moves by less counts as unmoved [tolerances]")
      ->check(non_negative_number())
      ->capture_default_str();
  command->add_flag("--all", arguments->all, "Show every change");
  command->footer(
      "Exit codes: 0 nothing has moved, 1 something has or nothing could be compared, 3 the later "
      "version fails in a run.\n\n"
      "Examples:\n"
      "  slipcheck versions rapier 0.19.3 0.21.0\n"
      "  slipcheck versions rapier 0.19.3 0.21.0 scenarios/bouncing-ball.yaml --out "
      "build/versions");
  command->callback([arguments, &exit_code] { exit_code = compare(*arguments); });
}

}  // namespace slipcheck
