#include "harness/run/prepared_scene.h"

#include <exception>
#include <utility>

#include "base/in_parallel.h"
#include "base/stop_scope.h"
#include "harness/run/box_reference.h"

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
    auto contact = std::make_unique<const ContactScene>(make_contact_scene(scenario));
    const ReferenceSolver solver(*contact, reference_settings(scenario, general, in_scene));
    if (const ReferenceExtras wanted = extras_of(scenario.name); wanted.whole)
      if (const std::string why = no_whole_reason(solver, wanted); !why.empty())
        throw Unsupported(scenario.name + ": " + why);
    scenes.push_back({std::move(scenario), std::move(contact), solver, {}});
  }
  in_parallel(scenes.size(), threads, [&](std::size_t k) {
    scenes[k].reference =
        guarded_reference(scenes[k], time_limit, extras_of(scenes[k].scenario.name));
  });
  return scenes;
}

}  // namespace slipcheck
