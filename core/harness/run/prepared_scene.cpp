#include "harness/run/prepared_scene.h"

#include <exception>
#include <utility>

#include "base/stop_scope.h"
#include "harness/run/box_run.h"
#include "harness/run/in_parallel.h"

namespace slipcheck {
namespace {

std::variant<ReferenceSolver, BoxSolver> solver_of(const Scenario& scenario,
                                                   const ContactScene& scene, bool general) {
  if (scene.hard.box) return BoxSolver(scene, reference_settings(scenario, general));
  return ReferenceSolver(scene, reference_settings(scenario, general));
}

ReferenceResult reference_of(const ReferenceSolver& solver, const Scenario& scenario) {
  return run_reference(solver, run_end(scenario), body_names(scenario));
}
ReferenceResult reference_of(const BoxSolver& solver, const Scenario& scenario) {
  return run_box_reference(solver, scenario);
}

ReferenceResult reference_of(const PreparedScene& scene) {
  return std::visit([&](const auto& solver) { return reference_of(solver, scene.scenario); },
                    scene.solver);
}

/// What a reference that shows nothing leaves of itself.
ReferenceResult failed_reference(const PreparedScene& scene, std::string reason) {
  ReferenceResult result;
  result.solver = std::visit([](const auto& solver) { return solver.name(); }, scene.solver);
  result.first_contact = std::numeric_limits<double>::infinity();
  result.run.failed = true;
  result.warnings.push_back("the run did not end: " + reason);
  result.run.reason = std::move(reason);
  return result;
}

ReferenceResult guarded_reference(const PreparedScene& scene, double time_limit) {
  try {
    const StopScope limit(time_limit);
    return reference_of(scene);
  } catch (const std::exception& fault) {
    return failed_reference(scene, fault.what());
  }
}

}  // namespace

std::vector<PreparedScene> prepare_scenes(std::vector<Scenario> scenarios, bool general,
                                          std::size_t threads, double time_limit) {
  std::vector<PreparedScene> scenes;
  scenes.reserve(scenarios.size());
  for (Scenario& scenario : scenarios) {
    auto contact = std::make_unique<const ContactScene>(make_contact_scene(scenario));
    auto solver = solver_of(scenario, *contact, general);
    scenes.push_back({std::move(scenario), std::move(contact), std::move(solver), {}});
  }
  in_parallel(scenes.size(), threads, [&](std::size_t k) {
    scenes[k].reference = guarded_reference(scenes[k], time_limit);
  });
  return scenes;
}

}  // namespace slipcheck
