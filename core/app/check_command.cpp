#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "app/bundled_scenes.h"
#include "app/commands.h"
#include "app/interrupt.h"
#include "app/limit_options.h"
#include "app/load_files.h"
#include "app/output.h"
#include "app/progress_bar.h"
#include "app/say.h"
#include "app/set_option.h"
#include "app/update_baselines.h"
#include "base/regular_file.h"
#include "base/text.h"
#include "harness/run/scene_run.h"
#include "report/files/check_files.h"
#include "report/files/files.h"
#include "report/html/report_page.h"
#include "report/rows/context.h"
#include "report/terminal/check_table.h"
#include "studies/baseline/baseline_json.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

using Baselines = std::map<std::string, SceneBaseline>;

struct CheckArguments {
  std::vector<std::string> files;
  std::string baselines, changes, why;
  std::string html, junit, markdown, json;
  std::vector<std::string> settings;
  RunOptions options;
  bool update = false, all = false, quiet = false;
};

void check_arguments(const CheckArguments& arguments) {
  if (arguments.update && !arguments.settings.empty())
    throw BadOption(
        "--set: must not stand beside --update, whose baselines are of the settings "
        "as they are shipped");
  if (!arguments.update && !arguments.why.empty())
    throw BadOption("--why: must stand beside --update");
  check_output("--html", arguments.html, false);
  check_output("--junit", arguments.junit, false);
  check_output("--markdown", arguments.markdown, false);
  check_output("--json", arguments.json, false);
  std::error_code ignored;
  if (fs::exists(arguments.baselines, ignored) && !fs::is_directory(arguments.baselines, ignored))
    throw BadOption(fmt::format("--baselines: must be a directory, got {}", arguments.baselines));
  if (arguments.update) {
    check_output("--baselines", arguments.baselines, true);
    check_output("--changes", arguments.changes, false);
    try {
      changes_text(arguments.changes);
    } catch (const UnreadFile& bad) {
      throw BadOption(fmt::format("--changes: {}, got {}", bad.what(), arguments.changes));
    }
  }
}

Baselines load(const CheckArguments& arguments, bool all, const std::vector<Scenario>& scenarios) {
  std::vector<std::string> names;
  if (!all)
    for (const Scenario& scenario : scenarios) names.push_back(scenario.name);
  Baselines baselines;
  try {
    baselines = load_baselines(arguments.baselines, names);
  } catch (const BadJson& bad) {
    throw BadOption(bad.what());
  }
  for (const auto& [scene, baseline] : baselines)
    if (!arguments.update && baseline.phases != arguments.options.phases)
      throw BadOption(fmt::format("--phases: must be {}, as of {}, got {}", baseline.phases,
                                  baseline_file(arguments.baselines, scene).string(),
                                  arguments.options.phases));
  return baselines;
}

/// `all`: baselines of other scenes are left over.
CheckReport hold(const CheckArguments& arguments, const Baselines& baselines,
                 const std::vector<SceneRecord>& scenes, bool all) {
  CheckReport report =
      check_scenes(arguments.baselines, arguments.options.phases, baselines, scenes);
  if (baselines.empty())
    report.advice = fmt::format(
        "there are no baselines yet: slipcheck check{} --baselines {} "
        "--update makes them",
        all ? "" : fmt::format(" {}", fmt::join(arguments.files, " ")), arguments.baselines);
  const auto is_of = [](const std::string& name) {
    return [&name](const SceneRecord& scene) { return scene.scenario.name == name; };
  };
  if (all)
    for (const auto& [name, baseline] : baselines)
      if (std::ranges::none_of(scenes, is_of(name)))
        report.scenes.push_back(
            baseline_without_scene(name, baseline_file(arguments.baselines, name).string()));
  return report;
}

/// The command that gives these results again, but for where they are written.
std::string command_of(const CheckArguments& arguments, bool all) {
  std::string command = "slipcheck check";
  if (!all) command += fmt::format(" {}", fmt::join(arguments.files, " "));
  command +=
      fmt::format(" --baselines {} --phases {}", arguments.baselines, arguments.options.phases);
  for (const std::string& setting : arguments.settings) command += " --set " + setting;
  return command;
}

