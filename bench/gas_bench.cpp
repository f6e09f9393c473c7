#include <benchmark/benchmark.h>

#include "reference/gas/gas.h"
#include "scene/restitution_curve.h"

namespace slipcheck {
namespace {

/// Collisions of a gas on one core, a fourth of the mean time between two of a particle in each
/// step.
void run_gas_steps(benchmark::State& state, int dimensions, const PairContact& contact) {
  GasSetup setup;
  setup.sphere = {1e-3, 1e-6, 0.4};
  setup.dimensions = dimensions;
  setup.particles = static_cast<std::size_t>(state.range(0));
  setup.rotation = 0.5;
  Gas gas(setup, hard_gas(contact, setup.sphere));
  gas.advance();
  const std::size_t before = gas.collisions();
  for (auto _ : state) gas.advance();
  state.counters["collisions/s"] = benchmark::Counter(
      static_cast<double>(gas.collisions() - before), benchmark::Counter::kIsRate);
}

void BM_DsmcSmooth(benchmark::State& state) { run_gas_steps(state, 3, {.restitution = 0.9}); }
BENCHMARK(BM_DsmcSmooth)->Arg(10'000)->Arg(1'000'000);

void BM_DsmcSmoothDisks(benchmark::State& state) { run_gas_steps(state, 2, {.restitution = 0.9}); }
BENCHMARK(BM_DsmcSmoothDisks)->Arg(1'000'000);

void BM_DsmcViscoelastic(benchmark::State& state) {
  PairContact contact;
  contact.restitution = RestitutionCurve({}, ContactEnd::zero_overlap).over_speed(0.1);
  run_gas_steps(state, 3, contact);
}
BENCHMARK(BM_DsmcViscoelastic)->Arg(1'000'000);

void BM_DsmcRough(benchmark::State& state) {
  run_gas_steps(state, 3, {.restitution = 0.9, .friction = 0.3, .tangential_restitution = 0.4});
}
BENCHMARK(BM_DsmcRough)->Arg(1'000'000);

}  // namespace
}  // namespace slipcheck
