#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "../scenes.h"
#include "reference/reference_solver.h"
#include "reference/steps/grain_scene.h"
#include "reference/steps/step_solver.h"
#include "step_scenes.h"

namespace slipcheck {
namespace {

using namespace test;

constexpr double kRub = 0.2, kRadius = 0.002;

/// A steel ball that comes to a wall askew at `velocity`, on a plane without friction.
ContactScene ball_at_wall(const Vector3& velocity, const Vector3& normal,
                          double restitution = 0.8) {
  Scene hard = steel_scene(1);
  hard.confined = true;
  hard.substrate[0].static_friction = hard.substrate[0].kinetic_friction = 0;
  hard.initial[0].position = {0.3, -0.2, kRadius};
  hard.initial[0].velocity = velocity;
  const double m = hard.bodies[0].mass;
  ContactScene scene = alone(std::move(hard));
  const Vector3 point = scene.hard.initial[0].position - 1.1 * kRadius * normal;
  scene.hard.surfaces.push_back({PlaneShape{point, normal}, {}});
  scene.hard.on_surfaces.emplace_back();
  scene.soft_surfaces.emplace_back(
      linear_contact(m, restitution, kCollisionTime, ContactEnd::zero_overlap));
  // Stiff enough that Coulomb's cap is all that acts.
  scene.soft_surfaces[0]->tangential = ViscousForce{1e6 * m, kRub};
  return scene;
}

/// Closed form: an elastic ball that slips all the while loses 2 μ |v_n| along the wall and turns
/// by 1/(q R) of that, q = 2/5 (L (11) in the limit of sliding).
TEST(StepWalls, ABallThatSlidesPartsAsCoulombSays) {
  const Vector3 normal(0.6, 0.8, 0), along(-0.8, 0.6, 0);
  const Vector3 before = -0.5 * normal + 2 * along;
  const ContactScene scene = ball_at_wall(before, normal, 1);
  const double lost = kRub * 2 * 0.5;
  const auto error = [&](int per_collision) {
    StepSolver solver(scene, scene.hard.initial, {kCollisionTime / per_collision});
    EXPECT_TRUE(solver.run(until_time(1e-3), nullptr).reached);
    const BodyState after = solver.states()[0];
    const Vector3 expected = 0.5 * normal + (2 - lost) * along;
    // F along −along at the point −R normal: the torque (−R n)×(−F) is R F n×along = R F k̂.
    const double spin = lost / (0.4 * kRadius);
    return (after.velocity - expected).norm() +
           kRadius * (after.angular_velocity - Vector3(0, 0, spin)).norm();
  };
  EXPECT_LT(error(100), 1e-3);
  EXPECT_GT(order(error, 50), 1.7);  // second order, as collisions of two
}

/// A wall has no mass: what meets its mirror image in the middle parts alike.
TEST(StepWalls, ABallMeetsTheWallAsItsMirrorImage) {
  ContactScene scene = ball_at_wall({-0.5, 0, 0}, {1, 0, 0});
  scene.soft_surfaces[0]->tangential = NoTangentialForce{};
  const auto& law = std::get<LinearForce>(scene.soft_surfaces[0]->normal);
  ContactScene two =
      with_contact(steel_scene(2), {LinearForce{0.5 * law.stiffness, 0.5 * law.damping},
                                    ContactEnd::zero_overlap, NoTangentialForce{}});
  two.hard.confined = true;
  two.hard.substrate = scene.hard.substrate;
  two.hard.initial[0] = two.hard.initial[1] = scene.hard.initial[0];
  two.hard.initial[1].position.x() -= 2.2 * kRadius;
  two.hard.initial[1].velocity.x() *= -1;
  const StepSettings settings{kCollisionTime / 50};
  StepSolver at_wall(scene, scene.hard.initial, settings), pair(two, two.hard.initial, settings);
  for (const double t : {3e-4, 4.1e-4, 4.2e-4, 1e-3}) {
    at_wall.run(until_time(t), nullptr);
    pair.run(until_time(t), nullptr);
    // Places round by 5e-17 m, which the spring takes for a force: (π/t_col)² of that in t_col.
    EXPECT_NEAR(at_wall.states()[0].velocity.x(), pair.states()[0].velocity.x(), 1e-10) << t;
    EXPECT_NEAR(at_wall.states()[0].position.x(), pair.states()[0].position.x(), 1e-13) << t;
  }
  EXPECT_GT(at_wall.states()[0].velocity.x(), 0);
}

/// Rolling toward a wall is not the end of a run until rolling.
TEST(StepWalls, ARunUntilRollingWaitsForTheWall) {
  ContactScene scene = ball_at_wall({-0.05, 0, 0}, {1, 0, 0});
  scene.hard.substrate[0].static_friction = scene.hard.substrate[0].kinetic_friction = 0.2;
  scene.hard.initial[0].angular_velocity.y() = -0.05 / kRadius;
  StepSolver solver(scene, scene.hard.initial, {kCollisionTime / 50});
  const SolvedRun run = solver.run(kRolling, nullptr);
  EXPECT_TRUE(run.reached);
  EXPECT_GT(solver.states()[0].velocity.x(), 0);
  EXPECT_GT(run.end_time, 0.1 * kRadius / 0.05);
}

TEST(StepWalls, OtherSurfacesAreRefused) {
  const auto refusal = [](auto change) {
    ContactScene scene = ball_at_wall({-0.5, 0, 0}, {1, 0, 0});
    change(scene);
    try {
      StepSolver(scene, scene.hard.initial, {1e-6});
    } catch (const Unsupported& unsupported) {
      return std::string(unsupported.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal([](ContactScene&) {}), "");
  EXPECT_NE(refusal([](ContactScene& s) {
              s.hard.surfaces[0].shape = BallShape{{0, 0, 0}, 0.1};
            }).find("but walls"),
            std::string::npos);
  EXPECT_NE(refusal([](ContactScene& s) {
              s.hard.surfaces[0].shape = PlaneShape{{0, 0, 0}, {0.6, 0, 0.8}};
            }).find("upright"),
            std::string::npos);
  EXPECT_NE(refusal([](ContactScene& s) { s.soft_surfaces[0].reset(); }).find("soft contacts"),
            std::string::npos);
}

}  // namespace
}  // namespace slipcheck
