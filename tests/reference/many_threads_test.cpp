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

TEST(ManyThreads, GiveTheBitsOfOneToGrainsInIslands) {
  for (const bool on_plane : {true, false}) {
    const ContactScene scene = bench::grain_gas(3000, 0.6, on_plane);
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

/// Below 1000 bodies are stored in the scene's order, in which a loop over all pairs adds forces.
TEST(ManyThreads, GiveTheBitsOfAllPairs) {
  ContactScene scene = falling_on_a_swing(950);
  scene.hard.periodic.setZero();
  EXPECT_EQ(hash_of_steps(scene, 2e-3, {.step = 1e-5, .threads = 3}),
            hash_of_steps(scene, 2e-3, {.step = 1e-5, .most_in_all_pairs = 950}));
}

/// From 1000 on they are stored in another order: of their sums only the order differs.
TEST(ManyThreads, KeepWhatEachOfManyIs) {
  ContactScene scene = falling_on_a_swing(1050);
  scene.hard.periodic.setZero();
  scene.hard.substrate.push_back(scene.hard.substrate[0]);
  scene.hard.substrate[1].static_friction = scene.hard.substrate[1].kinetic_friction = 0.1;
  scene.soft.assign(4, scene.soft[0]);
  scene.soft[1]->tangential = scene.soft[2]->tangential = ViscousForce{0.5, 0.1};
  scene.soft[3]->tangential = ViscousForce{2, 0.5};
  for (std::size_t i = 0; i < scene.hard.material.size(); i += 3) scene.hard.material[i] = 1;
  const auto end = [&](std::size_t most_in_all_pairs) {
    StepSolver solver(scene, scene.hard.initial,
                      {.step = 1e-5, .most_in_all_pairs = most_in_all_pairs, .threads = 2});
    const SolvedRun run = solver.run(until_time(2e-3), nullptr);
    EXPECT_TRUE(run.reached) << run.reason;
    return std::pair(solver.states(), run.collisions);
  };
  const auto [all, collisions] = end(1050);
  const auto [near, as_many] = end(24);
  EXPECT_GT(collisions, all.size() / 25);
  EXPECT_EQ(collisions, as_many);
  for (std::size_t i = 0; i < all.size(); ++i) {
    // Round-off, which a collision or two make some hundred times as large.
    EXPECT_LT((all[i].position - near[i].position).norm(), 1e-11 * all[i].position.norm()) << i;
    EXPECT_LT((all[i].velocity - near[i].velocity).norm(), 1e-11 * (1 + all[i].velocity.norm()))
        << i;
  }
}

}  // namespace
}  // namespace slipcheck
