// What is asked only of a worker that says that it takes it.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>

#include "engine/scene_needs.h"
#include "studies/conformance/checks.h"
#include "studies/conformance/trial_scenes.h"

namespace slipcheck {
namespace {

void expect_taken(const RemoteEngine& engine, const char* part, const char* what) {
  if (std::ranges::find(engine.info().takes, part) == engine.info().takes.end())
    throw NotJudged(fmt::format("it does not take {}", what));
}

void expect_many(const RemoteEngine& engine) {
  expect_taken(engine, scene_part::kMany, "many bodies");
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

/// The slip of the first one's surface on the second's where they face each other along x [m/s].
double slip_of(const Frame& frame) {
  const BodyState &a = frame.bodies[0], &b = frame.bodies[1];
  return a.velocity.y() - b.velocity.y() +
         kTrialRadius * (a.angular_velocity.z() + b.angular_velocity.z());
}

/// Two in flight that collide without loss and turn alike, so that their surfaces slip. A spring
/// k_t = κ k_n that always sticks moves κ m_eff and so swings as the normal one does: when they
/// part it has reversed the slip.
std::string springs_that_remember(const Trial& trial) {
  constexpr double kContact = 8 * kStep, kSlip = 0.01, kKappa = 2.0 / 7;
  RemoteEngine engine = trial.engine();
  expect_taken(engine, scene_part::kMemory, "contacts that remember");
  EngineScene scene = two_that_meet(0.1);
  for (BodyState& state : scene.initial) {
    state.position.z() = 1;
    state.angular_velocity = {0, 0, 0.5 * kSlip / kTrialRadius};
  }
  const double mass = 0.5 * scene.bodies[0].mass, omega = std::numbers::pi / kContact;
  const double stiffness = omega * omega * mass;
  SoftContact contact{LinearForce{stiffness, 0}, ContactEnd::zero_overlap, NoTangentialForce{}};
  ContactMemory& memory = contact.memory.emplace();
  memory.sliding.stiffness = kKappa * stiffness;
  memory.sliding.static_friction = memory.sliding.kinetic_friction = 100;
  scene.soft = SoftContacts{{contact}, {}, {}};
  engine.configure(scene, {}, kStep);
  const Frames frames = run(engine, scene, 150);
  const double left = slip_of(frames.back()) / kSlip;
  if (!(std::abs(left + 1) < 0.2))
    throw Breach(
        fmt::format("a slip that springs should reverse is {:.3g} of what it was, in place of −1, "
                    "when the bodies have parted",
                    left));
  return fmt::format("of a slip {:.3g} is left, in place of −1", left);
}

}  // namespace

std::vector<Check> takes_checks() {
  return {
      {"skip",
       "Answer a skip of count n with the bodies where n steps would have left them, in one frame, "
       "and go on from there.",
       skipped_steps},
      {"packed bodies",
       "Read packed_bodies where it stands in place of bodies: 28 bytes for each, radius, mass and "
       "shape factor as float64 and the material as u32, little-endian.",
       packed_bodies},
      {"contacts that remember",
       "Let the springs of a contact's memory act beside its normal force: sliding is a force "
       "−stiffness·s − damping·ṡ on the first body against the slip ṡ, s since the first touch, up "
       "to friction times the normal force.",
       springs_that_remember},
  };
}

}  // namespace slipcheck
