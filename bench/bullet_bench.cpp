#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "bullet_backend/bullet_engine.h"
#include "engine/engine_registry.h"
#include "engine/profile.h"
#include "engine/remote_engine.h"
#include "harness/run/cpu_time.h"
#include "scenes.h"

namespace slipcheck {
namespace {

constexpr double kStep = 1.0 / 240;
constexpr std::size_t kSteps = 200;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Steel balls that roll one after the other, so that all contacts last and no two meet.
Scene rolling(std::size_t balls) {
  Scene scene = test::steel_scene(balls);
  for (std::size_t i = 0; i < balls; ++i)
    scene.initial[i] = test::rolling_at(0.01 * static_cast<double>(i), 0, 0.3, 0);
  return scene;
}

Settings settings_of(const std::string& profile) {
  if (profile == "default") return {};
  return load_profile(find_profile(*find_engine("bullet", "double"), profile, ".").value())
      .settings;
}

double seconds_of_steps(Engine& engine) {
  const double before = thread_cpu_seconds();
  for (std::size_t k = 0; k < kSteps; ++k) engine.step();
  return thread_cpu_seconds() - before;
}

/// A step, and the start of a run, without what the scene does not need and with all of it: the
/// least of many runs of both, in turn.
void BM_LeavingOut(benchmark::State& state, const std::string& profile, std::size_t balls) {
  const Scene scene = rolling(balls);
  const std::unique_ptr<Engine> engine = bullet::make_bullet_engine();
  Settings chosen[2] = {settings_of(profile), settings_of(profile)};
  chosen[1]["leaves_out"] = false;
  double step[2] = {kInfinity, kInfinity}, start[2] = {kInfinity, kInfinity};
  for (auto _ : state)
    for (const int general : {0, 1}) {
      engine->configure(scene, chosen[general], kStep);
      const double before = thread_cpu_seconds();
      engine->start(scene.initial, 0);
      start[general] = std::min(start[general], thread_cpu_seconds() - before);
      step[general] = std::min(step[general], seconds_of_steps(*engine));
    }
  state.counters["step_us"] = 1e6 * step[0] / kSteps;
  state.counters["general_step_us"] = 1e6 * step[1] / kSteps;
  state.counters["start_us"] = 1e6 * start[0];
  state.counters["general_start_us"] = 1e6 * start[1];
  state.counters["ratio"] = step[0] / step[1];
}
BENCHMARK_CAPTURE(BM_LeavingOut, default_one_ball, "default", 1)->Iterations(500);
BENCHMARK_CAPTURE(BM_LeavingOut, default_two_balls, "default", 2)->Iterations(500);
BENCHMARK_CAPTURE(BM_LeavingOut, physical_one_ball, "physical", 1)->Iterations(500);
BENCHMARK_CAPTURE(BM_LeavingOut, physical_two_balls, "physical", 2)->Iterations(500);

/// Eight balls that have come to rest, `physical` and never asleep: the steps from 20 s to 40 s,
/// with denormal numbers flushed to zero and kept. "ratio" is what keeping them costs.
void BM_AtRest(benchmark::State& state, const std::string& precision, double rate) {
  constexpr double kRadius = 0.1;  // [m]
  Scene scene = test::steel_scene(8);
  for (std::size_t i = 0; i < 8; ++i) {
    scene.bodies[i].mass *= std::pow(kRadius / scene.bodies[i].radius, 3);
    scene.bodies[i].radius = kRadius;
    scene.initial[i] = test::rolling_at(0, static_cast<double>(i),
                                        0.1 + 0.01 * static_cast<double>(i), 0, kRadius);
  }
  scene.substrate[0].rolling = RollingFriction(0.02);
  RemoteEngine engine(find_engine("bullet", precision)->command);
  Settings chosen[2] = {settings_of("physical"), settings_of("physical")};
  const auto settled = static_cast<std::size_t>(20 * rate);
  double step[2] = {kInfinity, kInfinity};
  for (auto _ : state)
    for (const int kept : {0, 1}) {
      chosen[kept]["flush_denormals"] = kept == 0;
      engine.configure(scene, chosen[kept], 1 / rate);
      const double until = engine.time_steps(scene.initial, 0, settled, 1)[0];
      const double all = engine.time_steps(scene.initial, 0, 2 * settled, 1)[0];
      step[kept] = std::min(step[kept], (all - until) / static_cast<double>(settled));
    }
  state.counters["step_us"] = 1e6 * step[0];
  state.counters["kept_step_us"] = 1e6 * step[1];
  state.counters["ratio"] = step[1] / step[0];
}
BENCHMARK_CAPTURE(BM_AtRest, double_240, "double", 240)->Iterations(5);
BENCHMARK_CAPTURE(BM_AtRest, single_240, "single", 240)->Iterations(5);

}  // namespace
}  // namespace slipcheck
