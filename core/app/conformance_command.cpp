#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/number_range.h"
#include "app/output.h"
#include "app/progress_bar.h"
#include "engine/engine_registry.h"
#include "report/json/conformance_json.h"
#include "report/rows/conformance_rows.h"
#include "report/terminal/table_style.h"
#include "studies/conformance/conformance.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

struct ConformanceArguments {
  std::string engine, precision, json;
  std::vector<std::string> only;
  double reply_limit = WorkerLimits{}.reply;
  bool quiet = false;
};

/// The worker at a path, or those of an engine's name.
std::vector<WorkerCommand> chosen_workers(const ConformanceArguments& arguments) {
  const std::string& engine = arguments.engine;
  std::error_code ignored;
  if (engine.find('/') != std::string::npos || fs::is_regular_file(engine, ignored)) {
    const fs::path path = fs::absolute(engine);
    if (!fs::is_regular_file(path, ignored))
      throw BadOption(
          fmt::format("ENGINE: must be an engine or a worker's file, there is no {}", engine));
    if (access(path.c_str(), X_OK) != 0)
      throw BadOption(fmt::format("ENGINE: must be executable (chmod +x), {} is not", engine));
    return {WorkerCommand(path)};
  }
  std::vector<WorkerCommand> workers;
  std::string known;
  for (const EngineExecutable& each : find_engines()) {
    known += fmt::format("{}{} {}", known.empty() ? "" : ", ", each.engine, each.precision);
    const bool same_precision =
        arguments.precision.empty() || each.precision == arguments.precision;
    if ((each.engine == engine || engine_family(each.engine) == engine) && same_precision)
      workers.push_back(each.command);
  }
  if (workers.empty())
    throw BadOption(fmt::format("ENGINE: must be the path of a worker or one of {}, got {}{}",
                                known.empty() ? "none that is here" : known, engine,
                                arguments.precision.empty() ? "" : " " + arguments.precision));
  return workers;
}

void print(const ConformanceReport& report) {
  if (report.no_start.empty())
    fmt::print("{}  {} {} {}\n\n", report.executable.program.string(), report.engine,
               report.version, report.precision);
  else
    fmt::print("{}  the worker cannot start\n\n", report.executable.program.string());
  if (!report.no_start.empty()) {
    const char* mend =
        "It must be an executable file: a program, or a script whose first line names its "
        "interpreter (#!/usr/bin/env python3) and whose modules are installed; run it by hand to "
        "see "
        "what it says.";
    fmt::print("{}\n", paragraph("✗ ", fmt::format("{}. {}", report.no_start, mend), Tone::bad,
                                 table_style()));
    return;
  }
  const TextTable table = conformance_table(report);
  fmt::print("{}\n", terminal_table(table, table_style(), 2));
  for (const auto& [name, text] : table.notes)
    fmt::print("{}", paragraph(fmt::format("✗ {}: ", name), text, Tone::bad, table_style()));
  fmt::print("{}{}\n", table.notes.empty() ? "" : "\n", conformance_counts(report));
}

int exit_code_of(const std::vector<ConformanceReport>& reports) {
  int code = kWithinTolerance;
  for (const ConformanceReport& report : reports) {
    if (!report.no_start.empty()) return kEngineFailed;
    if (report.count(CheckVerdict::failed) > 0) code = kDeviates;
  }
  return code;
}

int ask_all(const ConformanceArguments& arguments) {
  check_output("--json", arguments.json, false);
  const std::vector<WorkerCommand> workers = chosen_workers(arguments);
  watch_for_interrupts();
  std::vector<ConformanceReport> reports;
  for (const WorkerCommand& worker : workers) {
    ProgressBar bar("asking", !arguments.quiet);
    ConformanceOptions options;
    options.limits.reply = arguments.reply_limit;
    options.stop = &interrupted();
    options.only = arguments.only;
    options.progress = [&](std::size_t done, std::size_t total) { bar.set(done, total); };
    reports.push_back(check_conformance(worker, options));
  }
  write_json(arguments.json, [&] { return json_of(reports).dump(2) + "\n"; });
  if (!arguments.quiet && arguments.json != "-")
    for (const ConformanceReport& report : reports) print(report);
  return exit_code_of(reports);
}

}  // namespace

void add_conformance_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "conformance", "Hold an engine's worker against the protocol; tells what to mend");
  auto arguments = std::make_shared<ConformanceArguments>();
  command
      ->add_option("ENGINE", arguments->engine,
                   "An engine's name, for each of its precisions, or the path of a worker")
      ->required();
  command->add_option("--precision", arguments->precision, "Of an engine's workers only this one")
      ->check(CLI::IsMember({"single", "double"}));
  command->add_option("--reply-limit", arguments->reply_limit, "Time that a reply may take [s]")
      ->check(number_range(0.1, 3600.0))
      ->capture_default_str();
  command->add_option("--only", arguments->only, "Checks, by their names, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(conformance_check_names()));
  command->add_option("--json", arguments->json, "The same as JSON; - for stdout");
  command->add_flag("-q,--quiet", arguments->quiet, "No table; the exit code tells");
  command->footer(
      "Exit codes: 0 all that could be asked has passed, 1 something failed, 2 there is no such "
      "worker,\n3 it cannot start.\n\n"
      "Examples:\n"
      "  slipcheck conformance bullet\n"
      "  slipcheck conformance bullet --only \"free fall,rest stays\"\n"
      "  slipcheck conformance docs/example-engine/slipcheck-engine-example-double");
  command->callback([arguments, &exit_code] { exit_code = ask_all(*arguments); });
}

}  // namespace slipcheck
