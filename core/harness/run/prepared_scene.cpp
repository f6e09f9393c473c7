#include "harness/run/prepared_scene.h"

#include <malloc.h>

#include <exception>
#include <utility>

#include "base/in_parallel.h"
#include "base/stop_scope.h"
#include "harness/run/box_reference.h"
#include "scenario/load.h"

namespace slipcheck {
namespace {

/// Where contacts last that were taken as instants, and nobody asked for that, the solver that
/// resolves them takes over from the start.
ReferenceResult reference_of(PreparedScene& scene, const ReferenceExtras& extras) {
  if (extras.whole) return run_reference_whole(scene.solver, run_end(scene.scenario), extras);
  if (scene.contact->hard.box) return run_box_reference(scene.solver, scene.scenario);
  const auto solve = [&] {
    return run_reference(scene.solver, run_end(scene.scenario), body_names(scene.scenario), extras);
  };
  ReferenceResult result = solve();
  ReferenceSettings settings = scene.solver.settings();
  if (!result.run.lasting || settings.asked != Compare::Reference::automatic) return result;
  const std::string why = result.run.reason;
  settings.asked = Compare::Reference::contact;
  scene.solver = ReferenceSolver(*scene.contact, settings);
  result = solve();
  result.warnings.push_back("contact has taken over from event: " + why);
  return result;
}

/// Fewer bodies are no burden.
constexpr std::size_t kMany = 10000;

/// Of many bodies that are looked at as a whole neither what the file says of each nor its start is
/// held while they move: the file's text tells both again.
bool is_held_once(const Scenario& scenario, const ReferenceExtras& extras) {
  return extras.whole && !extras.left_out && scenario.bodies.size() >= kMany &&
         !scenario.text.empty();
}

template <class Values>
void let_go(Values& values) {
  Values().swap(values);
}

void tell_bodies_again(PreparedScene& scene) {
#ifdef __GLIBC__
  malloc_trim(0);  // what the solver had lies in many pieces
#endif
  const StopScope whatever_ended_the_run{StopScope::Terms{}};
  scene.scenario.bodies = parse_scenario(scene.scenario.text, scene.scenario.file).bodies;
  std::vector<BodyState>& initial = scene.contact->hard.initial;
  if (!initial.empty()) return;
  initial.reserve(scene.scenario.bodies.size());
  for (const Body& body : scene.scenario.bodies) initial.push_back(body.initial);
}

/// What a reference that shows nothing leaves of itself.
ReferenceResult failed_reference(const PreparedScene& scene, std::string reason) {
  ReferenceResult result;
  result.solver = scene.solver.name();
  result.first_contact = std::numeric_limits<double>::infinity();
  result.run.failed = true;
  result.warnings.push_back("the run did not end: " + reason);
  result.run.reason = std::move(reason);
  return result;
}

ReferenceResult guarded_reference(PreparedScene& scene, double time_limit,
                                  const ReferenceExtras& extras) {
  try {
    const StopScope limit(time_limit);
    return reference_of(scene, extras);
  } catch (const std::exception& fault) {
    return failed_reference(scene, fault.what());
  }
}

}  // namespace

std::vector<PreparedScene> prepare_scenes(std::vector<Scenario> scenarios, bool general,
                                          std::size_t threads, double time_limit,
                                          std::size_t in_scene,
                                          const std::map<std::string, ReferenceExtras>* extras) {
  std::vector<PreparedScene> scenes;
  scenes.reserve(scenarios.size());
  const auto extras_of = [&](const std::string& name) {
    if (extras)
      if (const auto named = extras->find(name); named != extras->end()) return named->second;
    return ReferenceExtras{};
  };
  for (Scenario& scenario : scenarios) {
    auto contact = std::make_unique<ContactScene>(make_contact_scene(scenario));
    const ReferenceExtras wanted = extras_of(scenario.name);
    if (is_held_once(scenario, wanted)) let_go(scenario.bodies);
    const ReferenceSolver solver(*contact, reference_settings(scenario, general, in_scene));
    if (wanted.whole)
      if (const std::string why = no_whole_reason(solver, wanted); !why.empty())
        throw Unsupported(scenario.name + ": " + why);
    scenes.push_back({std::move(scenario), std::move(contact), solver, {}});
  }
  in_parallel(scenes.size(), threads, [&](std::size_t k) {
    PreparedScene& scene = scenes[k];
    ReferenceExtras wanted = extras_of(scene.scenario.name);
    const bool held_once = scene.scenario.bodies.empty();
    if (held_once) wanted.started = [&] { let_go(scene.contact->hard.initial); };
    scene.reference = guarded_reference(scene, time_limit, wanted);
    if (held_once) tell_bodies_again(scene);
  });
  return scenes;
}

}  // namespace slipcheck
