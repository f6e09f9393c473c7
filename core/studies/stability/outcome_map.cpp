#include "studies/stability/outcome_map.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <utility>

#include "base/in_parallel.h"
#include "harness/run/prepared_scene.h"
#include "reference/steps/step_solver.h"
#include "scenario/contact_models.h"
#include "studies/stability/fixed_step_outcome.h"
#include "studies/stability/limit_scenes.h"
#include "studies/stability/reference_path.h"
#include "studies/stability/scene_variation.h"

namespace slipcheck {
namespace {

using Axis = OutcomeMap::Axis;

Axis logarithmic(std::string label, double low, double high, std::size_t cells) {
  Axis axis{std::move(label), true, {}};
  for (std::size_t k = 0; k < cells; ++k)
    axis.values.push_back(
        low * std::pow(high / low, static_cast<double>(k) / static_cast<double>(cells - 1)));
  return axis;
}

Axis linear(std::string label, double low, double high, std::size_t cells) {
  Axis axis{std::move(label), false, {}};
  for (std::size_t k = 0; k < cells; ++k)
    axis.values.push_back(low +
                          (high - low) * static_cast<double>(k) / static_cast<double>(cells - 1));
  return axis;
}

Axis speed_axis(std::size_t cells) { return logarithmic("speed [m/s]", 1e-3, 10, cells); }

Scenario collision_at(double speed, double restitution) {
  return with_restitution(with_speed(limit_collision(), speed), restitution);
}

OutcomeMap map_of(const EngineRecord& method, const char* axes) {
  OutcomeMap map;
  map.name = fmt::format("{}-{}-{}-{}", axes, method.engine, method.precision, method.profile);
  map.method = method.engine;
  map.precision = method.precision;
  map.profile = method.profile;
  map.error_label = "|e_n − e_ref|";
  return map;
}

std::string title_of(const EngineRecord& method, const char* where) {
  return fmt::format("{} {} {}{}", method.engine, method.precision, method.profile, where);
}

/// Fills in the cells; `request` gives that at (x, y).
std::optional<OutcomeMap> filled(
    OutcomeMap map, EnsembleTrials& trials,
    const std::function<EnsembleRequest(double x, double y)>& request) {
  std::vector<EnsembleRequest> requests;
  for (const double y : map.y.values)
    for (const double x : map.x.values) requests.push_back(request(x, y));
  if (trials.is_interrupted()) return std::nullopt;
  const std::vector<EnsembleTrial> made = trials.make(requests);
  if (trials.is_interrupted()) return std::nullopt;
  for (const EnsembleTrial& trial : made) {
    map.outcome.push_back(trial.outcome);
    map.worst_error.push_back(trial.restitution_error);
  }
  return map;
}

}  // namespace

std::optional<OutcomeMap> speed_restitution_map(const EngineRecord& method, const LimitGrid& grid,
                                                VariedScenes& scenes, EnsembleTrials& trials) {
  OutcomeMap map = map_of(method, "speed-restitution");
  map.title = title_of(method, " at 240 Hz");
  map.x = speed_axis(grid.cells);
  map.y = linear("restitution", 0, 1, grid.cells);
  return filled(std::move(map), trials, [&](double speed, double restitution) {
    const VariedScene& scene = scenes.get(fmt::format("collision, restitution {}", restitution),
                                          speed, [&] { return collision_at(speed, restitution); });
    return EnsembleRequest{&scene, &method, 1.0 / 240};
  });
}

std::optional<OutcomeMap> step_speed_map(const EngineRecord& method, const LimitGrid& grid,
                                         VariedScenes& scenes, EnsembleTrials& trials) {
  constexpr double kRestitution = 0.9;
  OutcomeMap map = map_of(method, "step-speed");
  map.title = title_of(method, ", e_n = 0.9");
  map.x = logarithmic("step [s]", 3e-4, 0.1, grid.cells);
  map.y = speed_axis(grid.cells);
  return filled(std::move(map), trials, [&](double step, double speed) {
    const VariedScene& scene = scenes.get(fmt::format("collision, restitution {}", kRestitution),
                                          speed, [&] { return collision_at(speed, kRestitution); });
    return EnsembleRequest{&scene, &method, step};
  });
}

OutcomeMap step_stiffness_map(const LimitGrid& grid, const RunOptions& options) {
  OutcomeMap map;
  map.name = "step-stiffness-fixed-step";
  map.title = "fixed-step, e_n = 0.9";
  map.method = "fixed-step";
  map.precision = "double";
  map.x = logarithmic("step [s]", 1e-7, 1e-3, grid.cells);
  map.y = logarithmic("stiffness [N/m]", 1e4, 1e10, grid.cells);
  map.error_label = "|e_n − e_ref|";
  map.theory_name = "2 (√(1 + ε²) − ε)/ω0, ε = γ/ω0";

  std::vector<Scenario> scenarios;
  for (const double stiffness : map.y.values) {
    scenarios.push_back(with_stiffness(limit_soft_pair(), stiffness));
    scenarios.back().compare.tolerance.erase("contact_time");
    const LinearContact contact =
        linear_contact(std::get<LinearNormal>(scenarios.back().contacts[0].normal),
                       0.5 * scenarios.back().bodies[0].sphere.mass);
    map.theory.emplace_back(step_limit(contact.contact_frequency(), contact.damping_rate()),
                            stiffness);
  }
  const std::vector<PreparedScene> scenes = prepare_scenes(std::move(scenarios));
  std::vector<ReferencePath> paths;
  for (const PreparedScene& scene : scenes) paths.emplace_back(scene);

  const std::size_t columns = map.x.values.size();
  map.outcome.resize(columns * paths.size(), Outcome::refused);
  map.worst_error.resize(map.outcome.size(), kNotObserved);
  in_parallel(map.outcome.size(), options.workers, [&](std::size_t cell) {
    const FixedStepOutcome seen = fixed_step_outcome(
        paths[cell / columns], map.x.values[cell % columns], options.phases, grid.criteria);
    map.outcome[cell] = seen.outcome;
    map.worst_error[cell] = restitution_error(seen.errors);
  });
  return map;
}

}  // namespace slipcheck
