// Starts, steps and what they return.

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "studies/conformance/checks.h"
#include "studies/conformance/trial_scenes.h"

namespace slipcheck {
namespace {

using Wall = std::chrono::steady_clock;

constexpr std::size_t kSteps = 100;
constexpr double kLongEnough = 0.05;  // of a measured stretch, against the clocks' resolution [s]

double seconds_since(Wall::time_point begin) {
  return std::chrono::duration<double>(Wall::now() - begin).count();
}

/// Two spheres that meet, bounce and slide within kSteps.
Scene colliding_scene() { return two_that_meet(0.5); }

std::string frames_of_steps(const Trial& trial) {
  RemoteEngine engine = trial.engine();
  const Scene scene = spheres_on_plane(3);
  engine.configure(scene, {}, kStep);
  engine.start(scene.initial);
  std::size_t inside = 0;
  for (const std::size_t steps : {1, 1, 5, 30}) {
    const Frames frames = advance(engine, steps);
    inside += frames.size() - steps;
  }
  return inside == 0 ? "" : fmt::format("{} frames inside steps", inside);
}

std::string fresh_start(const Trial& trial) {
  RemoteEngine engine = trial.engine();
  const Scene scene = colliding_scene();
  engine.configure(scene, {}, kStep);
  const Frames first = run(engine, scene, kSteps);
  Scene other = scene;
  for (BodyState& state : other.initial) state.velocity = {0.1, -0.7, 0.4};
  run(engine, other, kSteps / 2);
  expect_same(first, run(engine, scene, kSteps), "the same states, with another run between them");
  return {};
}

std::string another_process(const Trial& trial) {
  const Scene scene = colliding_scene();
  expect_same(run_alone(trial, scene, kSteps), run_alone(trial, scene, kSteps),
              "the same states in two processes");
  return {};
}

std::string steps_at_once(const Trial& trial) {
  RemoteEngine engine = trial.engine();
  const Scene scene = colliding_scene();
  engine.configure(scene, {}, kStep);
  const Frames at_once = run(engine, scene, kSteps);
  engine.start(scene.initial);
  Frames one_by_one;
  for (std::size_t n = 0; n < kSteps; ++n)
    for (Frame& frame : advance(engine, 1)) one_by_one.push_back(std::move(frame));
  expect_same(at_once, one_by_one, "100 steps in one request and in 100");
  return {};
}

std::string several_scenes(const Trial& trial) {
  RemoteEngine engine = trial.engine();
  const Scene scene = colliding_scene(), crowd = spheres_on_plane(5);
  engine.configure(scene, {}, kStep);
  const Frames before = run(engine, scene, kSteps);
  engine.configure(crowd, {}, kStep / 2);
  run(engine, crowd, 10);
  engine.configure(scene, {}, kStep);
  expect_same(before, run(engine, scene, kSteps), "a scene before and after another one");
  return {};
}

/// As many bytes as the harness asks for at once.
std::string long_reply(const Trial& trial) {
  RemoteEngine engine = trial.engine();
  const Scene scene = one_sphere(0.05);
  engine.configure(scene, {}, kStep);
  const std::size_t frames = run(engine, scene, 7000).size();
  return fmt::format("{} frames", frames);
}

/// CPU time that is longer than all processors had, or next to none.
void expect_sensible(double cpu_seconds, double wall, std::size_t steps) {
  const double most = std::max(1u, std::thread::hardware_concurrency()) * wall + 0.02;
  if (cpu_seconds > most)
    throw Breach(fmt::format("{} steps took {:.3g} s of CPU time within {:.3g} s", steps,
                             cpu_seconds, wall));
  if (wall > kLongEnough && !(cpu_seconds > 0))
    throw Breach(fmt::format("{} steps in {:.3g} s took no CPU time", steps, wall));
}

std::string cpu_of_steps(const Trial& trial) {
  RemoteEngine engine = trial.engine();
  const Scene scene = spheres_on_plane(20);
  engine.configure(scene, {}, kStep);
  engine.start(scene.initial);
  double cpu = 0, wall = 0;
  std::size_t steps = 0;
  for (std::size_t n = 50; wall < 2 * kLongEnough && steps < 100'000; n *= 2) {
    const auto begin = Wall::now();
    cpu += engine.advance(n, [](const Frame&) {});
    wall += seconds_since(begin);
    steps += n;
  }
  expect_sensible(cpu, wall, steps);
  return fmt::format("{:.3g} µs for each step of {} spheres",
                     1e6 * cpu / static_cast<double>(steps), scene.bodies.size());
}

std::string time_request(const Trial& trial) {
  RemoteEngine engine = trial.engine();
  const Scene scene = spheres_on_plane(20);
  engine.configure(scene, {}, kStep);
  std::vector<double> times;
  double wall = 0;
  std::size_t steps = 50;
  for (; wall < 2 * kLongEnough && steps < 100'000; steps *= 2) {
    const auto begin = Wall::now();
    times = engine.time_steps(scene.initial, 0, steps, 2);
    wall = seconds_since(begin);
  }
  steps /= 2;
  double sum = 0;
  for (const double time : times) sum += time;
  expect_sensible(sum, wall, 2 * steps);
  // What is not measured is two starts: nothing beside many steps.
  if (wall > kLongEnough && sum < 0.01 * wall)
    throw Breach(fmt::format("{} steps took {:.3g} s of {:.3g} s: is it another unit?", 2 * steps,
                             sum, wall));
  run(engine, scene, 3);
  return fmt::format("{:.3g} µs for each step of {} spheres",
                     1e6 * sum / static_cast<double>(2 * steps), scene.bodies.size());
}

/// An answer is asked for, no matter which: a state that blew up is a result.
std::string states_that_blew_up(const Trial& trial) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::string text;
  const std::pair<const char*, double> values[] = {
      {"NaN", std::numeric_limits<double>::quiet_NaN()}, {"infinite", kInfinity}, {"1e200", 1e200}};
  for (const auto& [name, value] : values) {
    Scene scene = spheres_on_plane(2);
    WorkerProcess worker = trial.process();
    reply_type(worker, hello_request());
    if (reply_type(worker, configure_request(scene)) != "configured")
      throw NotJudged("the engine refuses the scene");
    scene.initial[0].velocity.x() = value;
    if (!text.empty()) text += ", ";
    try {
      const std::string started = reply_type(worker, start_request(scene.initial));
      const std::string type = started == "started" ? reply_type(worker, step_request(5)) : started;
      if (type != "frames" && type != "failed")
        throw Breach(fmt::format("a velocity {} is answered with \"{}\"", name, type));
      text += fmt::format("{}: {}", name, type);
    } catch (const WorkerFailure& failure) {
      throw Breach(fmt::format("a velocity {}: {}", name, failure.what()));
    }
  }
  return text;
}

}  // namespace

