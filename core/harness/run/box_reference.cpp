#include "harness/run/box_reference.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <vector>

#include "harness/run/cpu_time.h"
#include "physics/numbers.h"

namespace slipcheck {
namespace {

/// Samples in a period of the floor where the scenario does not ask for phase zero alone, and in
/// the run where the floor has no period.
constexpr std::size_t kSamplesPerPeriod = 16;
constexpr double kSamplesOfStillBox = 1000;

UncertainValue average(const BlockedMean& mean) {
  const double half = mean.half_width95();
  return {mean.mean, std::isnan(half) ? std::numeric_limits<double>::infinity() : half};
}

/// Errors are their own uncertainty.
UncertainValue drift(double error) { return {std::abs(error), std::abs(error)}; }

}  // namespace

BoxSampling box_sampling(const Scenario& scenario) {
  BoxSampling sampling;
  sampling.discard = static_cast<std::size_t>(scenario.run.discard);
  sampling.until_steady = scenario.run.discard_until_steady;
  sampling.per_period = scenario.run.sample_phase_zero ? 1 : kSamplesPerPeriod;
  sampling.interval = scenario.run.time / kSamplesOfStillBox;
  return sampling;
}

std::map<std::string, BlockedMean> box_means(const BoxObservables& seen) {
  std::map<std::string, BlockedMean> means{{"all.height", seen.height},
                                           {"all.kinetic_energy", seen.kinetic_energy},
                                           {"all.rotational_energy", seen.rotational_energy},
                                           {"all.collision_rate", seen.collision_rate}};
  std::erase_if(means, [](const auto& named) { return named.second.samples == 0; });
  return means;
}

ReferenceResult run_box_reference(const ReferenceSolver& solver, const Scenario& scenario) {
  const Scene& scene = solver.scene().hard;
  const BoxSampling sampling = box_sampling(scenario);
  BoxObserver observer(scene, sampling);
  RunEnd end = run_end(scenario);
  end.sample_interval = sampling_interval(scene, sampling);
  ReferenceResult result;
  result.solver = solver.name();
  result.first_contact = kNever;
  const double begin = thread_cpu_seconds();
  result.run = solver.run(end, &observer);
  result.cpu_seconds = thread_cpu_seconds() - begin;

  const BoxObservables seen = observer.finish();
  std::vector<std::string> not_numbers;
  for (const auto& [name, mean] : box_means(seen))
    if (std::isnan(mean.mean))
      not_numbers.push_back(name);
    else
      result.observables.emplace(name, average(mean));
  if (const double error = result.run.balance->error(); std::isnan(error))
    not_numbers.push_back("all.energy_drift");
  else
    result.observables["all.energy_drift"] = drift(error);
  if (const double error = result.run.momentum_error; !std::isnan(error))
    result.observables["all.momentum_drift"] = drift(error);
  result.run.balance.reset();  // told by then
  result.box = BoxReference{seen.samples, seen.discarded, seen.steady, observer.series()};

  if (solver.hardens())
    result.warnings.push_back(
        "event takes soft contacts as hard ones of their restitution and friction");
  for (const std::string& warning : solver.scene().warnings) result.warnings.push_back(warning);
  fail_because_of_nan(not_numbers, result);
  if (!result.run.reached) result.warnings.push_back("the run did not end: " + result.run.reason);
  if (!seen.steady)
    result.warnings.push_back(
        "no steady state: H, K or R still drifts over the samples, or there are too few of them; "
        "more run.periods or run.discard");
  if (result.run.collapses > 0)
    result.warnings.push_back(fmt::format(
        "inelastic collapse: the rule of run.collapse changed {} of {} collisions and bounces",
        result.run.collapses, result.run.collisions));
  return result;
}

}  // namespace slipcheck
