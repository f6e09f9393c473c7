#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/result_outputs.h"
#include "app/say.h"
#include "report/json/read_folders.h"

namespace slipcheck {
namespace {

struct ReportArguments {
  std::vector<std::string> folders;
  ResultOutputs outputs;
  bool quiet = false;
};

int report(const ReportArguments& arguments) {
  check_outputs(arguments.outputs);
  ReadResults results;
  try {
    results = read_folders({arguments.folders.begin(), arguments.folders.end()});
  } catch (const BadJson& bad) {
    throw BadOption(bad.what());
  }
  results.content.commands = {
      fmt::format("slipcheck report {}", fmt::join(arguments.folders, " "))};
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
  command->add_flag("-q,--quiet", arguments->quiet, "Say nothing");
  command->footer(
      "Exit codes: 0 all was written, whatever the results say; 2 a folder cannot be read.\n\n"
      "Examples:\n"
      "  slipcheck report results/today -o report.html\n"
      "  slipcheck report runs/ precision/ stability/ -o all.html --markdown summary.md\n"
      "  slipcheck report runs/ -o report.html --svg charts --xyz trajectories");
  command->callback([arguments, &exit_code] { exit_code = report(*arguments); });
}

}  // namespace slipcheck
