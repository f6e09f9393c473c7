#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/load_files.h"
#include "app/number_range.h"
#include "app/output.h"
#include "app/progress_bar.h"
#include "app/say.h"
#include "report/files/files.h"
#include "report/json/gas_json.h"
#include "report/rows/context.h"
#include "report/rows/gas_rows.h"
#include "report/terminal/table_style.h"
#include "studies/gas/gas_of_scene.h"
#include "studies/gas/gas_run.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

struct GasArguments {
  std::string file, directory, json;
  GasOptions options;
  std::optional<double> speed;
  bool quiet = false;
};

void check(const GasArguments& arguments) {
  const GasSetup& setup = arguments.options.setup;
  if (setup.particles % kGasGroup != 0)
    throw BadOption(
        fmt::format("--particles: must be a multiple of {}, got {}", kGasGroup, setup.particles));
  check_output("--out", arguments.directory, true);
  check_output("--json", arguments.json, false);
}

int cool(GasArguments& arguments) {
  check(arguments);
  watch_for_interrupts();
  GasOptions& options = arguments.options;
  const Scenario scenario = load_files({arguments.file}).front();
  const GasOfScene gas = gas_of_scene(scenario, arguments.speed);
  options.setup.sphere = gas.sphere;
  options.setup.speed = arguments.speed.value_or(gas.speed);
  options.speed_exponent = gas.speed_exponent;
  if (!(options.setup.speed > 0))
    throw BadOption("--speed: must be given for a scene whose bodies are at rest");

  if (!arguments.quiet) say("{}", debug_build_warning());
  GasRun run;
  {
    ProgressBar bar("cooling", !arguments.quiet);
    options.progress = [&](double collisions) {
      bar.set(static_cast<std::size_t>(std::min(collisions, options.collisions)),
              static_cast<std::size_t>(std::ceil(options.collisions)));
    };
    run = run_gas(options, gas.law);
  }
  const auto json = [&] { return json_of(scenario, gas, options, run).dump(2) + "\n"; };
  write_json(arguments.json, json);
  if (!arguments.directory.empty()) {
    const fs::path directory = arguments.directory;
    fs::create_directories(directory);
    write_file_atomically(directory / "gas.json", json());
    write_file_atomically(directory / "gas.csv", gas_csv(run));
  }
  if (!arguments.quiet && arguments.json != "-") {
    fmt::print("{}  {} {}, {} of {}{}\n\n", scenario.name, options.setup.particles,
               options.setup.dimensions == 2 ? "disks" : "spheres", gas.contact, scenario.file,
               gas.soft ? ", in an instant" : "");
    fmt::print("{}\n", terminal_table(gas_course(run), table_style(), 2));
    fmt::print("{}", terminal_table(gas_statements(run), table_style(), 2));
  }
  if (run.interrupted) {
    if (!arguments.quiet) say("interrupted: what had finished is kept\n");
    return kInterrupted;
  }
  return kWithinTolerance;
}

}  // namespace

void add_gas_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "gas",
      "A dilute gas of a scene's first body: how it cools, by direct simulation Monte Carlo");
  auto arguments = std::make_shared<GasArguments>();
  GasOptions& options = arguments->options;
  command->add_option("FILE", arguments->file, "Scenario file")->required();
  command
      ->add_option("--particles", options.setup.particles,
                   fmt::format("A multiple of {}", kGasGroup))
      ->check(CLI::Range(2 * kGasGroup, std::size_t{1} << 24))
      ->capture_default_str();
  command->add_option("--dimensions", options.setup.dimensions, "3, or 2: disks")
      ->check(CLI::IsMember({2, 3}))
      ->capture_default_str();
  command->add_option("--fraction", options.setup.filled, "Of the space that the particles fill")
      ->check(number_range(1e-12, 0.5))
      ->capture_default_str();
  command
      ->add_option("--speed", arguments->speed,
                   "Root mean square at the start [m/s]; else that of the scene's bodies")
      ->check(number_range(1e-12, 1e9));
  command->add_option("--rotation", options.setup.rotation, "T_rot/T at the start")
      ->check(number_range(0.0, 1e6))
      ->capture_default_str();
  command->add_option("--collisions", options.collisions, "Of a particle, at the end")
      ->check(number_range(0.1, 1e6))
      ->capture_default_str();
  command->add_option("--samples", options.samples, "Evenly over these")
      ->check(CLI::Range(8, 100000))
      ->capture_default_str();
  command
      ->add_option("--step", options.setup.step,
                   "Of time, in mean times between collisions of a particle")
      ->check(number_range(1e-3, 1.0))
      ->capture_default_str();
  command->add_option("--seed", options.setup.seed, "Of the random numbers")->capture_default_str();
  options.setup.threads = 0;
  command
      ->add_option("--threads", options.setup.threads,
                   "0: one for each core; the results are the same")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command->add_option("--out", arguments->directory, "Folder for gas.csv and gas.json");
  command->add_option("--json", arguments->json, "The same as gas.json; - for stdout");
  command->add_flag("-q,--quiet", arguments->quiet, "No table; the exit code tells");
  command->footer(
      "Examples:\n"
      "  slipcheck gas scenarios/gas-rolling.yaml --out results/gas\n"
      "  slipcheck gas scenarios/ice-viscoelastic.yaml --particles 1000000 --collisions 200");
  command->callback([arguments, &exit_code] { exit_code = cool(*arguments); });
}

}  // namespace slipcheck
