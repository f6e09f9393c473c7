#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include "app/command_words.h"
#include "app/commands.h"
#include "app/manual_page.h"
#include "app/output.h"
#include "report/files/files.h"
#include "report/rows/context.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

struct ManualArguments {
  std::string command, directory;
};

void print_page(const CommandWords& top, const std::string& name) {
  const CommandWords* command = &top;
  if (!name.empty()) {
    const auto found = std::ranges::find(top.commands, name, &CommandWords::name);
    if (found == top.commands.end())
      throw BadOption(fmt::format("COMMAND: must be a command of slipcheck, got {}", name));
    command = &*found;
  }
  fmt::print("{}", manual_page(top, *command, context().version));
}

void write_pages(const CommandWords& top, const fs::path& directory) {
  fs::create_directories(directory);
  const auto write = [&](const CommandWords& command) {
    write_file_atomically(directory / (page_name(command) + ".1"),
                          manual_page(top, command, context().version));
  };
  write(top);
  for (const CommandWords& command : top.commands) write(command);
}

}  // namespace

void add_manual_command(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("manual", "Print the manual page of a command, or write all of them");
  auto arguments = std::make_shared<ManualArguments>();
  CLI::Option* name = command->add_option("COMMAND", arguments->command,
                                          "As in run; without one the program's own page");
  command
      ->add_option("--out", arguments->directory, "Write the pages of all commands to this folder")
      ->excludes(name);
  accept_quiet(*command);
  command->footer("Examples:\n  slipcheck manual run | man -l -\n  slipcheck manual --out man1");
  command->callback([arguments, &app, &exit_code] {
    const CommandWords top = command_words(app);
    check_output("--out", arguments->directory, true);
    if (arguments->directory.empty())
      print_page(top, arguments->command);
    else
      write_pages(top, arguments->directory);
    exit_code = kWithinTolerance;
  });
}

}  // namespace slipcheck
