#include <benchmark/benchmark.h>

#include "grain_gas.h"
#include "reference/steps/grain_solver.h"

namespace slipcheck {
namespace {

/// Particle-steps a second, after a warm-up. Every turn begins anew: a gas that cools collides
/// less.
void run_grains(benchmark::State& state, bool on_plane) {
  const ContactScene scene = bench::grain_gas(static_cast<std::size_t>(state.range(0)),
                                              0.01 * static_cast<double>(state.range(1)), on_plane);
  constexpr std::size_t kWarmUp = 100, kSteps = 1000;
  for (auto _ : state) {
    state.PauseTiming();
    GrainSolver solver(scene, scene.hard.initial, bench::kStep);
    solver.advance(kWarmUp);
    state.ResumeTiming();
    solver.advance(kSteps);
  }
  state.counters["particle_steps/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * kSteps *
                             static_cast<double>(scene.hard.bodies.size()),
                         benchmark::Counter::kIsRate);
}

/// K's forces between grains on a plane without friction; bench/peers/run.py has a peer's.
void BM_GrainGas(benchmark::State& state) { run_grains(state, false); }
BENCHMARK(BM_GrainGas)
    ->ArgsProduct({{1'000, 10'000, 100'000}, {20, 70}})
    ->Unit(benchmark::kMillisecond);

/// The same where grains slide and roll.
void BM_GrainMonolayer(benchmark::State& state) { run_grains(state, true); }
BENCHMARK(BM_GrainMonolayer)
    ->ArgsProduct({{1'000, 10'000, 100'000}, {20, 70}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace slipcheck
