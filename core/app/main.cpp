#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "app/commands.h"
#include "app/interrupt.h"
#include "base/stop_scope.h"
#include "report/rows/context.h"
#include "scenario/fault.h"
#include "scene/scene.h"

int main(int argc, char** argv) {
  using namespace slipcheck;
  CLI::App app{
      "Slipcheck holds physics engines against a reference of spheres that collide, slide and "
      "roll."};
  app.set_version_flag("--version", fmt::format("slipcheck {} ({}, {})", context().version,
                                                context().commit, context().build));
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 all within tolerance, 1 something deviates or is undecided, 2 bad input,\n"
      "3 an engine failed, 4 the results could not be written, 130 interrupted.\n\nExample:\n  "
      "slipcheck run "
      "scenarios/symmetric-30cms.yaml --phases 64");
  int exit_code = kWithinTolerance;
  add_run_command(app, exit_code);
  add_check_command(app, exit_code);
  add_engines_command(app, exit_code);
  add_conformance_command(app, exit_code);
  add_convert_command(app, exit_code);
  add_explain_command(app, exit_code);
  add_figures_command(app, exit_code);
  add_gas_command(app, exit_code);
  add_list_command(app, exit_code);
  add_precision_command(app, exit_code);
  add_report_command(app, exit_code);
  add_schema_command(app, exit_code);
  add_stability_command(app, exit_code);
  add_tune_command(app, exit_code);
  add_versions_command(app, exit_code);
  try {
    const StopScope scope(&interrupted());
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Help and version end well; everything else is bad input.
    return app.exit(error) == 0 ? kWithinTolerance : kBadInput;
  } catch (const BadScenario& bad) {
    fmt::print(stderr, "{}\n", bad.what());
    return kBadInput;
  } catch (const Unsupported& unsupported) {
    fmt::print(stderr, "{}\n", unsupported.what());
    return kBadInput;
  } catch (const Interrupted& stopped) {
    fmt::print(stderr, "{}\n", stopped.what());
    return kInterrupted;
  } catch (const BadOption& bad) {
    fmt::print(stderr, "slipcheck: {}\n", bad.what());
    return kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "slipcheck: {}\n", error.what());
    return kNotWritten;
  }
  return exit_code;
}
