#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/list_engines.h"
#include "app/print_list.h"
#include "engine/npm_install.h"
#include "engine/remote_engine.h"

namespace slipcheck {
namespace {

struct EnginesArguments {
  std::vector<std::string> names;
  bool as_json = false, quiet = false;
};

/// All names are looked at before anything is done.
std::vector<NpmChoice> choices_of(const std::vector<std::string>& names) {
  std::vector<NpmChoice> choices;
  for (const std::string& name : names) choices.push_back(npm_choice(name));
  return choices;
}

void add(const EnginesArguments& arguments) {
  watch_for_interrupts();  // npm ends by itself, and what it left behind goes
  for (const NpmChoice& choice : choices_of(arguments.names)) {
    const EngineExecutable engine = install_engine(choice);
    if (!arguments.quiet)
      fmt::print("{} ({} precision, {})\n", engine.engine, engine.precision,
                 (engines_folder() / engine.engine).string());
  }
}

void remove(const EnginesArguments& arguments) {
  for (const NpmChoice& choice : choices_of(arguments.names)) remove_engine(choice);
}

/// What cannot be had ends like bad input: with what to do, and nothing half done.
template <class Action>
int with_faults_told(const Action& action) {
  try {
    action();
    return interrupted() ? kInterrupted : kWithinTolerance;
  } catch (const NotInstalled& fault) {
    if (interrupted()) return kInterrupted;
    throw BadOption(fmt::format("engines: {}", fault.what()));
  }
}

}  // namespace

void add_engines_command(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("engines", "Install, remove and list engines beside Bullet, by version");
  command->require_subcommand(1);
  command->footer(
      "Engines of Debian's packages are there once their packages are and the project was "
      "built.\n\n"
      "Examples:\n  slipcheck engines add rapier@0.19.3 rapier@0.21.0\n  slipcheck engines list");
  auto arguments = std::make_shared<EnginesArguments>();

  CLI::App* adding = command->add_subcommand(
      "add", "Have npm install engines, each in a folder of its own, in exactly this version");
  adding
      ->add_option("ENGINE", arguments->names,
                   "As in rapier@0.19.3; without a version its usual one")
      ->required();
  adding->add_flag("-q,--quiet", arguments->quiet, "Say nothing");
  adding->footer("Example:\n  slipcheck engines add rapier@0.19.3");
  adding->callback(
      [arguments, &exit_code] { exit_code = with_faults_told([&] { add(*arguments); }); });

  CLI::App* removing = command->add_subcommand("remove", "Remove engines that `add` has installed");
  removing->add_option("ENGINE", arguments->names, "As in rapier@0.19.3")->required();
  accept_quiet(*removing);
  removing->footer("Example:\n  slipcheck engines remove rapier@0.19.3");
  removing->callback(
      [arguments, &exit_code] { exit_code = with_faults_told([&] { remove(*arguments); }); });

  CLI::App* listing =
      command->add_subcommand("list", "The engines that are there and those that could be");
  listing->add_flag("--json", arguments->as_json, "As JSON");
  accept_quiet(*listing);
  listing->footer("Example:\n  slipcheck engines list --json");
  listing->callback([arguments, &exit_code] {
    const nlohmann::ordered_json list = list_engines();
    if (arguments->as_json)
      fmt::print("{}\n", list.dump(2));
    else
      print_list(list);
    exit_code = kWithinTolerance;
  });
}

}  // namespace slipcheck
