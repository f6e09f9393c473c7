#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/number_range.h"
#include "app/result_outputs.h"
#include "app/say.h"
#include "engine/engine_registry.h"
#include "report/json/read_folders.h"
#include "report/rows/check_rows.h"
#include "report/rows/quantity.h"
#include "report/rows/version_rows.h"
#include "studies/baseline/baseline_json.h"
#include "studies/baseline/update.h"

namespace slipcheck {
namespace {

struct ReportArguments {
  std::vector<std::string> folders, older;
  std::string baselines;
  double threshold = VersionComparison{}.threshold;
  ResultOutputs outputs;
  bool quiet = false;
};

ReadResults read(const std::vector<std::string>& folders) {
  try {
    return read_folders({folders.begin(), folders.end()});
  } catch (const BadJson& bad) {
    throw BadOption(bad.what());
  }
}

/// The run of an older result with the same engine, precision, profile, rate and scale, of whatever
/// version; null without one.
const EngineRecord* same_run(const SceneRecord& older, const EngineRecord& run) {
  const auto found = std::ranges::find_if(older.runs, [&](const EngineRecord& other) {
    return engine_family(other.engine) == engine_family(run.engine) &&
           other.precision == run.precision && other.profile == run.profile &&
           other.rate == run.rate && other.scale == run.scale;
  });
  return found == older.runs.end() ? nullptr : &*found;
}

/// Of one line of the table who it is: there the profile stands for the run.
EngineRecord named(EngineRecord run) {
  run.profile = fmt::format("{} {} {}", run.engine, run.precision, run.profile);
  return run;
}

/// What the results show now beside older ones of the same scenes and runs.
Moved moved_since(const std::vector<SceneRecord>& now, const std::vector<SceneRecord>& before,
                  const std::string& name, double threshold) {
  VersionComparison comparison{"", name, "now", {}, threshold};
  std::size_t fresh = 0, fresh_runs = 0;
  for (const SceneRecord& scene : now) {
    const auto older = std::ranges::find_if(before, [&](const SceneRecord& other) {
      return other.scenario.name == scene.scenario.name;
    });
    if (older == before.end()) {
      ++fresh;
      continue;
    }
    SceneRecord both = scene;
    both.runs.clear();
    std::vector<EngineRecord> after;
    for (const EngineRecord& run : scene.runs) {
      const EngineRecord* old = same_run(*older, run);
      if (old == nullptr) {
        ++fresh_runs;
        continue;
      }
      both.runs.push_back(named(*old));
      after.push_back(named(run));
    }
    both.runs.insert(both.runs.end(), after.begin(), after.end());
    comparison.scenes.push_back(std::move(both));
  }
  const std::vector<VersionChange> changes = version_changes(comparison);
  Moved moved{version_finding(comparison, changes),
              version_table(comparison, changes, changes.size())};
  moved.finding = "From" + moved.finding;  // " results/old → now: …"
  if (fresh + fresh_runs > 0)
    moved.finding +=
        fmt::format("; new are {} and {}", counted(fresh, "scene"), counted(fresh_runs, "run"));
  if (const std::size_t gone = before.size() + fresh - now.size(); gone > 0)
    moved.finding += fmt::format("; {} of the older ones not there any more",
                                 counted(gone, "scene") + (gone == 1 ? " is" : " are"));
  moved.finding += ".";
  return moved;
}

/// Ensembles of other sizes have no number that compares.
void check_sizes(const std::string& file, const SceneBaseline& baseline, const SceneRecord& scene) {
  const SceneBaseline now = baseline_of(scene, baseline.phases, "");
  for (const BaselineRun& run : now.runs)
    for (const BaselineRun& old : baseline.runs)
      if (run_label(run) == run_label(old) && run.status == RunStatus::ok &&
          old.status == RunStatus::ok && run.phases != old.phases)
        throw BadOption(fmt::format(
            "--baselines: results must have {} phases, as {} has of {}, got {} (slipcheck run "
            "--phases {})",
            old.phases, file, run_label(run), run.phases, baseline.phases));
}

/// What the results show now beside what `slipcheck check` keeps in a folder.
Moved moved_since(const std::vector<SceneRecord>& scenes, const std::string& folder) {
  std::vector<std::string> names;
  for (const SceneRecord& scene : scenes) names.push_back(scene.scenario.name);
  std::map<std::string, SceneBaseline> baselines;
  try {
    if (!names.empty()) baselines = load_baselines(folder, names);
  } catch (const BadJson& bad) {
    throw BadOption(bad.what());
  }
  if (baselines.empty())
    throw BadOption(fmt::format("--baselines: {} holds none of these scenes", folder));
  for (const SceneRecord& scene : scenes)
    if (const auto found = baselines.find(scene.scenario.name); found != baselines.end())
      check_sizes(baseline_file(folder, found->first).string(), found->second, scene);
  return moved_since(check_scenes(folder, baselines.begin()->second.phases, baselines, scenes));
}

int report(const ReportArguments& arguments) {
  check_outputs(arguments.outputs);
  ReadResults results = read(arguments.folders);
  if (!arguments.older.empty())
    results.content.moved =
        moved_since(results.content.scenes, read(arguments.older).content.scenes,
                    fmt::format("{}", fmt::join(arguments.older, " ")), arguments.threshold);
  if (!arguments.baselines.empty())
    results.content.moved = moved_since(results.content.scenes, arguments.baselines);
  results.content.commands = {
      fmt::format("slipcheck report {}{}{}{}{}", fmt::join(arguments.folders, " "),
                  arguments.older.empty() ? "" : " --against ", fmt::join(arguments.older, " "),
                  arguments.baselines.empty() ? "" : " --baselines ", arguments.baselines)};
  write_outputs(arguments.outputs, results.content);
  if (!arguments.quiet) {
    for (const std::string& note : results.ignored) say("left out: {}\n", note);
    fmt::print("{}\n", arguments.outputs.html);
  }
  return kWithinTolerance;
}

}  // namespace

void add_report_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "report", "One self-contained page, and other formats, from result folders");
  auto arguments = std::make_shared<ReportArguments>();
  command
      ->add_option("DIR", arguments->folders,
                   "Folders that run, precision and stability have left (--out), or single files")
      ->required();
  add_result_outputs(*command, arguments->outputs, "-o,--html");
  command->get_option("--html")->required();
  CLI::Option* against = command->add_option(
      "--against", arguments->older, "Older result folders: what has moved since stands first");
  command
      ->add_option("--baselines", arguments->baselines,
                   "A folder of slipcheck check's baselines: what has moved since stands first")
      ->excludes(against);
  command
      ->add_option("--threshold", arguments->threshold,
                   "What moves by less counts as unmoved [tolerances]")
      ->check(non_negative_number())
      ->capture_default_str();
  command->add_flag("-q,--quiet", arguments->quiet, "Say nothing");
  command->footer(
      "Exit codes: 0 all was written, whatever the results say; 2 a folder cannot be read.\n\n"
      "Examples:\n"
      "  slipcheck report results/today -o report.html\n"
      "  slipcheck report results/today --against results/yesterday -o report.html\n"
      "  slipcheck report results/today --baselines results/baselines -o report.html\n"
      "  slipcheck report runs/ precision/ stability/ -o all.html --markdown summary.md\n"
      "  slipcheck report runs/ -o report.html --svg charts --xyz trajectories");
  command->callback([arguments, &exit_code] { exit_code = report(*arguments); });
}

}  // namespace slipcheck
