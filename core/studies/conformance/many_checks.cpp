// What is asked only of a worker that takes many bodies.

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "engine/scene_needs.h"
#include "studies/conformance/checks.h"
#include "studies/conformance/trial_scenes.h"

namespace slipcheck {
namespace {

void expect_many(const RemoteEngine& engine) {
  if (std::ranges::find(engine.info().takes, scene_part::kMany) == engine.info().takes.end())
    throw NotJudged("it does not take many bodies");
}

/// Its bodies alone.
Frames bodies_of(const Frame& frame) {
  Frames alone(1);
  alone[0].bodies = frame.bodies;
  return alone;
}

/// Two that meet in step 20, with steps that are skipped before, across and after that, and one
/// that is looked at in between.
std::string skipped_steps(const Trial& trial) {
  constexpr std::size_t kSteps = 40;
  RemoteEngine engine = trial.engine();
  expect_many(engine);
  const Scene scene = two_that_meet(0.01 * 1024 / 20);
  engine.configure(scene, {}, kStep);
  const Frames each = run(engine, scene, kSteps);
  engine.start(scene.initial);
  std::size_t taken = 0;
  for (const auto& [skips, count] :
       {std::pair{true, std::size_t{7}}, {false, 1}, {true, 1}, {true, 20}, {true, 11}}) {
    taken += count;
    Frame seen;
    if (skips)
      engine.skip(count, seen.bodies);
    else
      seen = advance(engine, count).back();
    expect_same(bodies_of(seen), bodies_of(each[taken - 1]),
                "after " + std::to_string(taken) + " steps, of which some were skipped");
  }
  return {};
}

/// Spheres that differ in all that is packed, sent one by one and in one piece.
std::string packed_bodies(const Trial& trial) {
  constexpr std::size_t kSteps = 20;
  Scene scene = spheres_on_plane(3);
  scene.material[1] = 1;
  scene.substrate.push_back(scene.substrate[0]);
  scene.substrate[1].static_friction = scene.substrate[1].kinetic_friction = 0.5 * kTrialFriction;
  scene.pairs.assign(4, scene.pairs[0]);
  scene.bodies[2].radius *= 0.8;
  scene.bodies[2].mass *= 0.3;
  scene.initial[2].position.z() = scene.bodies[2].radius;
  for (BodyState& state : scene.initial) state.velocity.x() = 1;
  EngineScene packed(scene);
  packed.packed = true;
  const auto frames_of = [&](const EngineScene& given) {
    RemoteEngine engine = trial.engine();
    expect_many(engine);
    engine.configure(given, {}, kStep);
    return run(engine, given, kSteps);
  };
  expect_same(frames_of(packed), frames_of(scene), "bodies that came packed, and one by one");
  return {};
}

}  // namespace

std::vector<Check> many_checks() {
  return {
      {"skip",
       "Answer a skip of count n with the bodies where n steps would have left them, in one frame, "
       "and go on from there.",
       skipped_steps},
      {"packed bodies",
       "Read packed_bodies where it stands in place of bodies: 28 bytes for each, radius, mass and "
       "shape factor as float64 and the material as u32, little-endian.",
       packed_bodies},
  };
}

}  // namespace slipcheck
