#include <benchmark/benchmark.h>

#include "harness/observe/observer.h"
#include "harness/run/reference_run.h"
#include "physics/polynomial_roots.h"
#include "reference/events/event_solver.h"
#include "scenes.h"

namespace slipcheck {
namespace {

const RunEnd kRolling{Run::Until::rolling, 0, 10};

/// From two rolling balls to what is observed of them: one run of the solver.
void BM_TwoBodyRun(benchmark::State& state) {
  const Scene scene = test::head_on(0.15, -0.15, 0.9);
  for (auto _ : state) {
    EventSolver solver(scene, scene.initial);
    Observer observer(scene, 0, 0.15);
    const SolvedRun run = solver.run(kRolling, &observer);
    benchmark::DoNotOptimize(observer.finish(run.end_time));
  }
}
BENCHMARK(BM_TwoBodyRun);

/// The whole answer: values by name with their uncertainties (three runs) and closed forms.
void BM_TwoBodyAnswer(benchmark::State& state) {
  const Scene scene = test::head_on(0.15, -0.15, 0.9);
  const std::vector<std::string> names = {"i", "j"};
  const ContactScene contacts = with_hard_contacts(scene);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        run_reference(ReferenceSolver(contacts, Compare::Reference::event), kRolling, names));
}
BENCHMARK(BM_TwoBodyAnswer);

/// The time of a collision on two parabolas.
void BM_CollisionTime(benchmark::State& state) {
  const Quartic gap = {24, -20, 5.5, -0.4, 0.05};
  for (auto _ : state) benchmark::DoNotOptimize(first_falling_root(gap, 3));
}
BENCHMARK(BM_CollisionTime);

}  // namespace
}  // namespace slipcheck
