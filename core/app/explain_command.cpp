#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "app/commands.h"
#include "app/explain_contacts.h"
#include "app/load_files.h"
#include "engine/engine_registry.h"
#include "engine/remote_engine.h"
#include "harness/closed_form_values.h"
#include "harness/reference_run.h"
#include "harness/scene_features.h"
#include "reference/event_solver.h"

namespace slipcheck {
namespace {

void print_features(const HardScene& scene) {
  const std::vector<Feature> features = scene_features(scene);
  for (const bool needed : {true, false}) {
    fmt::print("\n  {}\n", needed ? "Needs" : "Left out");
    for (const Feature& feature : features)
      if (feature.needed == needed) fmt::print("    {:<36} {}\n", feature.name, feature.detail);
  }
}

void print_bodies(const Scenario& scenario, const HardScene& scene) {
  fmt::print("\n  Bodies\n");
  constexpr std::size_t most = 20;
  for (std::size_t i = 0; i < std::min(most, scene.bodies.size()); ++i) {
    const Sphere& s = scene.bodies[i];
    fmt::print(
        "    {:<12} R = {:.6g} m, m = {:.6g} kg, I = {:.6g} kg m2, A = mR2/I = {:.6g}, "
        "slip {:.4g} m/s\n",
        scenario.bodies[i].name, s.radius, s.mass, s.moment_of_inertia(), s.inverse_shape_factor(),
        slip_velocity(scene.initial[i], s.radius).norm());
  }
  if (scene.bodies.size() > most) fmt::print("    and {} more\n", scene.bodies.size() - most);
}

void print_expectations(const Scenario& scenario, const HardScene& scene) {
  const double contact = EventSolver(scene, scene.initial).first_contact(run_end(scenario).limit);
  fmt::print("\n  Expected\n");
  if (std::isfinite(contact))
    fmt::print(
        "    first contact after {:.6g} s: engines run as ensembles over its phase in a step\n",
        contact);
  else
    fmt::print("    no contact but with the substrate: engines run once\n");
  const auto values = closed_form_values(scene, body_names(scenario));
  for (const auto& [name, value] : values) {
    const bool is_component = name[name.size() - 2] == '.';
    if (!is_component) fmt::print("    {:<40} {:.10g}  (closed form, SI)\n", name, value);
  }
  if (values.empty()) fmt::print("    no closed form applies\n");
}

std::string text_of(const Setting& setting) {
  if (const bool* flag = std::get_if<bool>(&setting)) return *flag ? "true" : "false";
  if (const double* number = std::get_if<double>(&setting)) return fmt::format("{:g}", *number);
  return std::get<std::string>(setting);
}

/// Asks each engine what it would make of the scene; takes no step.
void print_engines(const Scenario& scenario, const HardScene& scene) {
  for (const EngineRequest& request : scenario.compare.engines) {
    const bool single = request.precision == EngineRequest::Precision::single_;
    const std::string precision = single ? "single" : "double";
    fmt::print("\n  Engine {} {}, profile {}, {} Hz\n", request.engine, precision, request.profile,
               fmt::join(request.rates, ", "));
    const auto executable = find_engine(request.engine, precision);
    if (!executable) {
      fmt::print("    not installed\n");
      continue;
    }
    try {
      RemoteEngine engine(executable->path);
      const Applied applied = engine.configure(scene, request.profile, 1 / request.rates.front());
      for (const std::string& missing : applied.not_represented)
        fmt::print("    not represented: {}\n", missing);
      for (const auto& [name, setting] : applied.settings)
        fmt::print("    {:<36} {}\n", name, text_of(setting));
    } catch (const Refused& refused) {
      fmt::print("    refused: {}\n", refused.what());
    } catch (const WorkerFailure& failure) {
      fmt::print("    failed: {}\n", failure.what());
    }
  }
}

/// What closed forms say of a scene with soft contacts.
void explain_without_solver(const Scenario& scenario) {
  explain_contacts(scenario);
  const std::optional<Scenario> equivalent = hard_equivalent(scenario);
  if (!equivalent) return;
  try {
    const HardScene scene = make_hard_scene(*equivalent);
    print_bodies(scenario, scene);
    fmt::print("\n  With hard contacts of the same restitution, without rubbing");
    print_expectations(scenario, scene);
  } catch (const Unsupported&) {
    // Something else has no solver either; it is named above.
  }
}

void explain(const Scenario& scenario) {
  fmt::print("{}  {}\n", scenario.name, scenario.title);
  if (!scenario.source.empty()) fmt::print("  source: {}\n", scenario.source);
  HardScene scene;
  try {
    scene = make_hard_scene(scenario);
  } catch (const Unsupported& unsupported) {
    fmt::print("\n  No solver for this scene yet:\n{}\n", unsupported.what());
    explain_without_solver(scenario);
    return;
  }
  fmt::print("  solver: event (every contact is hard; exact phases between collisions)\n");
  print_features(scene);
  print_bodies(scenario, scene);
  print_expectations(scenario, scene);
  print_engines(scenario, scene);
}

}  // namespace

void add_explain_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "explain", "Tell what a scene needs, what is left out and what is expected; runs nothing");
  auto files = std::make_shared<std::vector<std::string>>();
  command->add_option("FILE", *files, "Scenario files")->required();
  accept_quiet(*command);
  command->footer("Example:\n  slipcheck explain scenarios/symmetric-30cms.yaml");
  command->callback([files, &exit_code] {
    for (const Scenario& scenario : load_files(*files)) explain(scenario);
    exit_code = kWithinTolerance;
  });
}

}  // namespace slipcheck
