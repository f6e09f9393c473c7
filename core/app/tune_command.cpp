#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/engine_option.h"
#include "app/interrupt.h"
#include "app/limit_options.h"
#include "app/number_range.h"
#include "app/output.h"
#include "app/progress_bar.h"
#include "app/say.h"
#include "app/tune_setup.h"
#include "report/files/files.h"
#include "report/files/tuning_profile.h"
#include "report/json/tuning_json.h"
#include "report/rows/context.h"
#include "report/terminal/tuning_table.h"

namespace slipcheck {
namespace {

/// A line on stderr for each improvement, above the progress bar.
class Progress {
 public:
  Progress(const TuneArguments& arguments, const TuningSpace& space)
      : quiet_(arguments.quiet),
        on_terminal_(!quiet_ && is_plain_terminal(STDERR_FILENO)),
        space_(&space),
        bar_("tuning, evaluations", !quiet_) {}

  void spent(const TuningEvaluator& evaluator) {
    bar_.set(static_cast<std::size_t>(evaluator.spent()),
             static_cast<std::size_t>(evaluator.budget().evaluations));
  }

  void improved(const std::string& step, const TuningCandidate& best,
                const TuningEvaluator& evaluator) const {
    if (quiet_) return;
    const std::string changes = changes_text(*space_, space_->start, best.settings);
    say("{}{:>4.0f} {:<10}  worst {}  {}\n", on_terminal_ ? "\r\x1b[K" : "", evaluator.spent(),
        step, tuning_error_text(best.runs[best.score.worst_run]),
        step == "start" ? space_->start.empty() ? "the engine's own settings" : "" : changes);
  }

 private:
  bool quiet_, on_terminal_;
  const TuningSpace* space_;
  ProgressBar bar_;
};

TuningResult search(const TuneArguments& arguments, const TuneSetup& setup) {
  Progress progress(arguments, setup.record.space);
  RunOptions options;
  options.workers = arguments.workers;
  options.time_limit = arguments.time_limit;
  options.stop = &interrupted();
  const TuningRuns engine = engine_tuning_runs(
      setup.scenes, setup.record.engine, setup.record.precision, setup.record.observables, options);
  TuningEvaluator* spender = nullptr;
  TuningEvaluator evaluator(
      setup.record.tasks, setup.identity, setup.record.observables, setup.record.phases,
      [&](const Settings& settings, std::size_t phases, std::span<const TuningTask* const> tasks) {
        progress.spent(*spender);
        return engine(settings, phases, tasks);
      },
      *setup.journal, arguments.budget);
  spender = &evaluator;
  const auto improved = [&](const std::string& step, const TuningCandidate& best) {
    progress.improved(step, best, evaluator);
  };
  return tune(setup.record.space, evaluator,
              {{setup.record.goal, setup.record.seed, improved}, setup.record.final_phases},
              setup.record.start);
}

int exit_code_of(const TuningResult& result) {
  int code = kWithinTolerance;
  for (const RunScore& run : result.best().runs) {
    if (run.failed > 0 && run.observable.empty()) return kEngineFailed;
    if (run.failed > 0 || run.worst > 1) code = kDeviates;
  }
  return code;
}

int tune_engine(TuneArguments& arguments) {
  check_output("-o", arguments.output, false);
  check_output("--json", arguments.json, false);
  watch_for_interrupts();
  TuneSetup setup = prepare_tuning(arguments);
  if (!arguments.quiet) say("{}", debug_build_warning());
  try {
    setup.record.result = search(arguments, setup);
  } catch (const TuningInterrupted&) {
    if (!arguments.quiet)
      say("interrupted: what had finished is kept in {}; the same command goes on there\n",
          setup.journal_file);
    return kInterrupted;
  }

  const TuningRecord& record = setup.record;
  write_file_atomically(arguments.output, tuned_profile_yaml(record));
  write_json(arguments.json, [&] { return json_of(record).dump(2) + "\n"; });
  if (!arguments.quiet) {
    if (arguments.json != "-") fmt::print("{}", tuning_table(record, table_style()));
    if (!record.result.improved())
      say("nothing that was tried is better than {}: its settings were written\n",
          record.result.best().profile);
    if (record.result.overfitted())
      say("warning: overfitted: scenes that were held out deviate more than twice\n");
    say("{} written; {} has every run and may be deleted\n", arguments.output, setup.journal_file);
  }
  return exit_code_of(record.result);
}

void add_scene_options(CLI::App& command, TuneArguments& arguments) {
  command.add_option("FILE", arguments.files, "Scenario files to fit to")->required();
  command.add_option("--held-out", arguments.held_out,
                     "Scenario files that are not fitted to, to see how far the fit carries");
  command.add_option("--engine", arguments.engine, "The engine whose settings are searched")
      ->required()
      ->check(installed_engine(false));
  command
      .add_option("--precision", arguments.precision,
                  "single or double; else the one that the engine has, of both double")
      ->check(CLI::IsMember({"single", "double"}));
  command.add_option("--rates", arguments.rates, "Steps per second, separated by commas [Hz]")
      ->delimiter(',')
      ->check(positive_number())
      ->capture_default_str();
  command
      .add_option("--observables", arguments.observables,
                  "What counts, separated by commas; else what the scenes have a tolerance for")
      ->delimiter(',');
  command.add_option("--within", arguments.within,
                     "Search the cheapest settings that deviate by no more than this, \"5%\"");
}

void add_search_options(CLI::App& command, TuneArguments& arguments) {
  command
      .add_option("--start", arguments.start,
                  "Profile to start from: a name, or the path of a YAML file")
      ->capture_default_str();
  command
      .add_option("--settings", arguments.settings,
                  "Change only these settings, separated by commas")
      ->delimiter(',');
  command.add_option("--phases", arguments.phases, "Runs in each ensemble of the search")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command
      .add_option("--final-phases", arguments.final_phases,
                  "Runs in each ensemble of the last comparison")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command.add_option("--seed", arguments.seed, "Of the order in which settings are tried")
      ->capture_default_str();
  command
      .add_option(
          "--budget", arguments.budget.evaluations,
          "Evaluations of all scenes at all rates; the pruning and the last comparison come after")
      ->check(non_negative_number())
      ->capture_default_str();
  command
      .add_option("--time", arguments.budget.seconds,
                  "Seconds of wall time for the search, earlier sessions included")
      ->check(positive_number());
  add_time_limit_option(command, arguments.time_limit);
  add_workers_option(command, arguments.workers);
}

}  // namespace

void add_tune_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "tune", "Fit an engine's settings to the reference and write them as a profile");
  auto arguments = std::make_shared<TuneArguments>();
  add_scene_options(*command, *arguments);
  add_search_options(*command, *arguments);
  command->add_option("-o,--output", arguments->output, "The profile; its name is the file's")
      ->capture_default_str();
  command->add_option("--journal", arguments->journal,
                      "Where finished runs are kept, to go on after an interruption; else the "
                      "profile's path with .journal");
  command->add_option("--json", arguments->json, "Write the result here; - is stdout");
  command->add_flag("-q,--quiet", arguments->quiet, "No table, no progress; the exit code tells");
  command->footer(
      "Examples:\n"
      "  slipcheck tune scenarios/symmetric-30cms.yaml scenarios/oblique.yaml --engine bullet \\\n"
      "      --held-out scenarios/asymmetric.yaml -o tuned.yaml\n"
      "  slipcheck tune scene.yaml --engine bullet --within 5% -o fast.yaml");
  command->callback([arguments, &exit_code] { exit_code = tune_engine(*arguments); });
}

}  // namespace slipcheck