void write_page(const CheckArguments& arguments, const CheckReport& report,
                const std::vector<SceneRecord>& scenes, bool all) {
  ReportContent content;
  content.context = context();
  content.commands = {command_of(arguments, all)};
  content.moved = moved_since(report);
  content.scenes = scenes;
  write_file_atomically(arguments.html, report_page(content));
}

void write_files(const CheckArguments& arguments, const CheckReport& report) {
  write_json(arguments.json, [&] { return json_of(report).dump(2) + "\n"; });
  if (!arguments.junit.empty())
    write_file_atomically(arguments.junit, junit_xml(test_outcomes(report)));
  if (!arguments.markdown.empty()) write_file_atomically(arguments.markdown, markdown_of(report));
}

/// "bullet 3.24"
std::string engines_of(const std::vector<SceneRecord>& scenes) {
  std::set<std::string> engines;
  for (const SceneRecord& scene : scenes)
    for (const EngineRecord& run : scene.runs)
      if (!run.version.empty()) engines.insert(run.engine + ' ' + run.version);
  return fmt::format("{}", fmt::join(engines, ", "));
}

/// Tells of each reference that has failed and left nothing that could be held against anything.
bool reference_fails(const std::vector<SceneRecord>& scenes) {
  bool fails = false;
  for (const SceneRecord& scene : scenes) {
    if (!scene.reference.run.failed || !scene.reference.observables.empty()) continue;
    fails = true;
    say("{}: its reference failed, and no baseline was written: {}\n", scene.scenario.name,
        printable(scene.reference.run.reason));
  }
  return fails;
}

void update(const CheckArguments& arguments, const Baselines& old,
            const std::vector<SceneRecord>& scenes, const CheckReport& report, bool all) {
  std::vector<SceneBaseline> now;
  for (const SceneRecord& scene : scenes)
    now.push_back(baseline_of(scene, arguments.options.phases, context().version));
  const BaselineUpdate update = update_of(arguments.baselines, old, now, all);
  if (!update.empty())
    write_update(update, arguments.baselines, arguments.changes,
                 changes_line(update, report, engines_of(scenes), arguments.why));
  if (arguments.quiet) return;
  for (const SceneRecord& scene : scenes)
    for (const EngineRecord& run : scene.runs)
      if (run.status != EngineRecord::Status::ok && run.verdict() != Verdict::within)
        say("warning: the baseline of {} has no values of {} {} {} at {}, {}: {}\n",
            scene.scenario.name, run.engine, run.precision, run.profile, run.rate_text(),
            name_of(run.status), printable(run.reason));
  // Scenes that are new or gone are counted below.
  CheckReport compared = report;
  std::erase_if(compared.scenes, [](const SceneCheck& scene) { return scene.compared == 0; });
  std::string text;
  if (!compared.scenes.empty()) text = check_table(compared, table_style(arguments.all)) + '\n';
  text += fmt::format("{}: {} new, {} changed, {} removed, {} as they were\n", arguments.baselines,
                      update.added.size(), update.changed.size(), update.removed.size(),
                      update.unchanged);
  if (!update.empty())
    text += fmt::format("Next: look at git diff {}, {}commit both alone.\n", arguments.baselines,
                        arguments.why.empty()
                            ? fmt::format("say why in the last line of {}, and ", arguments.changes)
                            : fmt::format("and that of {}; ", arguments.changes));
  if (arguments.json == "-")
    say("{}", text);
  else
    fmt::print("{}", text);
}

