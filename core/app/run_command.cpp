#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/assembly_files.h"
#include "app/checkpoint_files.h"
#include "app/commands.h"
#include "app/engine_option.h"
#include "app/interrupt.h"
#include "app/limit_options.h"
#include "app/load_files.h"
#include "app/number_range.h"
#include "app/output.h"
#include "app/progress_bar.h"
#include "app/result_outputs.h"
#include "app/say.h"
#include "app/set_option.h"
#include "base/text.h"
#include "engine/profile.h"
#include "harness/run/engine_grid.h"
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
  EngineChoice engines;
  std::optional<std::size_t> headings;
  std::vector<double> scales;
  ResultOutputs outputs;
  RunOptions options;
  CheckpointFiles checkpoints;
  AssemblyFiles assembly;
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
  arguments.assembly.write(content.scenes);
}

void print_warnings(const std::vector<SceneRecord>& scenes) {
  for (const SceneRecord& scene : scenes)
    for (const EngineRecord& run : scene.runs)
      if (run.status != EngineRecord::Status::ok && run.verdict() != Verdict::within)
        say("{}: {} {} {} at {} {}: {}\n", scene.scenario.name, run.engine, run.precision,
            run.profile, run.rate_text(), name_of(run.status), printable(run.reason));
}

/// Of engines that are looked at as a whole where none is asked for [Hz].
constexpr double kRateOfWhole = 1000;

/// A run of many bodies answers when a sample is due and no sooner; its worker holds them some
/// times over, as states, as messages and as text.
void widen_limits(RunOptions& options, const std::vector<Scenario>& scenarios) {
  constexpr std::size_t kBytesOfBody = 4096;
  std::size_t most = 0;
  for (const Scenario& scenario : scenarios) most = std::max(most, scenario.bodies.size());
  options.limits.reply = std::max(options.limits.reply, options.time_limit);
  options.limits.memory = std::max(options.limits.memory, kBytesOfBody * most);
}

/// What is asked for in place of what the scenes say. Profiles that are paths are taken from the
/// working directory.
void choose(const RunArguments& arguments, std::vector<Scenario>& scenarios) {
  EngineChoice engines = arguments.engines;
  if (arguments.assembly.whole && !engines.engines.empty()) {
    // One look at the whole is long: not one for each of the profiles and rates of a comparison.
    if (engines.profiles.empty()) engines.profiles = {"default"};
    if (engines.rates.empty()) engines.rates = {kRateOfWhole};
  }
  for (std::string& profile : engines.profiles)
    if (is_profile_path(profile)) profile = fs::absolute(profile).string();
  for (Scenario& scenario : scenarios) {
    choose_engines(scenario, engines);
    if (arguments.headings) scenario.compare.headings = *arguments.headings;
    if (!arguments.scales.empty()) scenario.compare.scales = arguments.scales;
  }
}

/// The command that gives these results again, but for where they are written.
std::string command_of(const RunArguments& arguments) {
  std::string command = fmt::format("slipcheck run {} --phases {}", fmt::join(arguments.files, " "),
                                    arguments.options.phases);
  const auto add = [&](const char* option, const auto& list) {
    if (!list.empty()) command += fmt::format(" {} {}", option, fmt::join(list, ","));
  };
  add("--engines", arguments.engines.engines);
  add("--precision", arguments.engines.precisions);
  add("--profiles", arguments.engines.profiles);
  add("--rates", arguments.engines.rates);
  if (std::isfinite(arguments.options.budget))
    command += fmt::format(" --budget {}", arguments.options.budget);
  if (arguments.headings) command += fmt::format(" --headings {}", *arguments.headings);
  add("--scales", arguments.scales);
  for (const std::string& setting : arguments.settings) command += " --set " + setting;
  if (arguments.options.general) command += " --general";
  if (arguments.assembly.whole)
    command += fmt::format(" --assembly {} --samples {} --whole{}", arguments.assembly.folder,
                           arguments.assembly.samples,
                           arguments.assembly.engines_only ? " --engines-only" : "");
  return command;
}

