#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "app/commands.h"
#include "app/explain/explain_bodies.h"
#include "app/explain/explain_box.h"
#include "app/explain/explain_contacts.h"
#include "app/explain/explain_gas.h"
#include "app/explain/explain_pair.h"
#include "app/explain/explain_rows.h"
#include "app/interrupt.h"
#include "app/load_files.h"
#include "app/set_option.h"
#include "engine/engine_registry.h"
#include "engine/remote_engine.h"
#include "harness/compare/closed_form_values.h"
#include "harness/compare/scene_features.h"
#include "harness/run/reference_run.h"
#include "harness/run/requested_runs.h"
#include "physics/closed_forms.h"
#include "reference/events/planar_solver.h"
#include "reference/initial_contacts.h"
#include "reference/reference_solver.h"
#include "scenario/observable_names.h"

namespace slipcheck {
namespace {

void print_solver(const ContactScene& scene, const ReferenceSolver& solver) {
  const bool boxed = scene.hard.box.has_value();
  const std::string text =
      boxed && solver.is_resolved() ? "contacts last; their forces are integrated in time"
      : boxed && scene.is_hard() ? "every contact is hard; exact flight from collision to collision"
      : solver.is_stepped()
          ? fmt::format("contacts last; in steps of {}", in_unit(solver.step(), "s"))
      : solver.is_resolved()
          ? (scene.is_hard() ? "asked for by compare.reference; collisions are instants"
                             : "contacts last; all forces are integrated in time")
      : !scene.is_hard() ? "asked for by compare.reference; soft contacts become hard ones"
      : has_exact_phases(scene.hard) ? "every contact is hard; exact phases between collisions"
      : solver.is_exact()
          ? "every contact is hard; phases between collisions to 1e-13 of the speeds"
          : "every contact is hard; integrated between collisions";
  fmt::print("  solver: {} ({})\n", solver.name(), text);
}

/// What the loop was made for.
void print_loop(const std::vector<std::string>& loop) {
  fmt::print("\n  Loop\n");
  for (const std::string& part : loop) fmt::print("    {}\n", part);
}

void print_features(const ContactScene& scene) {
  const std::vector<Feature> features = scene_features(scene);
  for (const bool needed : {true, false}) {
    fmt::print("\n  {}\n", needed ? "Needs" : "Left out");
    for (const Feature& feature : features)
      if (feature.needed == needed) fmt::print("    {:<36} {}\n", feature.name, feature.detail);
  }
}

/// What tilt and motion do to a body that rolls, K (17), (22)-(25).
void print_substrate(const Scenario& scenario, const Scene& scene) {
  const Vector3 downhill(scene.downhill.x(), scene.downhill.y(), 0);
  const double shaking = scene.motion.largest_acceleration();
  if (downhill.norm() == 0 && shaking == 0) return;
  fmt::print("\n  Substrate, under {}\n", scenario.bodies[0].name);
  const double A = scene.bodies[0].inverse_shape_factor();
  const auto rolled = [&](const Vector3& a_G, double a_S) {
    return in_unit(rolling_acceleration(A, a_G, a_S * Vector3::UnitX()).norm(), "m/s²");
  };
  if (downhill.norm() > 0)
    print_row("a_roll", rolled(downhill, 0),
              fmt::format("down the slope while it rolls, of {:.5g} m/s²", downhill.norm()));
  if (shaking > 0) {
    print_row("a_S", in_unit(shaking, "m/s²"), "largest acceleration of the substrate");
    print_row("a_roll", rolled(Vector3::Zero(), shaking), "of a body that rolls on it then");
  }
  print_row("|a_S − a_G|",
            in_unit(rolling_limit(A, scene.on_substrate(0).static_friction, scene.gravity), "m/s²"),
            "up to here it rolls, beyond it slides");
}

/// SI unit of "i.sliding_time" or "i-j.restitution".
std::string unit_of(const std::string& value_name) {
  const std::string name = value_name.substr(value_name.find('.') + 1);
  for (const ObservableName& observable : observable_names())
    if (observable.name == name) return observable.dimension.si;
  return {};
}

void print_expectations(const Scenario& scenario, const ContactScene& scene,
                        const ReferenceSolver& solver) {
  const double contact = solver.first_contact(run_end(scenario).last());
  fmt::print("\n  Expected\n");
  const bool overlaps = !initial_contacts(scene, scene.hard.initial).empty();
  if (overlaps)
    fmt::print("    bodies overlap at the start: engines run once\n");
  else if (std::isfinite(contact))
    fmt::print("    first contact after {}: engines run as ensembles over its phase in a step\n",
               quantity(contact, kTime));
  else
    fmt::print("    no contact but with the substrate: engines run once\n");

  Scene hard = scene.hard;
  const bool rubs =
      std::ranges::any_of(hard.pairs, [](const auto& pair) { return pair.friction > 0; });
  if (!scene.is_hard())
    for (PairContact& pair : hard.pairs) pair.friction = 0;
  const auto values = has_exact_phases(hard) && !overlaps
                          ? closed_form_values(hard, body_names(scenario))
                          : std::map<std::string, double>{};
  if (values.empty()) {
    fmt::print("    no closed form applies\n");
    return;
  }
  fmt::print("    closed forms{}\n", scene.is_hard() ? ""
                                     : rubs ? ", with hard contacts of the same restitution and "
                                              "without rubbing"
                                            : ", with hard contacts of the same restitution");
  for (const auto& [name, value] : values)
    if (name.ends_with("effective_restitution") && value < 0)
      fmt::print("    {} is below 0: they meet again, and these hold until then\n", name);
  for (const auto& [name, value] : values) {
    const bool is_component = name[name.size() - 2] == '.';
    if (!is_component) {
      const std::string unit = unit_of(name);
      fmt::print("    {:<40} {:.10g}{}{}\n", name, value, unit.empty() ? "" : " ", unit);
    }
  }
}

void print_warnings(const ContactScene& scene) {
  if (scene.warnings.empty()) return;
  fmt::print("\n  Warnings\n");
  for (const std::string& warning : scene.warnings) fmt::print("    {}\n", warning);
}

std::string text_of(const Setting& setting) {
  if (const bool* flag = std::get_if<bool>(&setting)) return *flag ? "true" : "false";
  if (const double* number = std::get_if<double>(&setting)) return fmt::format("{:g}", *number);
  return std::get<std::string>(setting);
}

/// Asks the engine of a run what it would make of the scene; takes no step.
void print_engine(const EngineRecord& run, const Scene& scene) {
  const auto executable = find_engine(run.engine, run.precision);
  if (!executable) {
    fmt::print("    not installed\n");
    return;
  }
  if (!run.reason.empty()) {
    fmt::print("    skipped: {}\n", run.reason);
    return;
  }
  for (const auto& [name, setting] : run.settings)
    fmt::print("    the profile sets {:<32} {}\n", name, text_of(setting));
  try {
    RemoteEngine engine(executable->path, {}, &interrupted());
    const Applied applied = engine.configure(scene, run.settings, 1 / run.rate);
    for (const std::string& missing : applied.not_represented)
      fmt::print("    not represented: {}\n", missing);
    for (const std::string& text : applied.left_out) fmt::print("    left out: {}\n", text);
    for (const auto& [name, setting] : applied.settings)
      fmt::print("    {:<36} {}\n", name, text_of(setting));
  } catch (const Refused& refused) {
    fmt::print("    refused: {}\n", refused.what());
  } catch (const WorkerFailure& failure) {
    fmt::print("    failed: {}\n", failure.what());
  }
}

/// `runs` are those of the scenario; what an engine says at the first of its rates stands for all.
void print_engines(const Scenario& scenario, const Scene& scene,
                   const std::vector<EngineRecord>& runs) {
  std::size_t first = 0;
  for (const EngineRequest& request : scenario.compare.engines) {
    const EngineRecord& run = runs[first];
    fmt::print("\n  Engine {} {}, profile {}, {} Hz\n", run.engine, run.precision, run.profile,
               fmt::join(request.rates, ", "));
    print_engine(run, scene);
    first += request.rates.size();
  }
}

void explain_in_box(const Scenario& scenario, const ContactScene& scene) {
  explain_bodies(scenario, scene.hard);
  explain_box(scenario, scene);
  const double speed = planar_speed_scale(scene.hard, scene.hard.initial);
  explain_contacts(scenario, scene, std::nullopt, speed > 0 ? speed : 1);
}

void explain_on_substrate(const Scenario& scenario, const ContactScene& scene,
                          const ReferenceSolver& solver) {
  const auto meeting = first_meeting(scene, run_end(scenario).last());
  explain_bodies(scenario, scene.hard);
  print_substrate(scenario, scene.hard);
  explain_gas(scene.hard);
  explain_contacts(scenario, scene, meeting, 1);
  if (meeting) explain_meeting(scenario, scene, *meeting);
  print_expectations(scenario, scene, solver);
}

void explain(const Scenario& scenario, const std::vector<EngineRecord>& runs, bool general) {
  fmt::print("{}  {}\n", scenario.name, scenario.title);
  if (!scenario.source.empty()) fmt::print("  source: {}\n", scenario.source);
  ContactScene scene;
  try {
    scene = make_contact_scene(scenario);
    const ReferenceSolver solver(scene, reference_settings(scenario, general));
    print_solver(scene, solver);
    print_loop(solver.loop());
    print_features(solver.scene());
    scene.hard.box ? explain_in_box(scenario, scene)
                   : explain_on_substrate(scenario, scene, solver);
  } catch (const Unsupported& unsupported) {
    fmt::print("\n  No solver for this scene:\n{}\n", unsupported.what());
    return;
  }
  print_warnings(scene);
  print_engines(scenario, scene.hard, runs);
}

}  // namespace

void add_explain_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "explain", "Tell what a scene needs, what is left out and what is expected; runs nothing");
  auto files = std::make_shared<std::vector<std::string>>();
  command->add_option("FILE", *files, "Scenario files")->required();
  auto general = std::make_shared<bool>(false);
  add_general_option(*command, *general);
  accept_quiet(*command);
  command->footer("Example:\n  slipcheck explain scenarios/symmetric-30cms.yaml");
  command->callback([files, general, &exit_code] {
    watch_for_interrupts();
    const std::vector<Scenario> scenarios = load_files(*files);
    const auto runs = requested_runs(scenarios, {}, &interrupted(), {}, *general);
    for (std::size_t s = 0; s < scenarios.size(); ++s) explain(scenarios[s], runs[s], *general);
    exit_code = kWithinTolerance;
  });
}

}  // namespace slipcheck
