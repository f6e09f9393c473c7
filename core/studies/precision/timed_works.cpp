#include "studies/precision/timed_works.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "reference/steps/step_solver.h"
#include "studies/precision/reference_curves.h"

namespace slipcheck {
namespace {

using Kind = MethodCurve::Kind;

/// Of an engine, timed at once: a few milliseconds. More tell no more of a step, whose cost the
/// rounds settle.
constexpr std::size_t kEngineSteps = 500;
/// A short run is made again until it has so many, the first time not counted.
constexpr std::size_t kLeastSteps = 300;
constexpr std::size_t kMostRepeats = 20;
/// Of the reference's fixed steps, timed at once: likewise a few milliseconds.
constexpr std::size_t kFixedSteps = 20000;

TimedWork timed_engine(const PreparedScene& scene, const ReferenceSolver& solver,
                       const MethodCurve& curve, WorkPrecision& point, TimingWorkers& workers) {
  const double step = 1 / point.knob;
  const auto stretch = std::make_shared<TimedStretch>(timed_stretch(
      solver, scene.reference.first_contact, scene.reference.run.end_time, step, kEngineSteps));
  // The first run warms up.
  const std::size_t repeats =
      1 + std::clamp<std::size_t>(kLeastSteps / stretch->steps, 1, kMostRepeats);
  return {&point, static_cast<double>(stretch->steps), point.knob,
          [&solver, &curve, &workers, stretch, step, repeats] {
            RemoteEngine& engine = workers.worker(curve.engine, curve.precision);
            engine.configure(EngineScene(solver.scene()), curve.settings, step);
            const std::vector<double> seconds =
                engine.time_steps(stretch->states, stretch->start, stretch->steps, repeats);
            return *std::min_element(seconds.begin() + 1, seconds.end());
          }};
}

TimedWork timed_steps(const PreparedScene& scene, const ReferenceSolver& solver,
                      WorkPrecision& point) {
  const auto stretch = std::make_shared<TimedStretch>(
      timed_stretch(solver, scene.reference.first_contact, scene.reference.run.end_time, point.knob,
                    kFixedSteps));
  const auto steps = static_cast<double>(stretch->steps);
  const double step = point.knob, time = (steps - 0.5) * step;
  return {
      &point, steps, 1 / step, [&scene, stretch, step, time] {
        return least_cpu_seconds([&] {
          const SolvedRun run =
              StepSolver(*scene.contact, stretch->states, {step}).run(until_time(time), nullptr);
          if (run.failed) throw std::runtime_error(run.reason);
        });
      }};
}

/// A run of the event or the contact solver as a whole.
TimedWork timed_run(const PreparedScene& scene, MethodCurve::Kind kind, WorkPrecision& point) {
  const auto asked = kind == Kind::event ? Compare::Reference::event : Compare::Reference::contact;
  const auto solver = std::make_shared<ReferenceSolver>(
      *scene.contact, ReferenceSettings{asked, scene.scenario.run.most_events});
  const RunEnd end = patient_end(scene);
  SolverAccuracy accuracy;
  if (kind == Kind::contact) accuracy.tolerance = point.knob;
  const SolvedRun run = solver->run(end, nullptr, accuracy);
  const auto steps =
      static_cast<double>(std::max<std::size_t>(1, run.steps > 0 ? run.steps : run.events));
  return {&point, steps, run.end_time > 0 ? steps / run.end_time : 0, [solver, end, accuracy] {
            return least_cpu_seconds([&] { solver->run(end, nullptr, accuracy); });
          }};
}

}  // namespace

RemoteEngine& TimingWorkers::worker(const std::string& engine, const std::string& precision) {
  const auto found = find_engine(engine, precision, installed_);
  if (!found) throw std::runtime_error(not_installed_text(engine, precision));
  std::unique_ptr<RemoteEngine>& worker = workers_[found->command];
  if (!worker || !worker->alive()) {
    worker.reset();
    worker = std::make_unique<RemoteEngine>(found->command, limits_, stop_);
  }
  return *worker;
}

TimedStretch timed_stretch(const ReferenceSolver& solver, double first_contact, double end,
                           double step, std::size_t most) {
  TimedStretch stretch;
  const double steps = std::max(1.0, std::floor(end / step));
  stretch.steps = static_cast<std::size_t>(std::min(steps, static_cast<double>(most)));
  if (steps > static_cast<double>(most) && std::isfinite(first_contact)) {
    const double latest = end - static_cast<double>(most) * step;
    stretch.start = std::clamp(first_contact - 0.5 * static_cast<double>(most) * step, 0.0, latest);
  }
  stretch.states = solver.states_at(stretch.start);
  return stretch;
}

std::vector<TimedWork> timed_works(const PreparedScene& scene, std::vector<MethodCurve>& curves,
                                   TimingWorkers& workers) {
  const ReferenceSolver& solver = scene.solver;
  std::vector<TimedWork> works;
  for (MethodCurve& curve : curves)
    for (WorkPrecision& point : curve.points) {
      if (point.status != RunStatus::ok || !(scene.reference.run.end_time > 0)) continue;
      works.push_back(curve.kind == Kind::engine
                          ? timed_engine(scene, solver, curve, point, workers)
                      : curve.kind == Kind::fixed_step ? timed_steps(scene, solver, point)
                                                       : timed_run(scene, curve.kind, point));
    }
  return works;
}

}  // namespace slipcheck