int run(RunArguments& arguments) {
  if (arguments.checkpoints.resume && arguments.checkpoints.folder.empty())
    throw BadOption("--resume: needs --checkpoint, the folder to go on from");
  check_output("--json", arguments.json, false);
  check_outputs(arguments.outputs);
  check_output("--out", arguments.directory, true);
  arguments.options.settings = parse_settings(arguments.settings);
  watch_for_interrupts();
  std::vector<Scenario> scenarios = load_files(arguments.files);
  choose(arguments, scenarios);

  arguments.options.whole = arguments.assembly.whole;
  if (arguments.assembly.whole) widen_limits(arguments.options, scenarios);
  arguments.checkpoints.general = arguments.options.general;
  if (arguments.assembly.engines_only && arguments.assembly.whole)
    for (const Scenario& scenario : scenarios)
      if (requests_of(scenario).empty())
        throw BadOption(
            fmt::format("--engines-only: {} has no engine; --engines lammps, say, gives it one",
                        scenario.name));
  arguments.assembly.add_to(arguments.options.extras, scenarios);
  arguments.checkpoints.add_to(arguments.options.extras, scenarios);
  if (arguments.options.whole)
    arguments.options.keep_run = arguments.checkpoints.of_runs(arguments.options.extras);
  arguments.options.stop = &interrupted();
  arguments.options.record_motion = arguments.outputs.show_motion() || !arguments.directory.empty();
  if (is_debug_build() && !arguments.quiet)
    say("warning: this is a debug build; its run times say nothing\n");
  ReportContent content;
  content.context = context();
  {
    ProgressBar bar("running", !arguments.quiet);
    arguments.options.progress = [&](std::size_t done, std::size_t total) { bar.set(done, total); };
    content.scenes = run_scenes(std::move(scenarios), arguments.options);
  }
  content.commands = {command_of(arguments)};
  write_results(arguments, content);
  arguments.checkpoints.settle(content.scenes);
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
    if (!arguments.directory.empty())
      say("{}\n", (fs::path(arguments.directory) / "report.html").string());
    if (interrupted()) say("interrupted: what had finished is kept\n");
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
      ->add_option("--budget", arguments->options.budget,
                   "CPU seconds for the steps of one engine, profile and rate in a scene: of the "
                   "phases every second is run, or every third ..., two at least")
      ->check(positive_number());
  command
      ->add_option("--headings", arguments->headings,
                   "Run each phase in so many headings around the vertical; else as scenes say")
      ->check(CLI::Range(1, kMostHeadings));
  command
      ->add_option("--scales", arguments->scales,
                   "Run similar scenes too, all lengths times these; with commas; 1 is the scene")
      ->delimiter(',')
      ->check(CLI::Range(1e-9, 1e9));
  command
      ->add_option("--engines", arguments->engines.engines,
                   "In place of the scenes' engines these, with commas, or all that are installed")
      ->delimiter(',')
      ->check(installed_engine(true));
  command
      ->add_option("--precision", arguments->engines.precisions,
                   "In place of the scenes' precision single, double, or both with a comma")
      ->delimiter(',')
      ->check(CLI::IsMember({"single", "double"}));
  command
      ->add_option("--profiles", arguments->engines.profiles,
                   "In place of the scenes' profiles these, names or paths, with commas")
      ->delimiter(',');
  command
      ->add_option("--rates", arguments->engines.rates,
                   "In place of the scenes' rates these [Hz], with commas")
      ->delimiter(',')
      ->check(CLI::Range(1e-6, 1e12));
  add_limit_options(*command, arguments->options);
  command
      ->add_option("--threads", arguments->options.threads,
                   "Threads that share the reference of one scene of many soft contacts, with the "
                   "same results; 0: one for each core")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  command->add_option("--assembly", arguments->assembly.folder,
                      "Write what soft scenes of many bodies show as a whole into this folder: "
                      "series and distributions as CSV");
  command
      ->add_option("--samples", arguments->assembly.samples,
                   "That --assembly takes of a run, evenly over its time")
      ->check(CLI::Range(2, 1000000))
      ->capture_default_str();
  command
      ->add_option("--trajectory", arguments->assembly.trajectory,
                   "Write each sample's bodies into that folder too, as the run goes on: xyz for "
                   "OVITO, vtk for ParaView")
      ->check(CLI::IsMember({"xyz", "vtk"}));
  command->add_flag("--whole", arguments->assembly.whole,
                    "With --assembly: look at nothing else. One run of the reference and of each "
                    "engine, whatever the number of bodies, and how their means compare; nothing "
                    "is judged");
  command->add_flag("--engines-only", arguments->assembly.engines_only,
                    "With --whole: leave out the reference, where it would take too long");
  command->add_option("--checkpoint", arguments->checkpoints.folder,
                      "Keep the state of long runs in this folder on their way: of references in "
                      "steps, contacts that last, and with --whole of engines too");
  command
      ->add_option("--checkpoint-every", arguments->checkpoints.every,
                   "Wall-clock seconds from one checkpoint to the next")
      ->check(number_range(0.0, 1e9))
      ->capture_default_str();
  command->add_flag(
      "--resume", arguments->checkpoints.resume,
      "Go on from what --checkpoint has kept, with the same results of the reference; "
      "without any from the start");
  add_set_option(*command, arguments->settings);
  add_ranks_option(*command, arguments->settings);
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
      "  slipcheck run scenarios/*.yaml --engines all --rates 240,1000 --headings 8\n"
      "  slipcheck run scenarios/symmetric-steel.yaml --scales 0.01,1,100\n"
      "  slipcheck run scene.yaml --set erp2=0.4 --html what-if.html\n"
      "  slipcheck run pile.yaml --time-limit 1e6 --checkpoint pile.kept --resume\n"
      "  slipcheck run gas.yaml --engines lammps --set ranks=4 --assembly gas --whole\n"
      "  slipcheck run scene.yaml --json - | jq .verdict");
  command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace slipcheck
