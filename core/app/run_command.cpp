#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/load_files.h"
#include "app/output.h"
#include "app/progress_bar.h"
#include "app/result_outputs.h"
#include "app/set_option.h"
#include "harness/run/scene_run.h"
#include "report/files/files.h"
#include "report/files/result_csv.h"
#include "report/html/report_page.h"
#include "report/json/json_report.h"
#include "report/json/motion_json.h"
#include "report/rows/context.h"
#include "report/terminal/brief.h"
#include "report/terminal/table.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

struct RunArguments {
  std::vector<std::string> files, settings;
  std::string json, directory;
  ResultOutputs outputs;
  RunOptions options;
  std::size_t memory_limit = 2048;  // MiB
  bool all = false, summary = false, quiet = false;
};

int exit_code_of(const std::vector<SceneRecord>& scenes, bool allow_undecided) {
  if (interrupted()) return kInterrupted;
  int code = kWithinTolerance;
  for (const SceneRecord& scene : scenes) {
    const Verdict verdict = scene.verdict();
    if (verdict == Verdict::failed) return kEngineFailed;
    if (verdict == Verdict::deviates || (verdict == Verdict::undecided && !allow_undecided))
      code = kDeviates;
  }
  return code;
}

/// What `slipcheck report` makes its page of, and that page.
void write_folder(const fs::path& directory, const ReportContent& content) {
  fs::create_directories(directory);
  for (const SceneRecord& scene : content.scenes) {
    const fs::path stem = directory / scene.scenario.name;
    write_file_atomically(stem.string() + ".json", json_of(scene).dump(2) + "\n");
    if (has_motions(scene))
      write_file_atomically(stem.string() + ".motion.json", motion_json_of(scene).dump() + "\n");
  }
  write_file_atomically(directory / "results.csv", results_csv(content.scenes));
  write_file_atomically(directory / "report.html", report_page(content));
}

void write_results(const RunArguments& arguments, const ReportContent& content) {
  write_json(arguments.json, [&] { return json_of(content.scenes).dump(2) + "\n"; });
  write_outputs(arguments.outputs, content);
  if (!arguments.directory.empty()) write_folder(arguments.directory, content);
}

void print_warnings(const std::vector<SceneRecord>& scenes) {
  for (const SceneRecord& scene : scenes)
    for (const EngineRecord& run : scene.runs)
      if (run.status != EngineRecord::Status::ok && run.verdict() != Verdict::within)
        fmt::print(stderr, "{}: {} {} {} at {:g} Hz {}: {}\n", scene.scenario.name, run.engine,
                   run.precision, run.profile, run.rate, name_of(run.status), run.reason);
}

int run(RunArguments& arguments) {
  check_output("--json", arguments.json, false);
  check_outputs(arguments.outputs);
  check_output("--out", arguments.directory, true);
  arguments.options.settings = parse_settings(arguments.settings);
  watch_for_interrupts();
  std::vector<Scenario> scenarios = load_files(arguments.files);

  arguments.options.stop = &interrupted();
  arguments.options.record_motion = arguments.outputs.show_motion() || !arguments.directory.empty();
  arguments.options.limits.memory = arguments.memory_limit << 20;
  if (is_debug_build() && !arguments.quiet)
    fmt::print(stderr, "warning: this is a debug build; its run times say nothing\n");
  ReportContent content;
  content.context = context();
  {
    ProgressBar bar("running", !arguments.quiet && is_plain_terminal(STDERR_FILENO));
    arguments.options.progress = [&](std::size_t done, std::size_t total) { bar.set(done, total); };
    content.scenes = run_scenes(std::move(scenarios), arguments.options);
  }
  std::string command = fmt::format("slipcheck run {} --phases {}", fmt::join(arguments.files, " "),
                                    arguments.options.phases);
  for (const std::string& setting : arguments.settings) command += " --set " + setting;
  if (arguments.options.general) command += " --general";
  content.commands = {command};
  write_results(arguments, content);
  const std::vector<SceneRecord>& scenes = content.scenes;
  if (!arguments.quiet) {
    if (arguments.json != "-") {
      const TableStyle style = table_style(arguments.all);
      if (arguments.summary)
        fmt::print("{}\n", brief_of(scenes, style));
      else
        for (const SceneRecord& scene : scenes) fmt::print("{}\n", table_of(scene, style));
      fmt::print("{}", summary_of(scenes, style));
    }
    print_warnings(scenes);
    if (interrupted()) fmt::print(stderr, "interrupted: what had finished is kept\n");
  }
  return exit_code_of(scenes, arguments.outputs.allow_undecided);
}

}  // namespace

void add_run_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "run", "Run scenes in the reference and in engines and print how far they are apart");
  auto arguments = std::make_shared<RunArguments>();
  command->add_option("FILE", arguments->files, "Scenario files")->required();
  command->add_option("--json", arguments->json, "Write the result file here; - is stdout");
  command->add_option("--out", arguments->directory,
                      "Write a result folder: JSON files for each scene, a CSV file, and "
                      "report.html");
  add_result_outputs(*command, arguments->outputs, "--html");
  command
      ->add_option("--phases", arguments->options.phases,
                   "Runs in each engine's ensemble, by where in a step the first contact falls")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command
      ->add_option("--workers", arguments->options.workers,
                   "Engines at work at once; 0: one for each core")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  command
      ->add_option("--time-limit", arguments->options.time_limit,
                   "Wall-clock seconds for one run of an engine, and for a scene's reference")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--memory-limit", arguments->memory_limit, "MiB for one engine")
      ->check(CLI::Range(16, 1 << 20))
      ->capture_default_str();
  add_set_option(*command, arguments->settings);
  add_general_option(*command, arguments->options.general);
  command->add_flag("--all", arguments->all,
                    "Show every observable, not only those with a tolerance");
  command->add_flag("--summary", arguments->summary,
                    "One line for each scene instead of its table");
  command->add_flag("-q,--quiet", arguments->quiet, "No table, no progress; the exit code tells");
  command->footer(
      "Examples:\n"
      "  slipcheck run scenarios/symmetric-30cms.yaml --phases 64\n"
      "  slipcheck run scenarios/*.yaml --out results/today\n"
      "  slipcheck run scene.yaml --set erp2=0.4 --html what-if.html\n"
      "  slipcheck run scene.yaml --json - | jq .verdict");
  command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace slipcheck
