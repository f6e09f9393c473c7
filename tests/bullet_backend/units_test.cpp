// The units in which a Bullet world counts, as pure functions.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bullet_backend/world_units.h"
#include "bullet_run.h"

namespace slipcheck::bullet {
namespace {

Scene two_sizes() {
  SubstrateContact ground = ground_with_friction(0.2);
  ground.rolling = RollingFriction({{0, 0.01}, {0.5, 0.03}});
  ground.drilling_length = 1e-4;
  ground.coupled_radius = 2e-4;
  Scene scene = scene_of(steel_ball(0.004),
                         {rolling_along_x(0.004, 0, 0.3), rolling_along_x(0.002, 0.1, 0)}, ground);
  scene.bodies[1] = steel_ball(0.002);
  return scene;
}

BulletSettings settings_with(double radius, double mass, double gravity) {
  BulletSettings settings;
  settings.scale_radius_to = radius;
  settings.scale_mass_to = mass;
  settings.scale_gravity_to = gravity;
  return settings;
}

TEST(BulletUnits, AreSiUnlessAskedOtherwise) {
  const WorldUnits units = world_units(two_sizes(), {});
  EXPECT_EQ(units.length, 1);
  EXPECT_EQ(units.time, 1);
  EXPECT_EQ(units.mass, 1);
  EXPECT_EQ(units.turn, Eigen::Matrix3d::Identity());
}

TEST(BulletUnits, TheSmallestRadiusTheLargestMassAndGravityBecomeWhatIsAskedFor) {
  const Scene scene = two_sizes();
  const WorldUnits units = world_units(scene, settings_with(1, 2, 10));
  const Scene scaled = in_world_units(scene, units);
  EXPECT_DOUBLE_EQ(scaled.bodies[1].radius, 1);
  EXPECT_DOUBLE_EQ(scaled.bodies[0].radius, 2);
  EXPECT_DOUBLE_EQ(scaled.bodies[0].mass, 2);
  EXPECT_DOUBLE_EQ(scaled.bodies[1].mass, 0.25);  // an eighth of the other's
  EXPECT_DOUBLE_EQ(scaled.gravity, 10);
  EXPECT_EQ(scaled.bodies[0].shape_factor, scene.bodies[0].shape_factor);
}

TEST(BulletUnits, GravityAloneIsScaledByTheTime) {
  // g' = g/time², so that 9.81 m/s² become 1 m per square of 1/√9.81 s.
  const WorldUnits units = world_units(two_sizes(), settings_with(0, 0, 1));
  EXPECT_EQ(units.length, 1);
  EXPECT_DOUBLE_EQ(units.time, std::sqrt(9.81));
  Scene weightless = two_sizes();
  weightless.gravity = 0;
  EXPECT_EQ(world_units(weightless, settings_with(0, 0, 1)).time, 1);
}

TEST(BulletUnits, ATiltedPlanesWholeGravityIsScaled) {
  Scene scene = two_sizes();
  scene.gravity = 4;
  scene.downhill = {3, 0};
  const Scene scaled = in_world_units(scene, world_units(scene, settings_with(0, 0, 10)));
  EXPECT_DOUBLE_EQ(scaled.gravity, 8);
  EXPECT_DOUBLE_EQ(scaled.downhill.x(), 6);
}

TEST(BulletUnits, AStateComesBack) {
  Scene scene = two_sizes();
  scene.downhill = {1, -2};
  BulletSettings settings = settings_with(0.7, 3, 5);
  settings.tilt = Tilt::plane;
  const WorldUnits units = world_units(scene, settings);
  const BodyState state = {Vector3(1, 2, 3), Vector3(-4, 5, 6), Vector3(7, -8, 9)};
  const BodyState back = units.from_world(units.to_world(state));
  EXPECT_LT((back.position - state.position).norm(), 1e-14);
  EXPECT_LT((back.velocity - state.velocity).norm(), 1e-14);
  EXPECT_LT((back.angular_velocity - state.angular_velocity).norm(), 1e-14);
}

TEST(BulletUnits, RollingStaysRollingAndNumbersWithoutUnitsStay) {
  // R ω/v, v²/(g R) and v T/R are the same in all units.
  const Scene scene = two_sizes();
  const WorldUnits units = world_units(scene, settings_with(3, 5, 7));
  const Scene scaled = in_world_units(scene, units);
  const BodyState& state = scaled.initial[0];
  const double radius = scaled.bodies[0].radius;
  EXPECT_NEAR(slip_velocity(state, radius).norm(), 0, 1e-14 * state.velocity.norm());
  const auto froude = [](const Scene& of) {
    return of.initial[0].velocity.squaredNorm() / (of.gravity * of.bodies[0].radius);
  };
  EXPECT_NEAR(froude(scaled) / froude(scene), 1, 1e-14);
  const double ways = 0.3 * 1.0 / 0.004;  // of a second, in radii
  EXPECT_NEAR(state.velocity.norm() * units.time / radius, ways, 1e-12 * ways);
  EXPECT_NEAR(units.impulse(), units.mass * units.speed(), 1e-15 * units.impulse());
  EXPECT_EQ(scaled.substrate[0].kinetic_friction, 0.2);
}

TEST(BulletUnits, LengthsOfContactsAreLengths) {
  const Scene scene = two_sizes();
  const Scene scaled = in_world_units(scene, world_units(scene, settings_with(1, 0, 0)));
  EXPECT_DOUBLE_EQ(scaled.substrate[0].drilling_length, 0.05);  // 1e-4 m in units of 2 mm
  EXPECT_DOUBLE_EQ(scaled.substrate[0].coupled_radius, 0.1);
  EXPECT_EQ(in_world_units(scene, world_units(scene, settings_with(0, 8, 0)))
                .substrate[0]
                .drilling_length,
            1e-4);
}

TEST(BulletUnits, LawsOverTheSpeedGiveTheSameAtTheSameSpeed) {
  Scene scene = two_sizes();
  const RestitutionLaw power = PowerLawRestitution{0.32, 0.234, 0.01};
  const RestitutionLaw table = TabulatedRestitution{0, 1, {2, 1.8}, {-0.2, -0.2}};
  const WorldUnits units = world_units(scene, settings_with(1, 2, 10));
  for (const RestitutionLaw& law : {power, table}) {
    scene.pairs[0].restitution = law;
    const Scene scaled = in_world_units(scene, units);
    for (const double speed : {1e-3, 0.02, 1.5, 30.0})
      EXPECT_NEAR(restitution_at(scaled.pairs[0].restitution, speed * units.speed()),
                  restitution_at(law, speed), 1e-13)
          << speed;
  }
  const Scene scaled = in_world_units(scene, units);
  for (const double speed : {0.0, 0.1, 0.5, 2.0})
    EXPECT_NEAR(scaled.substrate[0].rolling(speed * units.speed()),
                scene.substrate[0].rolling(speed), 1e-15);
}

TEST(BulletUnits, WhatMovesMovesOnTheSamePath) {
  Scene scene = two_sizes();
  const WorldUnits units = world_units(scene, settings_with(1, 2, 10));
  for (const SubstrateMotion& motion :
       {SubstrateMotion::constant({0.1, -0.2}),
        SubstrateMotion::oscillation({0.001, 0.002}, 3, 0.7),
        SubstrateMotion::table({{0.1, {0, 0}}, {0.3, {0.01, 0.02}}, {0.6, {0.02, 0}}})}) {
    scene.motion = motion;
    const SubstrateMotion scaled = in_world_units(scene, units).motion;
    for (const double t : {0.0, 0.15, 0.4, 1.0}) {
      const double there = t * units.time;
      EXPECT_LT((scaled.position(there) / units.length - motion.position(t)).norm(), 1e-14) << t;
      EXPECT_LT((scaled.velocity(there) / units.speed() - motion.velocity(t)).norm(), 1e-13) << t;
    }
  }
  scene.motion = {};
  EXPECT_TRUE(in_world_units(scene, units).motion.is_still());
}

TEST(BulletUnits, ABoxAndItsFloorAreScaled) {
  Scene scene = two_sizes();
  Box box;
  box.width = 0.2;
  box.floor = {0.002, 25};
  box.lid = 0.3;
  box.on_floor = {{PowerLawRestitution{0.5, 0.2, 0.1}, 0.2, 0}};
  box.on_wall = box.on_lid = box.on_floor;
  scene.box = box;
  const WorldUnits units = world_units(scene, settings_with(1, 0, 10));
  const Scene made = in_world_units(scene, units);
  const Box& scaled = *made.box;
  EXPECT_DOUBLE_EQ(scaled.width, 100);  // of 2 mm
  EXPECT_DOUBLE_EQ(*scaled.lid, 150);
  for (const double t : {0.003, 0.011}) {
    EXPECT_NEAR(scaled.floor.height(t * units.time), box.floor.height(t) * units.length, 1e-12);
    EXPECT_NEAR(scaled.floor.velocity(t * units.time), box.floor.velocity(t) * units.speed(),
                1e-12 * units.speed());
  }
  for (const auto* contacts : {&scaled.on_floor, &scaled.on_wall, &scaled.on_lid})
    EXPECT_NEAR(restitution_at((*contacts)[0].restitution, 0.4 * units.speed()),
                0.5 * std::pow(4, -0.2), 1e-14);
}

TEST(BulletUnits, ATiltedPlaneTurnsSoThatGravityIsVertical) {
  Scene scene = two_sizes();
  const double theta = 0.3;
  scene.gravity = kGravity * std::cos(theta);
  scene.downhill = {0, -kGravity * std::sin(theta)};
  BulletSettings settings;
  EXPECT_EQ(world_units(scene, settings).turn, Eigen::Matrix3d::Identity());
  settings.tilt = Tilt::plane;
  const Eigen::Matrix3d turn = world_units(scene, settings).turn;
  const Vector3 gravity(0, scene.downhill.y(), -scene.gravity);
  EXPECT_LT((turn * gravity - Vector3(0, 0, -kGravity)).norm(), 1e-14);
  EXPECT_LT((turn * turn.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_NEAR(turn.determinant(), 1, 1e-14);
  EXPECT_NEAR((turn * Vector3::UnitZ()).z(), std::cos(theta), 1e-14);  // the normal leans by θ
}

}  // namespace
}  // namespace slipcheck::bullet
