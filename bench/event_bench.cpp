#include <benchmark/benchmark.h>

#include "reference/events/event_scheduler.h"
#include "reference/events/indexed_heap.h"
#include "reference/events/planar_loop.h"
#include "reference/events/planar_world.h"
#include "reference/planar_scenes.h"

namespace slipcheck {
namespace {

/// Runs until each body has collided a few times, so that nothing remembers the lattice it began
/// on, and then counts.
template <class Queue, PlanarFeatures kHas = PlanarFeatures{}>
void run_events(benchmark::State& state, const Scene& scene) {
  constexpr std::size_t kWarmUp = 3;
  PlanarWorld world(scene, scene.initial, {});
  PlanarLoop<kHas> loop(world);
  EventScheduler<PlanarLoop<kHas>, Queue> scheduler(loop, 0);
  while (world.collisions() < kWarmUp * scene.bodies.size()) scheduler.step();
  const std::size_t before = world.collisions();
  std::size_t events = 0;
  for (auto _ : state) {
    scheduler.step();
    ++events;
  }
  state.counters["collisions/s"] = benchmark::Counter(
      static_cast<double>(world.collisions() - before), benchmark::Counter::kIsRate);
  state.SetItemsProcessed(static_cast<std::int64_t>(events));
}

constexpr PlanarFeatures kOneRadius{.radii = false};
constexpr PlanarFeatures kPlane{.box = false, .radii = false};
constexpr PlanarFeatures kSmoothPlane{.box = false, .radii = false, .spin = false};
// Known beforehand, so that nothing is set up again to find it: one second and more.
constexpr benchmark::IterationCount kEvents = 2'000'000;

/// Smooth elastic disks at an area fraction of 0.2: the time is that of one event, cell borders
/// included.
void BM_SmoothGas(benchmark::State& state) {
  run_events<CalendarQueue, kSmoothPlane>(
      state, test::smooth_gas(static_cast<std::size_t>(state.range(0)), 0.2, {.restitution = 1.0}));
}
BENCHMARK(BM_SmoothGas)->RangeMultiplier(10)->Range(1'000, 1'000'000)->Iterations(kEvents);

/// The same by the loop that leaves out nothing.
void BM_SmoothGasGeneral(benchmark::State& state) {
  run_events<CalendarQueue>(
      state, test::smooth_gas(static_cast<std::size_t>(state.range(0)), 0.2, {.restitution = 1.0}));
}
BENCHMARK(BM_SmoothGasGeneral)->RangeMultiplier(10)->Range(1'000, 1'000'000)->Iterations(kEvents);

/// The same with a binary heap for a queue.
void BM_SmoothGasWithHeap(benchmark::State& state) {
  run_events<HeapQueue, kSmoothPlane>(
      state, test::smooth_gas(static_cast<std::size_t>(state.range(0)), 0.2, {.restitution = 1.0}));
}
BENCHMARK(BM_SmoothGasWithHeap)->RangeMultiplier(10)->Range(1'000, 1'000'000)->Iterations(kEvents);

/// Rough disks that lose energy and spin.
template <PlanarFeatures kHas>
void BM_RoughGas(benchmark::State& state) {
  const PairContact rough{.restitution = 0.95, .friction = 0.1, .tangential_restitution = 0.4};
  run_events<CalendarQueue, kHas>(
      state, test::smooth_gas(static_cast<std::size_t>(state.range(0)), 0.2, rough));
}
BENCHMARK(BM_RoughGas<kPlane>)
    ->Name("BM_RoughGas")
    ->RangeMultiplier(10)
    ->Range(10'000, 1'000'000)
    ->Iterations(kEvents);
// More of so few would be those of another gas: it cools and forms clusters.
BENCHMARK(BM_RoughGas<kPlane>)->Name("BM_RoughGas")->Arg(1'000)->Iterations(kEvents / 50);
BENCHMARK(BM_RoughGas<PlanarFeatures{}>)
    ->Name("BM_RoughGasGeneral")
    ->Arg(10'000)
    ->Iterations(kEvents);

/// L's box at V = 1 m/s with rough walls.
template <PlanarFeatures kHas>
void BM_ShakenBox(benchmark::State& state) {
  const PairContact rough{.restitution = 0.9, .friction = 0.2, .tangential_restitution = 0.3};
  run_events<CalendarQueue, kHas>(
      state, test::shaken_box(static_cast<std::size_t>(state.range(0)), 1, rough));
}
BENCHMARK(BM_ShakenBox<kOneRadius>)->Name("BM_ShakenBox")->Arg(50)->Iterations(kEvents);
BENCHMARK(BM_ShakenBox<PlanarFeatures{}>)
    ->Name("BM_ShakenBoxGeneral")
    ->Arg(50)
    ->Iterations(kEvents);

}  // namespace
}  // namespace slipcheck
