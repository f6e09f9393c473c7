#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "grain_gas.h"
#include "reference/grain_solver.h"

namespace slipcheck {
namespace {

/// Particle-steps a second, after a warm-up as long as the peer's.
void run_grains(benchmark::State& state, const ContactScene& scene) {
  GrainSolver solver(scene, scene.hard.initial, bench::kStep);
  solver.advance(2000);
  constexpr std::size_t kSteps = 500;
  for (auto _ : state) solver.advance(kSteps);
  state.counters["particle_steps/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * kSteps *
                             static_cast<double>(scene.hard.bodies.size()),
                         benchmark::Counter::kIsRate);
}

void BM_GrainGas(benchmark::State& state) {
  run_grains(state, bench::grain_gas(static_cast<std::size_t>(state.range(0)),
                                     0.01 * static_cast<double>(state.range(1)), false));
}
BENCHMARK(BM_GrainGas)
    ->ArgsProduct({{1'000, 10'000, 100'000}, {20, 70}})
    ->Unit(benchmark::kMillisecond);

void BM_GrainMonolayer(benchmark::State& state) {
  run_grains(state, bench::grain_gas(static_cast<std::size_t>(state.range(0)),
                                     0.01 * static_cast<double>(state.range(1)), true));
}
BENCHMARK(BM_GrainMonolayer)
    ->ArgsProduct({{1'000, 10'000, 100'000}, {20, 70}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace slipcheck
