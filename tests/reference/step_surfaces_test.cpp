#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "../scenes.h"
#include "reference/reference_solver.h"
#include "reference/steps/grain_scene.h"
#include "reference/steps/grain_solver.h"
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
TEST(StepSurfaces, ABallThatSlidesPartsAsCoulombSays) {
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
TEST(StepSurfaces, ABallMeetsTheWallAsItsMirrorImage) {
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
TEST(StepSurfaces, ARunUntilRollingWaitsForTheWall) {
  ContactScene scene = ball_at_wall({-0.05, 0, 0}, {1, 0, 0});
  scene.hard.substrate[0].static_friction = scene.hard.substrate[0].kinetic_friction = 0.2;
  scene.hard.initial[0].angular_velocity.y() = -0.05 / kRadius;
  StepSolver solver(scene, scene.hard.initial, {kCollisionTime / 50});
  const SolvedRun run = solver.run(kRolling, nullptr);
  EXPECT_TRUE(run.reached);
  EXPECT_GT(solver.states()[0].velocity.x(), 0);
  EXPECT_GT(run.end_time, 0.1 * kRadius / 0.05);
}

/// A fixed ball is met as a second one of no mobility: head-on the ball comes back as from a wall.
TEST(StepSurfaces, ABallIsMetAlongTheLineOfCentres) {
  ContactScene scene = ball_at_wall({-0.5, 0, 0}, {1, 0, 0});
  scene.soft_surfaces[0]->tangential = NoTangentialForce{};
  ContactScene ball = scene;
  const Vector3 centre = scene.hard.initial[0].position - Vector3(3.1 * kRadius, 0, 0);
  ball.hard.surfaces[0].shape = BallShape{centre, 2 * kRadius};
  const StepSettings settings{kCollisionTime / 50};
  StepSolver at_wall(scene, scene.hard.initial, settings),
      at_ball(ball, ball.hard.initial, settings);
  at_wall.run(until_time(1e-3), nullptr);
  at_ball.run(until_time(1e-3), nullptr);
  EXPECT_GT(at_ball.states()[0].velocity.x(), 0.3);
  EXPECT_NEAR(at_wall.states()[0].velocity.x(), at_ball.states()[0].velocity.x(), 1e-10);
}

TEST(StepSurfaces, OnesThatMoveOrAreHardAreRefused) {
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
  const auto expect = [&](const char* reason, auto change) {
    const std::string found = refusal(change);
    EXPECT_NE(found.find(reason), std::string::npos) << found;
  };
  expect("that move", [](ContactScene& s) {
    s.hard.surfaces[0].motion = SurfaceMotion::turning({0, 0, 0}, {1, 0, 0});
  });
  expect("soft contacts", [](ContactScene& s) { s.soft_surfaces[0].reset(); });
}

/// Balls in a tray of plates, or between planes.
ContactScene balls_in_tray(bool plates, double height) {
  Scene hard = steel_scene(60);
  constexpr double kLength = 40 * kRadius;
  for (std::size_t i = 0; i < 60; ++i)
    hard.initial[i] = rolling_at((0.05 + 0.1 * static_cast<double>(i % 10)) * kLength,
                                 (0.05 + 0.1 * static_cast<double>(i / 10)) * kLength,
                                 0.5 * std::sin(static_cast<double>(7 * i)),
                                 0.5 * std::cos(static_cast<double>(5 * i)));
  SoftContact contact =
      linear_contact(0.5 * hard.bodies[0].mass, 0.9, 50 * kCollisionTime, ContactEnd::zero_overlap);
  contact.tangential = ViscousForce{hard.bodies[0].mass / (5 * kCollisionTime), 0.3};
  ContactScene scene = with_contact(std::move(hard), contact);
  const Vector3 middle(0.5 * kLength, 0.5 * kLength, 0.5 * height);
  for (const Vector3& normal :
       {Vector3(1, 0, 0), Vector3(-1, 0, 0), Vector3(0, 1, 0), Vector3(0, -1, 0)}) {
    const Vector3 point = middle - 0.5 * kLength * normal;
    if (plates)  // of which every second one is seen from behind
      scene.hard.surfaces.push_back({RectangleShape{point, 0.5 * height * kUp,
                                                    0.5 * kLength * Vector3::UnitZ().cross(normal)},
                                     {}});
    else
      scene.hard.surfaces.push_back({PlaneShape{point, normal}, {}});
    scene.hard.on_surfaces.emplace_back();
    scene.soft_surfaces.emplace_back(contact);
  }
  return scene;
}

/// A tray is the space between planes, as long as nobody comes over its rim or around its ends.
TEST(StepSurfaces, AClosedTrayIsFourWalls) {
  const ContactScene tray = balls_in_tray(true, 0.5), planes = balls_in_tray(false, 0.5);
  EXPECT_EQ(grain_refusal(tray, tray.hard.initial), "");
  EXPECT_EQ(grain_refusal(planes, planes.hard.initial), "");
  const StepSettings settings{kCollisionTime}, general{.step = kCollisionTime, .general = true};
  StepSolver in_tray(tray, tray.hard.initial, settings);
  StepSolver between(planes, planes.hard.initial, settings);
  StepSolver by_plates(tray, tray.hard.initial, general);
  for (StepSolver* each : {&in_tray, &between, &by_plates})
    EXPECT_GT(each->run(until_time(0.1), nullptr).collisions, 50u);
  double moved = 0;
  for (std::size_t i = 0; i < 60; ++i) {
    const BodyState a = in_tray.states()[i], b = between.states()[i], c = by_plates.states()[i];
    EXPECT_EQ(a.position, b.position) << i;
    EXPECT_NEAR((a.position - c.position).norm(), 0, 1e-6 * kRadius) << i;  // collisions multiply
    moved = std::max(moved, (a.position - tray.hard.initial[i].position).norm());
  }
  EXPECT_GT(moved, 5 * kRadius);
}

TEST(StepSurfaces, WhatIsNoWallIsNotGrainSolvers) {
  const auto expect = [](const char* reason, double height, auto change) {
    ContactScene scene = balls_in_tray(true, height);
    change(scene);
    const std::string found = grain_refusal(scene, scene.hard.initial);
    EXPECT_NE(found.find(reason), std::string::npos) << found;
  };
  expect("come over", 0.04, [](ContactScene&) {});
  expect("come around", 0.5, [](ContactScene& s) {
    std::get<RectangleShape>(s.hard.surfaces[2].shape).half_width *= 0.9;
  });
  expect("come around", 0.5, [](ContactScene& s) {
    s.hard.surfaces.pop_back();
    s.soft_surfaces.pop_back();
  });
  expect("no walls", 0.5, [](ContactScene& s) {
    s.hard.surfaces[1].shape = BallShape{{0, 0, 0}, 1};
  });
  expect("no walls", 0.5, [](ContactScene& s) {  // above the plane
    std::get<RectangleShape>(s.hard.surfaces[1].shape).centre.z() += 0.1;
  });
  expect("no walls", 0.5, [](ContactScene& s) {  // between bodies
    std::get<RectangleShape>(s.hard.surfaces[1].shape).centre.x() = 21 * kRadius;
  });
  expect("no walls", 0.5, [](ContactScene& s) {  // askew
    s.hard.surfaces[1].shape = PlaneShape{{0, 0, 0}, {0.6, 0, 0.8}};
  });
  expect("that move", 0.5, [](ContactScene& s) {
    s.hard.surfaces[1].motion = SurfaceMotion::turning({0, 0, 0}, {0, 0, 1});
  });
}

/// What no bound at the start excludes: here none is asked for.
TEST(StepSurfaces, ABodyThatComesOverAWallEndsTheRun) {
  ContactScene scene = balls_in_tray(true, 0.05);
  scene.hard.initial[7].velocity.z() = 1.5;  // v²/2g = 115 mm
  ASSERT_NE(grain_refusal(scene, scene.hard.initial), "");
  GrainSolver solver(scene, scene.hard.initial, kCollisionTime);
  EXPECT_NO_THROW(solver.advance(800));  // 20 ms: 31 mm at most
  EXPECT_THROW(solver.advance(4000), StepTooLong);
}

}  // namespace
}  // namespace slipcheck