std::vector<Check> frame_checks() {
  return {
      {"frames",
       "Answer a step of count n with a frame at the end of each of the n steps: 72 bytes for each "
       "body, "
       "count and bodies beside them, a touch count for each frame, 16 bytes for each touch, all "
       "little-endian.",
       frames_of_steps},
      {"fresh start",
       "Make a new world in start: no cache, contact, warm start, random number or step counter of "
       "an earlier run may be left.",
       fresh_start},
      {"another process", "Let nothing depend on addresses, hash orders, threads or time.",
       another_process},
      {"steps at once", "Do nothing at the beginning or end of a request that changes the world.",
       steps_at_once},
      {"several scenes", "Let a configure leave nothing of the scene before.", several_scenes},
      {"long reply", "Write until all of a reply is written, and within the time limit of a reply.",
       long_reply},
      {"cpu_seconds", "Give the CPU time of the steps alone, in seconds.", cpu_of_steps},
      {"time",
       "Answer with as many times as repeats, each of steps steps from a fresh world, in seconds "
       "of "
       "CPU time; a start and steps may follow.",
       time_request},
      {"states that blew up",
       "Take any state that start gives and answer with frames that may hold NaN and infinities, "
       "or "
       "with {type: \"failed\", reason: text}; do not crash or loop.",
       states_that_blew_up},
  };
}

}  // namespace slipcheck
