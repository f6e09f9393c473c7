#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "scenario/schema.h"

namespace slipcheck {

void add_schema_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "schema", "Print the JSON Schema of the scenario format, for editors and other programs");
  command->footer("Example:\n  slipcheck schema > scenarios/schema.json");
  accept_quiet(*command);
  command->callback([&exit_code] {
    fmt::print("{}\n", scenario_schema().dump(2));
    exit_code = kWithinTolerance;
  });
}

}  // namespace slipcheck
