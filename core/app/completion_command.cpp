#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <string>

#include "app/command_words.h"
#include "app/commands.h"
#include "app/completion_scripts.h"

namespace slipcheck {

void add_completion_command(CLI::App& app, int& exit_code) {
  static const std::map<std::string, std::string (*)(const CommandWords&)> scripts = {
      {"bash", bash_completion}, {"fish", fish_completion}, {"zsh", zsh_completion}};
  CLI::App* command =
      app.add_subcommand("completion", "Print what makes a shell complete commands and options");
  auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "Which shell")->required()->check(CLI::IsMember(scripts));
  accept_quiet(*command);
  command->footer(
      "An installed program's are where these shells look for them.\n\n"
      "Examples:\n  source <(slipcheck completion bash)\n"
      "  slipcheck completion fish > ~/.config/fish/completions/slipcheck.fish");
  command->callback([shell, &app, &exit_code] {
    fmt::print("{}", scripts.at(*shell)(command_words(app)));
    exit_code = kWithinTolerance;
  });
}

}  // namespace slipcheck
