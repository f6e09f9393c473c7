#include <benchmark/benchmark.h>

#include "reference/event_scheduler.h"
#include "reference/indexed_heap.h"
#include "reference/planar_scenes.h"
#include "reference/planar_world.h"

namespace slipcheck {
namespace {

/// Runs until each body has collided a few times, so that nothing remembers the lattice it began
/// on, and then counts.
template <class Queue>
void run_events(benchmark::State& state, const HardScene& scene) {
  constexpr std::size_t kWarmUp = 3;
  PlanarWorld world(scene, scene.initial, 0, 0);
  EventScheduler<PlanarWorld, Queue> scheduler(world, 0);
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

/// Smooth elastic disks at an area fraction of 0.2: the time is that of one event, cell borders
/// included.
void BM_SmoothGas(benchmark::State& state) {
  run_events<CalendarQueue>(
      state, test::smooth_gas(static_cast<std::size_t>(state.range(0)), 0.2, {.restitution = 1.0}));
}
BENCHMARK(BM_SmoothGas)->RangeMultiplier(10)->Range(1'000, 1'000'000)->MinTime(1);

/// The same with a binary heap for a queue.
void BM_SmoothGasWithHeap(benchmark::State& state) {
  run_events<HeapQueue>(
      state, test::smooth_gas(static_cast<std::size_t>(state.range(0)), 0.2, {.restitution = 1.0}));
}
BENCHMARK(BM_SmoothGasWithHeap)->RangeMultiplier(10)->Range(1'000, 1'000'000)->MinTime(1);

/// Rough disks that lose energy and spin.
void BM_RoughGas(benchmark::State& state) {
  const PairContact rough{.restitution = 0.95, .friction = 0.1, .tangential_restitution = 0.4};
  run_events<CalendarQueue>(state,
                            test::smooth_gas(static_cast<std::size_t>(state.range(0)), 0.2, rough));
}
BENCHMARK(BM_RoughGas)->Arg(10'000)->MinTime(1);

/// L's box at V = 1 m/s with rough walls.
void BM_ShakenBox(benchmark::State& state) {
  const PairContact rough{.restitution = 0.9, .friction = 0.2, .tangential_restitution = 0.3};
  run_events<CalendarQueue>(state,
                            test::shaken_box(static_cast<std::size_t>(state.range(0)), 1, rough));
}
BENCHMARK(BM_ShakenBox)->Arg(50);

}  // namespace
}  // namespace slipcheck
