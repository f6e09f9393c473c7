#include "harness/run/box_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/compare/comparison.h"
#include "harness/run/cpu_time.h"
#include "harness/run/engine_state.h"
#include "harness/run/phases.h"
#include "reference/events/planar_solver.h"

namespace slipcheck {
namespace {

/// Samples in a period of the floor where the scenario does not ask for phase zero alone, and in
/// the run where the floor has no period.
constexpr std::size_t kSamplesPerPeriod = 16;
constexpr double kSamplesOfStillBox = 1000;

double interval_of(const Scene& scene, const BoxSampling& sampling) {
  const double frequency = scene.box->floor.frequency;
  if (frequency == 0) return sampling.interval;
  return 1 / (frequency * static_cast<double>(sampling.per_period));
}

/// Notes in `not_numbers` what has samples and yet no mean.
void add(const char* name, const BlockedMean& mean, ReferenceResult& result,
         std::vector<std::string>& not_numbers) {
  if (std::isnan(mean.mean)) {
    if (mean.samples > 0) not_numbers.push_back(std::string("all.") + name);
    return;
  }
  const double half = mean.half_width95();
  result.observables.emplace(
      std::string("all.") + name,
      UncertainValue{mean.mean, std::isnan(half) ? std::numeric_limits<double>::infinity() : half});
}

std::map<std::string, double> values_of(const BoxObservables& seen) {
  std::map<std::string, double> values;
  const auto put = [&](const char* name, double value) {
    if (!std::isnan(value)) values.emplace(std::string("all.") + name, value);
  };
  put("height", seen.height.mean);
  put("kinetic_energy", seen.kinetic_energy.mean);
  put("rotational_energy", seen.rotational_energy.mean);
  put("collision_rate", seen.collision_rate.mean);
  return values;
}

}  // namespace

BoxSampling box_sampling(const Scenario& scenario) {
  BoxSampling sampling;
  sampling.discard = static_cast<std::size_t>(scenario.run.discard);
  sampling.until_steady = scenario.run.discard_until_steady;
  sampling.per_period = scenario.run.sample_phase_zero ? 1 : kSamplesPerPeriod;
  sampling.interval = scenario.run.time / kSamplesOfStillBox;
  return sampling;
}

ReferenceResult run_box_reference(const BoxSolver& solver, const Scenario& scenario) {
  const Scene& scene = solver.scene().hard;
  const BoxSampling sampling = box_sampling(scenario);
  std::uint64_t collisions = 0;
  BoxObserver observer(scene, sampling, [&] { return collisions; });
  ReferenceResult result;
  result.solver = solver.name();
  result.first_contact = std::numeric_limits<double>::infinity();
  const double begin = thread_cpu_seconds();
  const BoxRun run =
      solver.run(run_end(scenario), interval_of(scene, sampling), &observer, &collisions);
  result.cpu_seconds = thread_cpu_seconds() - begin;
  result.run.end_time = run.end_time;
  result.run.reached = run.reached;
  result.run.reason = run.reason;
  result.run.events = run.events;
  result.run.collisions = run.collisions;
  result.run.collapses = run.collapses;
  result.run.steps = run.steps;

  const BoxObservables seen = observer.finish(run.energy_error, run.momentum_error);
  std::vector<std::string> not_numbers;
  add("height", seen.height, result, not_numbers);
  add("kinetic_energy", seen.kinetic_energy, result, not_numbers);
  add("rotational_energy", seen.rotational_energy, result, not_numbers);
  add("collision_rate", seen.collision_rate, result, not_numbers);
  if (std::isnan(run.energy_error)) not_numbers.push_back("all.energy_drift");
  // Errors are their own uncertainty.
  result.observables["all.energy_drift"] = {run.energy_error, std::abs(run.energy_error)};
  if (!std::isnan(run.momentum_error))
    result.observables["all.momentum_drift"] = {run.momentum_error, std::abs(run.momentum_error)};
  result.box = BoxReference{seen.samples, seen.discarded, seen.steady, observer.series()};

  if (!solver.is_resolved() && !solver.scene().is_hard())
    result.warnings.push_back(
        "event takes soft contacts as hard ones of their restitution and friction");
  for (const std::string& warning : solver.scene().warnings) result.warnings.push_back(warning);
  fail_because_of_nan(not_numbers, result);
  if (!result.run.reached) result.warnings.push_back("the run did not end: " + result.run.reason);
  if (!seen.steady)
    result.warnings.push_back(
        "no steady state: H, K or R still drifts over the samples, or there are too few of them; "
        "more run.periods or run.discard");
  if (run.collapses > 0)
    result.warnings.push_back(fmt::format(
        "inelastic collapse: the rule of run.collapse changed {} of {} collisions and bounces",
        run.collapses, run.collisions));
  return result;
}

void run_box_ensemble(RemoteEngine& engine, const BoxEnsembleTask& task, EngineRecord& record) {
  const double step = 1 / record.rate;
  const Scene& scene = task.solver->scene().hard;
  record.version = engine.info().version;
  record.applied = engine.configure(scene, record.settings, step);

  const double end = run_end(*task.scenario).time;
  const double scale = planar_speed_scale(scene, scene.initial);
  const std::size_t chunk = static_cast<std::size_t>(std::clamp(end / step / 64, 16.0, 1024.0));
  std::vector<std::map<std::string, double>> seen;
  for (double start : phase_starts(step, step, task.phases)) {
    BoxObserver observer(scene, box_sampling(*task.scenario));
    Frame first;
    first.bodies = task.solver->states_at(start);
    engine.start(first.bodies, start);
    observer.take(start, first);
    std::size_t steps = 0;
    std::string fault;
    double time = start;
    while (time < end && fault.empty()) {
      record.cpu_seconds += engine.advance(chunk, [&](const Frame& frame) {
        time = start + (static_cast<double>(steps) + frame.part) * step;
        if (frame.part == 1) ++steps;
        if (!fault.empty()) return;
        // Falling adds to what the bodies bring with them.
        fault = fault_of_state(frame, time, scale + scene.gravity * time);
        if (fault.empty()) observer.take(time, frame);
      });
    }
    record.steps += steps;
    if (!fault.empty()) {
      record.status = EngineRecord::Status::unstable;
      record.reason = fault;
      return;
    }
    seen.push_back(values_of(observer.finish()));
    ++record.phases;
  }
  record.status = EngineRecord::Status::ok;
  record.observables = ensemble_values(seen);
  record.errors = deviations(*task.scenario, *task.reference, record.observables);
}

}  // namespace slipcheck
