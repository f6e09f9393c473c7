#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "physics/contact/linear_contact.h"
#include "reference/steps/step_solver.h"
#include "soft_scenes.h"

namespace slipcheck {
namespace {

/// Steel balls of radii 1:3 over a tilted, shaken plane, some of them in flight.
Scene unlike_balls(std::size_t n, bool moves) {
  std::mt19937 dice(11);
  std::uniform_real_distribution<double> unit(0, 1);
  Scene scene = test::steel_scene(n);
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n))));
  for (std::size_t i = 0; i < n; ++i) {
    Sphere& sphere = scene.bodies[i];
    const double part = (1 + 2 * unit(dice)) / 3;
    sphere.radius *= part;
    sphere.mass *= part * part * part;
    BodyState& state = scene.initial[i];
    state.position = {0.0042 * static_cast<double>(i % side),
                      0.0042 * static_cast<double>(i / side),
                      sphere.radius + (i % 3 == 0 ? 0.001 * unit(dice) : 0)};
    state.velocity = {0.4 * (2 * unit(dice) - 1), 0.4 * (2 * unit(dice) - 1), 0};
    state.angular_velocity = 30 * Vector3(unit(dice), unit(dice), unit(dice));
  }
  // What depends on the speed is not GrainSolver's.
  scene.substrate[0].rolling = RollingFriction({{0, 0.01}, {1, 0.012}});
  if (moves) {
    scene.downhill = {0.3, -0.1};
    scene.gravity = 9.7;
  }
  return scene;
}

/// What is far apart adds nothing: neighbours alone, in the order of all pairs, give the same bits.
TEST(StepNeighbours, GiveTheBitsOfAllPairs) {
  for (const bool moves : {false, true})
    for (const TangentialForce& tangential :
         {TangentialForce(NoTangentialForce{}), TangentialForce(ViscousForce{0.05, 0.3}),
          TangentialForce(AsperityForce{0.3, 1e-6, AsperityForce::Form::passive})}) {
      const ContactScene scene =
          test::soft(unlike_balls(60, moves), 5e-5, ContactEnd::zero_force, tangential);
      StepSolver all(scene, scene.hard.initial, {.step = 1e-6, .most_in_all_pairs = 1000});
      StepSolver near(scene, scene.hard.initial, {.step = 1e-6});
      EXPECT_NE(all.features(), near.features());
      std::size_t collisions = 0;
      for (int k = 1; k <= 10; ++k) {
        const SolvedRun first = all.run(until_time(2e-3 * k), nullptr);
        const SolvedRun second = near.run(until_time(2e-3 * k), nullptr);
        ASSERT_TRUE(first.reached && second.reached) << first.reason << second.reason;
        ASSERT_EQ(first.collisions, second.collisions);
        collisions = first.collisions;
        const auto a = all.states(), b = near.states();
        for (std::size_t i = 0; i < a.size(); ++i) {
          ASSERT_EQ(a[i].position, b[i].position) << i << ' ' << k;
          ASSERT_EQ(a[i].velocity, b[i].velocity) << i << ' ' << k;
          ASSERT_EQ(a[i].angular_velocity, b[i].angular_velocity) << i << ' ' << k;
        }
      }
      EXPECT_GT(collisions, 30u);
    }
}

/// 1000 and more are stored in another order: of their sums only the order differs.
TEST(StepNeighbours, KeepWhatEachOfManyIs) {
  ContactScene scene =
      test::soft(unlike_balls(1050, true), 5e-5, ContactEnd::zero_force, ViscousForce{0.05, 0.3});
  scene.hard.substrate.push_back(scene.hard.substrate[0]);
  scene.hard.substrate[1].static_friction = scene.hard.substrate[1].kinetic_friction = 0.05;
  scene.soft.assign(4, scene.soft[0]);
  scene.soft[1]->tangential = scene.soft[2]->tangential = ViscousForce{0.02, 0.1};
  scene.soft[3]->tangential = ViscousForce{0.1, 0.5};
  for (std::size_t i = 0; i < scene.hard.material.size(); i += 3) scene.hard.material[i] = 1;
  const auto end = [&](std::size_t most_in_all_pairs) {
    StepSolver solver(scene, scene.hard.initial,
                      {.step = 2e-6, .most_in_all_pairs = most_in_all_pairs});
    const SolvedRun run = solver.run(until_time(2e-3), nullptr);
    EXPECT_TRUE(run.reached) << run.reason;
    return std::pair(solver.states(), run.collisions);
  };
  const auto [all, collisions] = end(1050);
  const auto [near, as_many] = end(24);
  EXPECT_GT(collisions, 40u);
  EXPECT_EQ(collisions, as_many);
  for (std::size_t i = 0; i < all.size(); ++i) {
    // Round-off, which a collision or two make some hundred times as large.
    EXPECT_LT((all[i].position - near[i].position).norm(), 1e-11 * all[i].position.norm()) << i;
    EXPECT_LT((all[i].velocity - near[i].velocity).norm(), 1e-11) << i;
  }
}

/// Unlike radii on a periodic plane: a scene moved across its edges does the same.
TEST(StepNeighbours, SeeNoEdgeOfAPeriodicPlane) {
  Scene hard = unlike_balls(64, true);
  hard.periodic = {8 * 0.0042, 8 * 0.0042};
  ContactScene here = test::soft(hard, 5e-5, ContactEnd::zero_force, ViscousForce{0.05, 0.3});
  ContactScene there = here;
  const Vector3 shift(0.37 * hard.periodic.x(), -1.71 * hard.periodic.y(), 0);
  for (BodyState& state : there.hard.initial) state.position += shift;
  StepSolver first(here, here.hard.initial, {.step = 1e-6});
  StepSolver second(there, there.hard.initial, {.step = 1e-6});
  const SolvedRun a = first.run(until_time(5e-3), nullptr);
  const SolvedRun b = second.run(until_time(5e-3), nullptr);
  ASSERT_TRUE(a.reached && b.reached) << a.reason << b.reason;
  EXPECT_GT(a.collisions, 15u);
  EXPECT_EQ(a.collisions, b.collisions);
  const auto x = first.states(), y = second.states();
  bool crosses = false;
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR((x[i].position + shift - y[i].position).norm(), 0, 1e-11) << i;
    crosses = crosses || x[i].position.x() < 0;
  }
  EXPECT_TRUE(crosses);
}

TEST(StepNeighbours, SayThatStepsAreTooLong) {
  const ContactScene scene = test::soft(unlike_balls(60, false));
  StepSolver solver(scene, scene.hard.initial, {.step = 0.1});
  const SolvedRun run = solver.run(until_time(1), nullptr);
  EXPECT_TRUE(run.failed);
  EXPECT_EQ(run.reason, "a body moves by more than a radius in a step, at 0 s");
}

}  // namespace
}  // namespace slipcheck
