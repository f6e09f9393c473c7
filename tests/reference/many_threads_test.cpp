#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "../../bench/grain_gas.h"
#include "../../bench/soft_bed.h"
#include "reference/piles/pile_solver.h"
#include "reference/steps/grain_solver.h"
#include "reference/steps/step_solver.h"
#include "scenario/load.h"

namespace slipcheck {
namespace {

std::uint64_t hash_of(const std::vector<BodyState>& states) {
  std::uint64_t hash = 14695981039346656037u;
  for (const BodyState& state : states)
    for (const Vector3* v : {&state.position, &state.velocity, &state.angular_velocity})
      for (int k = 0; k < 3; ++k)
        hash = (hash ^ std::bit_cast<std::uint64_t>((*v)[k])) * 1099511628211u;
  return hash;
}

// A sanitizer that looks at every access takes minutes for each.
#ifdef SLIPCHECK_SANITIZE
constexpr std::size_t kThreads[] = {3};
constexpr std::size_t kSpheres = 1200;
#else
constexpr std::size_t kThreads[] = {2, 3, 8};
constexpr std::size_t kSpheres = 2500;
#endif

/// Steps of one scene on several threads give the bits of one: among the first collisions of many
/// spheres with memory, at walls or on a plane with its own hard contact.
TEST(ManyThreads, GiveTheBitsOfOneToContactsThatRemember) {
  for (const bool walls : {true, false}) {
    const ContactScene scene = bench::soft_bed({.count = kSpheres, .ratio = 3, .walls = walls});
    const auto hash = [&](std::size_t threads) {
      PileSolver solver(scene, scene.hard.initial,
                        {.steps_per_contact = 20,
                         .collision_time = 2e-4,
                         .threads = threads,
                         .ordered_from = 1000});
      const SolvedRun run = solver.run(until_time(800 * solver.step()), nullptr);
      EXPECT_TRUE(run.reached) << run.reason;
      EXPECT_GT(run.collisions, kSpheres / 25);  // none: nothing was shared
      return std::pair(hash_of(solver.states()),
                       std::bit_cast<std::uint64_t>(run.balance->dissipated));
    };
    const auto alone = hash(1);
    for (const std::size_t threads : kThreads) EXPECT_EQ(hash(threads), alone) << threads;
  }
}

void expect_bits_of_one(const ContactScene& scene) {
  const auto hash = [&](std::size_t threads) {
    GrainSolver solver(scene, scene.hard.initial, bench::kStep, threads);
    solver.advance(1500);
    EXPECT_GT(solver.collisions(), 150u);
    Frame frame;
    solver.show(frame);
    return hash_of(frame.bodies);
  };
  const std::uint64_t alone = hash(1);
  for (const std::size_t threads : kThreads) EXPECT_EQ(hash(threads), alone) << threads;
}

TEST(ManyThreads, GiveTheBitsOfOneToGrainsInIslands) {
  for (const bool on_plane : {true, false})
    expect_bits_of_one(bench::grain_gas(3000, 0.6, on_plane));
}

TEST(ManyThreads, GiveTheBitsOfOneToGrainsThatAreCarriedAlong) {
  ContactScene scene = bench::grain_gas(3000, 0.6, true);
  scene.hard.downhill = {0.5, 1};
  scene.hard.motion = SubstrateMotion::oscillation({0.05, 0.1}, 3, 0);
  expect_bits_of_one(scene);
}

TEST(ManyThreads, GiveTheBitsOfOneToGrainsOfUnlikeRadii) {
  expect_bits_of_one(bench::grain_gas(3000, 0.4, true, 1, 3));
}

TEST(ManyThreads, GiveTheBitsOfOneToGrainsThatLiftEachOther) {
  ContactScene scene = bench::grain_gas(3000, 0.6, true);
  scene.hard.confined = false;
  expect_bits_of_one(scene);
}

TEST(ManyThreads, GiveTheBitsOfOneToGrainsThatRollBetweenWalls) {
  ContactScene scene = bench::grain_gas(3000, 0.4, true);
  scene.hard.substrate[0].rolling = RollingFriction(0.001);
  const Vector2 length = scene.hard.periodic;
  scene.hard.periodic.setZero();
  for (const auto& [at, normal] : {std::pair{Vector2(-0.5, 0), Vector2(1, 0)},
                                   {Vector2(length.x() + 0.5, 0), Vector2(-1, 0)}}) {
    scene.hard.surfaces.push_back(
        {PlaneShape{{at.x(), at.y(), 0}, {normal.x(), normal.y(), 0}}, {}});
    scene.hard.on_surfaces.emplace_back();
    scene.soft_surfaces.emplace_back(scene.soft[0]);
  }
  expect_bits_of_one(scene);
}

/// Spheres of unlike radii that rub, fall on a plane which swings, and bounce from it and each
/// other: contacts begin and end under others that go on, and some press a third one down.
ContactScene falling_on_a_swing(std::size_t count) {
  ContactScene scene = bench::soft_bed({.count = count, .ratio = 3, .walls = false});
  scene.soft[0]->memory.reset();
  scene.soft[0]->tangential = ViscousForce{1, 0.3};
  scene.hard.motion = SubstrateMotion::oscillation({0.01, 0}, 50, 0);
  SubstrateContact& plane = scene.hard.substrate[0];
  plane.static_friction = plane.kinetic_friction = 0.3;
  plane.restitution = 0.5;
  return scene;
}

auto hash_of_steps(const ContactScene& scene, double time, const StepSettings& settings) {
  StepSolver solver(scene, scene.hard.initial, settings);
  const SolvedRun run = solver.run(until_time(time), nullptr);
  EXPECT_TRUE(run.reached) << run.reason;
  EXPECT_GT(run.collisions, scene.hard.bodies.size() / 25);
  return std::pair(hash_of(solver.states()), run.collisions);
}

TEST(ManyThreads, GiveTheBitsOfOneToStepsInSpace) {
  const ContactScene scene = falling_on_a_swing(kSpheres);
  const auto alone = hash_of_steps(scene, 3e-3, {.step = 1e-5});
  for (const std::size_t threads : kThreads)
    EXPECT_EQ(hash_of_steps(scene, 3e-3, {.step = 1e-5, .threads = threads}), alone) << threads;
}

/// Radii drawn from a range, so that each two have a contact of their own.
TEST(ManyThreads, GiveTheBitsOfOneToContactsOfTheirOwn) {
  const ContactScene scene = make_contact_scene(
      parse_scenario("slipcheck: 1\nname: drawn\ntitle: t\ngravity: 9.81\n"
                     "materials: {steel: {density: 7850}}\n"
                     "contacts:\n"
                     "  - between: [steel, steel]\n"
                     "    normal: {model: linear, restitution: 0.9, collision_time: 1e-3}\n"
                     "    tangential: {model: viscous, damping_ratio: 0.5, friction: 0.3}\n"
                     "  - {between: [steel, substrate], friction: 0.1}\n"
                     "substrate: {motion: {kind: oscillate, amplitude: [5 mm, 0], frequency: 5}}\n"
                     "fill: {prefix: g, material: steel, seed: 1, speed: 1, count: 600,\n"
                     "       radius: {uniform: [1 mm, 2 mm]}, area: [0, 0, 114 mm, 114 mm]}\n"
                     "run: {until: 1}\ncompare: {engines: []}\n",
                     "s.yaml"));
  ASSERT_TRUE(scene.own);
  const auto hash = [&](std::size_t threads) {
    StepSolver solver(scene, scene.hard.initial,
                      {.step = 2e-5, .threads = threads, .shared_from = 600});
    const SolvedRun run = solver.run(until_time(6e-3), nullptr);
    EXPECT_TRUE(run.reached) << run.reason;
    EXPECT_GT(run.collisions, 200u);
    return hash_of(solver.states());
  };
  const auto alone = hash(1);
  for (const std::size_t threads : kThreads) EXPECT_EQ(hash(threads), alone) << threads;
}

/// Where telling each other of it takes longer than a step, one thread has them all.
TEST(ManyThreads, ShareNoFewBodies) {
  const auto sharing = [](std::size_t count, bool general) {
    const ContactScene scene = bench::grain_gas(count, 0.2, false);
    return sharing_threads(scene, scene.hard.initial, {.general = general, .threads = 3});
  };
  EXPECT_EQ(sharing(3999, false), 1u);
  EXPECT_EQ(sharing(4000, false), 3u);
  EXPECT_EQ(sharing(999, true), 1u);
  EXPECT_EQ(sharing(1000, true), 3u);
}

}  // namespace
}  // namespace slipcheck
