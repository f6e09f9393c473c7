#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "../../bench/soft_bed.h"
#include "../support/instruction_set.h"
#include "physics/numbers.h"
#include "reference/piles/pile_solver.h"

namespace slipcheck {
namespace {

using bench::soft_bed;
using bench::SoftBed;

/// Of hard contacts with a plane [s], about as short as the lightest spheres' own.
constexpr double kOnPlane = 2e-4;
constexpr std::size_t kAlwaysOneList = ~std::size_t{0};

struct Impulses final : FrameSink {
  void take(double, const Frame& frame) override {
    for (const Touch& touch : frame.touches) sum += touch.normal_impulse;
    EXPECT_TRUE(std::ranges::is_sorted(
        frame.touches, {}, [](const Touch& t) { return std::pair(t.first, t.second); }));
  }
  double sum = 0;
};

struct Ended {
  std::vector<BodyState> states;
  EnergyBalance balance;
  std::size_t collisions = 0;
  double impulse = 0;
  std::string features;
};

Ended run(const ContactScene& scene, std::size_t steps, const PileSettings& settings) {
  PileSolver solver(scene, scene.hard.initial, settings);
  Impulses sink;
  const SolvedRun run = solver.run(until_time(static_cast<double>(steps) * solver.step()), &sink);
  EXPECT_TRUE(run.reached) << run.reason;
  std::string features;
  for (const std::string& each : solver.features()) features += each + "; ";
  return {solver.states(), *run.balance, run.collisions, sink.sum, features};
}

/// In slabs only the order of sums differs from one list in the scene's order: 1e-16 of a force,
/// which collisions make some 1e5 times as large in so many steps.
TEST(ManyContacts, InSlabsAreThoseOfOneList) {
  for (const bool walls : {true, false}) {
    const ContactScene scene = soft_bed({.count = 1500, .ratio = 3, .walls = walls});
    const auto end = [&](std::size_t ordered_from) {
      return run(scene, 1200,
                 {.steps_per_contact = 20,
                  .collision_time = kOnPlane,
                  .steps_per_frame = 100,
                  .ordered_from = ordered_from});
    };
    const Ended slabs = end(1), list = end(kAlwaysOneList);
    EXPECT_GT(list.collisions, 100u);
    EXPECT_EQ(slabs.collisions, list.collisions);
    EXPECT_NEAR(slabs.impulse, list.impulse, 1e-9 * list.impulse);
    EXPECT_NEAR(slabs.balance.dissipated, list.balance.dissipated, 1e-9 * list.balance.dissipated);
    for (std::size_t i = 0; i < list.states.size(); ++i)
      ASSERT_NEAR((slabs.states[i].position - list.states[i].position).norm(), 0, 1e-11) << i;
  }
}

constexpr double kSpacing = 10.2e-3;  // of soft_bed()'s lattice

/// Above the plane and without gravity, in a long row of slabs, at rest.
ContactScene long_row(bool repeats) {
  ContactScene scene = soft_bed({.count = 1600, .length = 60, .walls = false});
  scene.hard.gravity = 0;
  if (!repeats) scene.hard.periodic.setZero();
  for (BodyState& state : scene.hard.initial) {
    state.position.z() += 1;
    state.velocity.setZero();
  }
  return scene;
}

/// Two sheets of spheres that fly at each other through the holes of a third one at rest: a slab of
/// its own, which without a second skin would be as thin as two bodies that are near.
ContactScene through_a_sheet() {
  constexpr std::size_t kRow = 17, kSheet = kRow * kRow;
  ContactScene scene = soft_bed({.count = 3 * kSheet + 2, .walls = false});
  scene.hard.gravity = 0;
  scene.hard.periodic.setZero();
  const double radius = scene.hard.bodies[0].radius, skin = 0.1 * radius;
  const double cell = 1.0001 * (2 * radius + skin);
  const auto put = [&](std::size_t i, double x, double y, double z, double speed) {
    scene.hard.initial[i] = {Vector3(x, y, 1 + z), Vector3(speed, 0, 0), Vector3::Zero()};
  };
  for (std::size_t k = 0; k < kSheet; ++k) {
    const double y = 6 * radius * static_cast<double>(k / kRow),
                 z = 6 * radius * static_cast<double>(k % kRow);
    put(3 * k, 29.999 * cell, y, z, 1);
    put(3 * k + 1, 30.5 * cell, y + 3 * radius, z + 3 * radius, 0);
    put(3 * k + 2, 31.001 * cell, y, z, -1);
  }
  // Slabs lie along the longest way.
  put(3 * kSheet, 0, 3 * radius, 3 * radius, 1);
  put(3 * kSheet + 1, 60 * cell, 3 * radius, 3 * radius, -1);
  return scene;
}

/// Bodies meet when they do, whatever their slabs do: two that fly at each other among others at
/// rest; what meets around the period, where the last slab is beside the first; two slabs through a
/// third one; two parts that move as they are, and wherever one slab ends and the next begins there
/// none moves in its own.
TEST(ManyContacts, MeetWhateverTheirSlabsDo) {
  std::vector<ContactScene> scenes = {long_row(false), long_row(true)};
  const std::size_t one = 60 * 2 + 30, other = one + 60;  // beside each other along y
  scenes[0].hard.initial[one].velocity.y() = 0.5;
  scenes[0].hard.initial[other].velocity.y() = -0.5;
  for (BodyState& state : scenes[1].hard.initial)
    state.velocity.x() = -6 * std::sin(2 * M_PI * state.position.x() / scenes[1].hard.periodic.x());
  scenes.push_back(through_a_sheet());
  for (int column = 8; column < 14; ++column) {
    ContactScene& parts = scenes.emplace_back(long_row(false));
    for (BodyState& state : parts.hard.initial)
      state.velocity.x() = state.position.x() < (column + 0.1) * kSpacing ? 0.3 : -0.3;
  }
  for (const ContactScene& scene : scenes) {
    const auto end = [&](std::size_t ordered_from, std::size_t threads) {
      return run(scene, 200,
                 {.steps_per_contact = 20,
                  .collision_time = kOnPlane,
                  .steps_per_frame = 100,
                  .threads = threads,
                  .ordered_from = ordered_from});
    };
    const Ended slabs = end(1, 1), shared = end(1, 3), list = end(kAlwaysOneList, 1);
    EXPECT_GT(list.collisions, 0u);
    EXPECT_EQ(slabs.collisions, list.collisions);
    for (std::size_t i = 0; i < list.states.size(); ++i) {
      ASSERT_NEAR((slabs.states[i].position - list.states[i].position).norm(), 0, 1e-11) << i;
      ASSERT_EQ(shared.states[i].position, slabs.states[i].position) << i;
    }
  }
}

/// `rows` of so many spheres along x, far above the plane and from each other, without gravity.
ContactScene spheres_in_rows(std::size_t rows, std::size_t in_row) {
  ContactScene scene = soft_bed({.count = rows * in_row, .walls = false});
  scene.hard.gravity = 0;
  scene.hard.periodic.setZero();
  const double radius = scene.hard.bodies[0].radius;
  for (std::size_t i = 0; i < rows * in_row; ++i)
    scene.hard.initial[i] = {Vector3(0, 5 * radius * static_cast<double>(i / in_row), 1),
                             Vector3::Zero(), Vector3::Zero()};
  return scene;
}

constexpr double kRebound = 0.5;  // of soft_bed()'s contacts

/// Pairs of equal spheres that are less than a skin apart at first all part at e of the speed at
/// which they met: each contact begins when it does. Rebounds are known to 1e-3 in such steps.
TEST(ManyContacts, BeginWhereverInASkin) {
  constexpr std::size_t kPairs = 48;
  constexpr double kSpeed = 0.2;
  ContactScene scene = spheres_in_rows(kPairs, 2);
  const double radius = scene.hard.bodies[0].radius, skin = 0.1 * radius;
  for (std::size_t k = 0; k < kPairs; ++k) {
    BodyState &one = scene.hard.initial[2 * k], &other = scene.hard.initial[2 * k + 1];
    one.velocity.x() = kSpeed;
    other.velocity.x() = -kSpeed;
    other.position.x() = 2 * radius + skin * (static_cast<double>(k) + 0.5) / kPairs;
  }
  PileSolver solver(scene, scene.hard.initial, {.step = 2.5e-5});
  const SolvedRun run = solver.run(until_time(skin / (2 * kSpeed) + 2e-3), nullptr);
  ASSERT_TRUE(run.reached) << run.reason;
  EXPECT_EQ(run.collisions, kPairs);
  const std::vector<BodyState> ended = solver.states();
  for (std::size_t k = 0; k < kPairs; ++k) {
    EXPECT_NEAR(ended[2 * k].velocity.x(), -kRebound * kSpeed, 2e-3 * kSpeed) << k;
    EXPECT_NEAR(ended[2 * k + 1].velocity.x(), kRebound * kSpeed, 2e-3 * kSpeed) << k;
  }
}

/// Two get too deep into each other in a step in which others part, as one pair does in each: the
/// run has failed, and its last energy is a number.
TEST(ManyContacts, FailWhileOthersPart) {
  constexpr std::size_t kPairs = 48;
  constexpr double kSpeed = 0.2, kTooFast = 30;
  ContactScene scene = spheres_in_rows(kPairs, 2);
  const double diameter = 2 * scene.hard.bodies[0].radius;
  for (std::size_t k = 0; k < kPairs; ++k) {
    const bool last = k + 1 == kPairs;
    BodyState &one = scene.hard.initial[2 * k], &other = scene.hard.initial[2 * k + 1];
    one.velocity.x() = last ? kTooFast : kSpeed;
    other.velocity.x() = -one.velocity.x();
    other.position.x() =
        diameter + one.velocity.x() * (last ? 3.2e-3 : 5e-5 * static_cast<double>(k));
  }
  PileSolver solver(scene, scene.hard.initial, {.step = 2.5e-5});
  const SolvedRun run = solver.run(until_time(0.01), nullptr);
  EXPECT_FALSE(run.reached);
  EXPECT_NE(run.reason.find("deep"), std::string::npos) << run.reason;
  EXPECT_TRUE(std::isfinite(run.balance->energy));
}

/// One sphere meets the next, parts from it, is hit from behind and meets it again, while they are
/// less than a thousandth of a radius apart: velocities are those of central collisions one after
/// the other.
TEST(ManyContacts, BeginAgainSoon) {
  constexpr std::size_t kRows = 32;
  constexpr double kSpeed = 5e-4, kDuration = 1e-3;
  ContactScene scene = spheres_in_rows(kRows, 3);
  const double diameter = 2 * scene.hard.bodies[0].radius;
  for (std::size_t k = 0; k < kRows; ++k) {
    BodyState* row = &scene.hard.initial[3 * k];
    row[0].velocity.x() = 3 * kSpeed;
    row[1].velocity.x() = kSpeed;
    // When the second meets the third, about when an eighth of the skin is used up by the first
    // ones; they come when that is over.
    const double meets = (36.6 + 0.8 * static_cast<double>(k) / kRows) * kDuration;
    row[1].position.x() = -kSpeed * meets;
    row[2].position.x() = diameter;
    row[0].position.x() = row[1].position.x() - diameter - kSpeed * (2 * meets + 18 * kDuration);
  }
  double v[] = {3 * kSpeed, kSpeed, 0};
  for (const int first : {1, 0, 1}) {
    const double mean = (v[first] + v[first + 1]) / 2, part = (v[first] - v[first + 1]) / 2;
    v[first] = mean - kRebound * part;
    v[first + 1] = mean + kRebound * part;
  }
  PileSolver solver(scene, scene.hard.initial, {.step = 2.5e-5});
  const SolvedRun run = solver.run(until_time(53 * kDuration), nullptr);
  ASSERT_TRUE(run.reached) << run.reason;
  EXPECT_EQ(run.collisions, 3 * kRows);
  const std::vector<BodyState> ended = solver.states();
  for (std::size_t k = 0; k < kRows; ++k)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(ended[3 * k + i].velocity.x(), v[i], 4e-3 * kSpeed) << k << ' ' << i;
}

/// All at one velocity come no nearer to each other, but to the floor: the lowest ones touch it at
/// that speed, no other does in a time shorter than two layers need to meet.
TEST(ManyContacts, MeetTheFloorAsOne) {
  ContactScene scene = soft_bed({.count = 300, .gap = 1.1});
  scene.hard.gravity = 0;
  for (BodyState& state : scene.hard.initial) state.velocity = {0, 0, -1};
  const double radius = scene.hard.bodies[0].radius;
  const double gap = scene.hard.initial[0].position.z() - radius;
  PileSolver solver(scene, scene.hard.initial, {.steps_per_contact = 40, .prepare = false});
  const double half_a_contact = 20 * solver.step();
  ASSERT_TRUE(solver.run(until_time(gap + half_a_contact), nullptr).reached);
  for (const BodyState& state : solver.states()) EXPECT_GT(state.position.z(), 0.9 * radius);
  EXPECT_NEAR(solver.states()[0].velocity.z(), 0, 0.5);  // at rest in the middle of its contact
}

/// A ball that bounces lower than the lists reach, again and again: in time its weight is carried.
TEST(ManyContacts, BounceBetweenTwoSearches) {
  ContactScene scene = soft_bed({.count = 1, .walls = true});
  scene.soft_surfaces[0]->memory->sliding.static_friction = 0;
  scene.hard.initial[0].velocity.setZero();
  const Sphere& ball = scene.hard.bodies[0];
  scene.hard.initial[0].position = {0.02, 0.02, ball.radius + 2e-4};
  const double time = 0.2;
  const Ended end = run(scene, static_cast<std::size_t>(time / 1e-5), {.step = 1e-5});
  EXPECT_GT(end.states[0].position.z(), 0.99 * ball.radius);
  EXPECT_NEAR(end.impulse, ball.mass * (scene.hard.gravity * time + end.states[0].velocity.z()),
              1e-6 * end.impulse);
}

/// Several at once in the lanes of vectors are the same as one by one by the laws that leave out
/// nothing: in a container, sliding with less friction than held them, and on a periodic plane that
/// is hard; on every instruction set.
TEST(ManyContacts, InLanesHaveTheBitsOfOneByOne) {
  for (const bool walls : {true, false}) {
    ContactScene scene = soft_bed({.count = 500, .ratio = walls ? 1.0 : 3.0, .walls = walls});
    if (walls) scene.soft[0]->memory->sliding.kinetic_friction = 0.2;
    const auto end = [&](bool general) {
      return run(scene, 2000,
                 {.steps_per_contact = 20,
                  .collision_time = kOnPlane,
                  .steps_per_frame = 100,
                  .general = general,
                  .ordered_from = 300});
    };
    const Ended one_by_one = end(true);
    EXPECT_EQ(one_by_one.features.find("in lanes"), std::string::npos) << one_by_one.features;
    EXPECT_GT(one_by_one.collisions, 50u);
    for (const std::int64_t target : test::InstructionSet::all()) {
      const test::InstructionSet set(target);
      const Ended lanes = end(false);
      EXPECT_NE(lanes.features.find("in lanes"), std::string::npos) << lanes.features;
      EXPECT_EQ(lanes.collisions, one_by_one.collisions);
      EXPECT_EQ(lanes.impulse, one_by_one.impulse);
      EXPECT_EQ(lanes.balance.dissipated, one_by_one.balance.dissipated);
      EXPECT_EQ(lanes.balance.energy, one_by_one.balance.energy);
      for (std::size_t i = 0; i < lanes.states.size(); ++i) {
        ASSERT_EQ(lanes.states[i].position, one_by_one.states[i].position) << i;
        ASSERT_EQ(lanes.states[i].angular_velocity, one_by_one.states[i].angular_velocity) << i;
      }
    }
  }
}

/// Several steps that go through the slabs at once are those that come one by one, as somebody
/// looks at each: on a floor that shakes, and on a plane that swings and repeats.
TEST(ManyContacts, InWavesHaveTheBitsOfStepByStep) {
  for (const bool walls : {true, false}) {
    ContactScene scene = soft_bed({.count = 1800, .ratio = 2, .walls = walls});
    const SubstrateMotion shaking = SubstrateMotion::oscillation({1e-3, 0}, 60, 0.3);
    if (walls)
      scene.hard.surfaces[0].motion = SurfaceMotion::moving(shaking, kUp, Vector3::UnitX());
    else
      scene.hard.motion = shaking;
    const auto end = [&](std::size_t steps_per_frame, std::size_t threads) {
      return run(scene, 960,
                 {.steps_per_contact = 20,
                  .collision_time = kOnPlane,
                  .steps_per_frame = steps_per_frame,
                  .threads = threads,
                  .ordered_from = 1});
    };
    const Ended one_by_one = end(1, 1), waves = end(96, 1), shared = end(96, 2);
    EXPECT_GT(one_by_one.collisions, 100u);
    for (const Ended* each : {&waves, &shared}) {
      EXPECT_EQ(each->collisions, one_by_one.collisions);
      EXPECT_EQ(each->balance.dissipated, one_by_one.balance.dissipated);
      EXPECT_EQ(each->balance.work, one_by_one.balance.work);
      for (std::size_t i = 0; i < waves.states.size(); ++i) {
        ASSERT_EQ(each->states[i].position, one_by_one.states[i].position) << i;
        ASSERT_EQ(each->states[i].angular_velocity, one_by_one.states[i].angular_velocity) << i;
      }
    }
  }
}

/// The ledger's error is of the second order of the step.
TEST(ManyContacts, KeepTheirLedger) {
  const ContactScene scene = soft_bed({.count = 1200, .ratio = 3});
  double before = kNever;
  for (const double per_contact : {20.0, 40.0}) {
    PileSolver solver(
        scene, scene.hard.initial,
        {.steps_per_contact = per_contact, .collision_time = kOnPlane, .ordered_from = 1});
    const SolvedRun run = solver.run(until_time(0.03), nullptr);
    ASSERT_TRUE(run.reached) << run.reason;
    EXPECT_GT(run.balance->dissipated, 0.02 * run.balance->scale);
    const double error = std::abs(run.balance->error());
    EXPECT_LT(error, 2e-4);
    EXPECT_LT(error, 0.6 * before);
    before = error;
  }
}

/// Without gravity or a wall nothing takes momentum: in a periodic plane it stays to rounding.
TEST(ManyContacts, KeepTheirMomentum) {
  ContactScene scene = soft_bed({.count = 1200, .ratio = 3, .walls = false});
  scene.hard.gravity = 0;
  for (BodyState& state : scene.hard.initial) state.position.z() += 1;  // above the plane
  PileSolver solver(scene, scene.hard.initial,
                    {.steps_per_contact = 20, .collision_time = kOnPlane, .ordered_from = 1});
  const SolvedRun run = solver.run(until_time(0.03), nullptr);
  ASSERT_TRUE(run.reached) << run.reason;
  EXPECT_GT(run.collisions, 500u);
  const auto momentum = [&](const std::vector<BodyState>& states) {
    Vector3 sum = Vector3::Zero();
    for (std::size_t i = 0; i < states.size(); ++i)
      sum += scene.hard.bodies[i].mass * states[i].velocity;
    return sum;
  };
  const Vector3 first = momentum(scene.hard.initial), last = momentum(solver.states());
  EXPECT_LT((last - first).norm(), 1e-12 * first.norm());
}

/// Where the edges of the period lie is nothing that bodies see: but for what rounds otherwise.
TEST(ManyContacts, SeeNoEdgeOfAPeriodicPlane) {
  const ContactScene scene = soft_bed({.count = 900, .ratio = 2, .walls = false});
  ContactScene moved = scene;
  const Vector3 shift(0.37 * scene.hard.periodic.x(), -2.71 * scene.hard.periodic.y(), 0);
  for (BodyState& state : moved.hard.initial) state.position += shift;
  const PileSettings settings{
      .steps_per_contact = 20, .collision_time = kOnPlane, .steps_per_frame = 100};
  const Ended here = run(scene, 1000, settings), there = run(moved, 1000, settings);
  EXPECT_GT(here.collisions, 80u);
  EXPECT_EQ(here.collisions, there.collisions);
  for (std::size_t i = 0; i < here.states.size(); ++i)
    ASSERT_NEAR((here.states[i].position + shift - there.states[i].position).norm(), 0, 1e-10) << i;
}

}  // namespace
}  // namespace slipcheck
