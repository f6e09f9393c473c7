#include <benchmark/benchmark.h>

#include <cstddef>

#include "reference/piles/pile_solver.h"
#include "reference/steps/step_solver.h"
#include "soft_bed.h"

namespace slipcheck {
namespace {

/// Particle-steps a second of spheres that settle in a container, by number, ratio of radii and
/// threads; bench/peers/beds.py has a peer's.
void BM_SoftBed(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const ContactScene scene =
      bench::soft_bed({.count = n, .ratio = static_cast<double>(state.range(1))});
  constexpr double kStep = 2e-5, kWarmUp = 500, kSteps = 500;
  for (auto _ : state) {
    state.PauseTiming();
    PileSolver solver(scene, scene.hard.initial,
                      {.step = kStep, .threads = static_cast<std::size_t>(state.range(2))});
    solver.run(until_time(kWarmUp * kStep), nullptr);
    state.ResumeTiming();
    solver.run(until_time((kWarmUp + kSteps) * kStep), nullptr);
  }
  state.counters["particle_steps/s"] =
      benchmark::Counter(static_cast<double>(state.iterations() * state.range(0)) * kSteps,
                         benchmark::Counter::kIsRate);
}
BENCHMARK(BM_SoftBed)
    ->ArgsProduct({{1'000, 10'000, 100'000}, {1, 3}, {1}})
    ->Args({10'000, 1, 2})
    ->Args({100'000, 1, 2})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// Steps over neighbours beside those over all pairs, of a few dozen balls of unlike radii.
void BM_StepNeighbours(benchmark::State& state) {
  ContactScene scene = bench::soft_bed(
      {.count = static_cast<std::size_t>(state.range(0)), .ratio = 3, .walls = false});
  scene.soft[0]->memory.reset();
  scene.soft[0]->tangential = ViscousForce{0.1, 0.4};
  const auto most = static_cast<std::size_t>(state.range(1));
  constexpr double kStep = 1e-5, kSteps = 1000;
  scene.hard.periodic.setZero();
  for (auto _ : state) {
    StepSolver solver(scene, scene.hard.initial, {.step = kStep, .most_in_all_pairs = most});
    solver.run(until_time(kSteps * kStep), nullptr);
  }
  state.counters["particle_steps/s"] =
      benchmark::Counter(static_cast<double>(state.iterations() * state.range(0)) * kSteps,
                         benchmark::Counter::kIsRate);
}
BENCHMARK(BM_StepNeighbours)
    ->ArgsProduct({{32, 200, 1'000}, {0, 1'000'000}})
    ->Args({10'000, 0})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace slipcheck
