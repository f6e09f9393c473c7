#include "harness/prepared_scene.h"

#include <utility>

#include "harness/box_run.h"
#include "harness/in_parallel.h"

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

}  // namespace

std::vector<PreparedScene> prepare_scenes(std::vector<Scenario> scenarios, bool general,
                                          std::size_t threads) {
  std::vector<PreparedScene> scenes;
  scenes.reserve(scenarios.size());
  for (Scenario& scenario : scenarios) {
    auto contact = std::make_unique<const ContactScene>(make_contact_scene(scenario));
    auto solver = solver_of(scenario, *contact, general);
    scenes.push_back({std::move(scenario), std::move(contact), std::move(solver), {}});
  }
  in_parallel(scenes.size(), threads, [&](std::size_t k) {
    PreparedScene& scene = scenes[k];
    scene.reference = std::visit(
        [&](const auto& solver) { return reference_of(solver, scene.scenario); }, scene.solver);
  });
  return scenes;
}

}  // namespace slipcheck
