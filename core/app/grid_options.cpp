#include "app/grid_options.h"

#include <filesystem>

#include "app/engine_option.h"
#include "app/interrupt.h"
#include "app/limit_options.h"
#include "app/output.h"
#include "engine/profile.h"

namespace slipcheck {

void add_grid_options(CLI::App& command, GridArguments& arguments, GridEngines engines) {
  if (engines == GridEngines::option)
    command
        .add_option("--engines", arguments.engines.engines,
                    "Engines, separated by commas; else all that are installed")
        ->delimiter(',')
        ->check(installed_engine(false));
  command
      .add_option("--precisions", arguments.engines.precisions,
                  "single, double, or both with a comma; else what is installed")
      ->delimiter(',')
      ->check(CLI::IsMember({"single", "double"}));
  command
      .add_option("--profiles", arguments.engines.profiles,
                  "Names, or paths of YAML files, separated by commas")
      ->delimiter(',')
      ->capture_default_str();
  command
      .add_option("--phases", arguments.options.phases,
                  "Runs in each ensemble, by where in a step the first contact falls")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  add_limit_options(command, arguments.options);
  command.add_option("--out", arguments.directory,
                     "Write a folder: JSON, CSV, charts and a page that shows them");
  command.add_option("--json", arguments.json, "Write the result here; - is stdout");
  command.add_flag("-q,--quiet", arguments.quiet, "No table, no progress; the exit code tells");
}

void complete(GridArguments& arguments) {
  check_output("--json", arguments.json, false);
  check_output("--out", arguments.directory, true);
  for (std::string& profile : arguments.engines.profiles)
    if (is_profile_path(profile)) profile = std::filesystem::absolute(profile).string();
  arguments.options.stop = &interrupted();
}

}  // namespace slipcheck
