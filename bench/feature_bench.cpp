#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "grain_gas.h"
#include "reference/near_pairs.h"
#include "reference/steps/step_solver.h"

namespace slipcheck {
namespace {

constexpr std::size_t kGrains = 10'000;
constexpr double kAreaFraction = 0.4;

/// Four walls in place of the plane's repetition.
void enclose(ContactScene& scene) {
  Scene& hard = scene.hard;
  const double room = hard.bodies.front().radius;  // for those that lie across an edge
  const Vector3 least(-room, -room, 0), most(hard.periodic.x() + room, hard.periodic.y() + room, 0);
  hard.periodic.setZero();
  for (const auto& [point, normal] : {std::pair{least, Vector3(1, 0, 0)},
                                      {least, Vector3(0, 1, 0)},
                                      {most, Vector3(-1, 0, 0)},
                                      {most, Vector3(0, -1, 0)}}) {
    hard.surfaces.push_back({PlaneShape{point, normal}, {}});
    hard.on_surfaces.emplace_back().impact = hard.pairs[0];
    scene.soft_surfaces.emplace_back(scene.soft[0]);
  }
}

/// A monolayer that slides and rolls, plain or with one thing more.
ContactScene monolayer(const std::string& feature) {
  ContactScene scene =
      bench::grain_gas(kGrains, kAreaFraction, true, 1, feature == "radii" ? 3 : 1);
  Scene& hard = scene.hard;
  if (feature == "rolling") hard.substrate[0].rolling = RollingFriction(1e-4);
  if (feature == "tilt") hard.downhill = {hard.gravity * std::sin(0.1), 0};
  if (feature == "swing") hard.motion = SubstrateMotion::oscillation({0.1, 0}, 1, 0);
  if (feature == "lift_off") hard.confined = false;
  if (feature == "walls") enclose(scene);
  return scene;
}

/// Steps of grains that lie like those of the plain scene, with one feature more. Time for a grain
/// and step, and for a step of each pair that lies nearer than half a radius at the start.
void BM_GrainFeature(benchmark::State& state, const std::string& feature) {
  const ContactScene scene = monolayer(feature);
  constexpr double kWarmUp = 100, kSteps = 1000;
  for (auto _ : state) {
    state.PauseTiming();
    StepSolver solver(scene, scene.hard.initial, {.step = bench::kStep});
    solver.run(until_time(kWarmUp * bench::kStep), nullptr);
    state.ResumeTiming();
    const SolvedRun run = solver.run(until_time((kWarmUp + kSteps) * bench::kStep), nullptr);
    if (run.failed) state.SkipWithError(run.reason.c_str());
  }
  const auto near = near_pairs(
      NearSpheres(kGrains,
                  [&](std::size_t i) {
                    return NearSphere{scene.hard.initial[i].position, scene.hard.bodies[i].radius};
                  }),
      0.25, scene.hard.periodic);
  const auto each = [&](std::size_t count) {
    return benchmark::Counter(
        static_cast<double>(state.iterations()) * kSteps * static_cast<double>(count),
        benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  };
  state.counters["s/(grain step)"] = each(kGrains);
  state.counters["s/(near pair step)"] = each(near.size());
}
BENCHMARK_CAPTURE(BM_GrainFeature, plain, "plain")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_GrainFeature, rolling, "rolling")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_GrainFeature, radii, "radii")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_GrainFeature, tilt, "tilt")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_GrainFeature, swing, "swing")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_GrainFeature, lift_off, "lift_off")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_GrainFeature, walls, "walls")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace slipcheck