int check(CheckArguments& arguments) {
  const bool all = arguments.files.empty();
  if (arguments.changes.empty())
    arguments.changes = (fs::path(arguments.baselines) / "../CHANGES.md").lexically_normal();
  check_arguments(arguments);
  arguments.options.settings = parse_settings(arguments.settings);
  if (all)
    for (const fs::path& file : bundled_scenes()) arguments.files.push_back(file.string());
  watch_for_interrupts();
  std::vector<Scenario> scenarios = load_files(arguments.files);
  const Baselines baselines = load(arguments, all, scenarios);

  arguments.options.stop = &interrupted();
  arguments.options.record_motion = !arguments.html.empty();
  if (!arguments.quiet) say("{}", debug_build_warning());
  std::vector<SceneRecord> scenes;
  {
    ProgressBar bar("checking", !arguments.quiet);
    arguments.options.progress = [&](std::size_t done, std::size_t total) { bar.set(done, total); };
    scenes = run_scenes(std::move(scenarios), arguments.options);
  }
  if (interrupted()) {
    // What has not run is no move.
    if (!arguments.quiet) say("interrupted: nothing was written\n");
    return kInterrupted;
  }
  const CheckReport report = hold(arguments, baselines, scenes, all);
  write_files(arguments, report);
  if (!arguments.html.empty()) write_page(arguments, report, scenes, all);
  if (arguments.update) {
    if (reference_fails(scenes)) return kEngineFailed;
    update(arguments, baselines, scenes, report, all);
    return kWithinTolerance;
  }
  if (!arguments.quiet && arguments.json != "-")
    fmt::print("{}", check_table(report, table_style(arguments.all)));
  if (std::ranges::any_of(report.scenes, &SceneCheck::failed)) return kEngineFailed;
  return std::ranges::all_of(report.scenes, &SceneCheck::is_green) ? kWithinTolerance : kDeviates;
}

void add_outputs(CLI::App& command, CheckArguments& arguments) {
  command.add_option("--html", arguments.html,
                     "Write one self-contained page here: what has moved, then all results");
  command.add_option("--junit", arguments.junit,
                     "Write JUnit XML here: a test for each scene's reference and each run");
  command.add_option("--markdown", arguments.markdown,
                     "Write a summary that fits a pull request's comment");
  command.add_option("--json", arguments.json, "Write all changes here; - is stdout");
  command.add_flag("--all", arguments.all,
                   "Print every change, not only the most severe of each run");
  command.add_flag("-q,--quiet", arguments.quiet, "No table, no progress; the exit code tells");
}

void add_running(CLI::App& command, CheckArguments& arguments) {
  command
      .add_option("--phases", arguments.options.phases,
                  "Runs in each ensemble; as many as the baselines were made with")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  add_set_option(command, arguments.settings);
  add_limit_options(command, arguments.options);
}

}  // namespace

void add_check_command(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("check", "Hold scenes against what they gave before, for CI");
  auto arguments = std::make_shared<CheckArguments>();
  std::error_code gone;  // a folder may be removed below its user's feet
  const fs::path beside = bundled_baselines().lexically_proximate(fs::current_path(gone));
  arguments->baselines = (gone || *beside.begin() == ".." ? bundled_baselines() : beside).string();
  arguments->options.phases = 16;
  command->add_option("FILE", arguments->files, "Scenario files; else all bundled scenes");
  command->add_option(
      "--baselines", arguments->baselines,
      "Folder of the baselines, a file for each scene; else that of the bundled scenes");
  command->add_flag("--update", arguments->update,
                    "Propose new baselines: write those that changed, and a line in --changes");
  command->add_option("--why", arguments->why, "With --update: the reason, for that line");
  command->add_option("--changes", arguments->changes,
                      "With --update: the file of that line; else CHANGES.md beside --baselines");
  add_outputs(*command, *arguments);
  add_running(*command, *arguments);
  command->footer(
      "Exit codes: 0 nothing has moved (or --update), 1 something has, for better or worse,\n"
      "3 an engine failed that had not.\n\n"
      "Examples:\n"
      "  slipcheck check --junit check.xml --markdown check.md\n"
      "  slipcheck check my-scene.yaml --baselines my-baselines --update --why 'first numbers'\n"
      "  slipcheck check scenarios/roll-to-rest.yaml --set rolling_friction_factor=2");
  command->callback([arguments, &exit_code] { exit_code = check(*arguments); });
}

}  // namespace slipcheck
