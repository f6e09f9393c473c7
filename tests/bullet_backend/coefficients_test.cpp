#include "bullet_backend/coefficients.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bullet_run.h"

namespace slipcheck::bullet {
namespace {

Scene two_balls(const Sphere& ball, const SubstrateContact& ground, const PairContact& pair) {
  return scene_of(ball, {rolling_along_x(ball.radius, 0, 1), rolling_along_x(ball.radius, 1, 0)},
                  ground, pair);
}

TEST(BulletCoefficients, RollingLengthTurnsIntoTheDecelerationOfTheScene) {
  SubstrateContact ground = ground_with_friction(0.2);
  ground.rolling = RollingFriction({{0, 0.01}, {1, 0.03}});
  const Sphere shell = {0.05, 0.1, 2.0 / 3};
  const PairCoefficients map(two_balls(shell, ground, {}), {}, 1e-3);
  // A torque ρ m g on a rolling sphere: (1 + q) m a R = ρ m g, so ρ = (1 + q) R a/g, a/g = μ_r.
  EXPECT_DOUBLE_EQ(map.rolling_friction(0, kSubstrate, 0, false), (5.0 / 3) * 0.05 * 0.01);
  EXPECT_DOUBLE_EQ(map.rolling_friction(0, kSubstrate, 0.5, false), (5.0 / 3) * 0.05 * 0.02);
  EXPECT_EQ(map.rolling_friction(0, 1, 0.5, false), 0);
  EXPECT_FALSE(map.is_cut(0));
}

TEST(BulletCoefficients, ImpulsesAboveOneRaiseTheTorques) {
  SubstrateContact ground = ground_with_friction(0.2);
  ground.rolling = RollingFriction(0.01);
  ground.drilling_length = 0.003;
  const Sphere heavy = {0.5, 100, 0.4};
  const PairCoefficients map(two_balls(heavy, ground, {}), {}, 1e-2);
  const double impulse = 100 * kGravity * 1e-2;  // 9.81 N s, of which the solver counts 1
  EXPECT_TRUE(map.is_cut(0));
  EXPECT_DOUBLE_EQ(map.rolling_friction(0, kSubstrate, 1, false), 1.4 * 0.5 * 0.01 * impulse);
  EXPECT_DOUBLE_EQ(map.spinning_friction(0, kSubstrate), 0.003 * impulse);
}

TEST(BulletCoefficients, DrillingOpensTheGateOfRolling) {
  SubstrateContact ground = ground_with_friction(0.2);
  ground.drilling_length = 1e-4;
  const PairCoefficients map(two_balls(steel_ball(0.01), ground, {}), {}, 1e-3);
  EXPECT_GT(map.rolling_friction(0, kSubstrate, 1, false), 0);
  EXPECT_LE(map.rolling_friction(0, kSubstrate, 1, false), 1e-12);
  const PairCoefficients none(two_balls(steel_ball(0.01), ground_with_friction(0.2), {}), {}, 1e-3);
  EXPECT_EQ(none.rolling_friction(0, kSubstrate, 1, false), 0);
}

TEST(BulletCoefficients, APairThatKeepsItsSlipHasNoFriction) {
  PairContact pair;
  pair.friction = 0.3;
  pair.tangential_restitution = 0;
  const SubstrateContact ground;
  const Sphere ball = steel_ball(0.01);
  EXPECT_EQ(PairCoefficients(two_balls(ball, ground, pair), {}, 1e-3).friction(0, 1, true), 0.3);
  pair.tangential_restitution = -1;
  EXPECT_EQ(PairCoefficients(two_balls(ball, ground, pair), {}, 1e-3).friction(0, 1, true), 0);
}

TEST(BulletCoefficients, ATableOfRestitutionsIsFollowed) {
  // ln(e/(1 − e)) falls by 0.2 for each factor e in the speed, from 2 at 1 m/s: at two points.
  const TabulatedRestitution table{0, 1, {2, 1.8}, {-0.2, -0.2}};
  PairContact pair;
  pair.restitution = table;
  const Scene scene = two_balls(steel_ball(0.01), {}, pair);
  const PairCoefficients map(scene, {}, 1e-3);
  for (const double g : {1.0, 2.0, std::exp(1.0)}) {
    EXPECT_NEAR(map.restitution(0, 1, g), 1 / (1 + std::exp(-2 + 0.2 * std::log(g))), 1e-15);
  }
  // Outside 1 − e goes on as a power: its logarithm rises with 0.2 e.
  const double e = 1 / (1 + std::exp(-2.0));
  EXPECT_NEAR(map.restitution(0, 1, 0.01), 1 - (1 - e) * std::pow(0.01, 0.2 * e), 1e-15);
  // What people type: the value at the speed at which the two start, here 1 m/s.
  EXPECT_NEAR(naive_ball(scene, 1).restitution, 1 / (1 + std::exp(-2)), 1e-15);
}

TEST(BulletCoefficients, WhetherAContactSlipsDecidesWhereAsked) {
  SubstrateContact ground;
  ground.static_friction = 0.5;
  ground.kinetic_friction = 0.2;
  ground.rolling = RollingFriction(0.01);
  const Scene scene = two_balls(steel_ball(0.05), ground, {1.0, 0.3, 0});
  BulletSettings settings;
  const PairCoefficients one(scene, settings, 1e-3);
  settings.coefficients = CoefficientMap::pair_and_slip;
  const PairCoefficients map(scene, settings, 1e-3);
  EXPECT_EQ(one.friction(0, kSubstrate, false), 0.2);
  EXPECT_EQ(map.friction(0, kSubstrate, false), 0.5);
  EXPECT_EQ(map.friction(0, kSubstrate, true), 0.2);
  EXPECT_EQ(map.friction(0, 1, false), 0.3);
  EXPECT_EQ(one.rolling_friction(0, kSubstrate, 1, true), 1.4 * 0.01 * 0.05);
  EXPECT_EQ(map.rolling_friction(0, kSubstrate, 1, false), 1.4 * 0.01 * 0.05);
  EXPECT_EQ(map.rolling_friction(0, kSubstrate, 1, true), 0);
  ground.rolling_while_sliding = true;
  const PairCoefficients both(two_balls(steel_ball(0.05), ground, {}), settings, 1e-3);
  EXPECT_EQ(both.rolling_friction(0, kSubstrate, 1, true), 1.4 * 0.01 * 0.05);
  // u̇ = −(1 + 1/q) μ_k g: a step of friction takes (7/2)·0.2·g·1 ms from the slip.
  const double in_a_step = 3.5 * 0.2 * kGravity * 1e-3;
  EXPECT_FALSE(map.slips(0, 0.999 * in_a_step));
  EXPECT_TRUE(map.slips(0, 1.001 * in_a_step));
}

TEST(BulletCoefficients, AMultibodysRestitutionMakesUpForTheStepsGravity) {
  SubstrateContact ground;
  ground.restitution = 0.8;
  const Scene scene = two_balls(steel_ball(0.05), ground, {0.9, 0, 0});
  BulletSettings settings;
  settings.body = BodyKind::multibody;
  PairCoefficients map(scene, settings, 1e-2);
  // Bullet sees v + g dt and sends back e' (v + g dt), which is to be e v.
  const double v = 0.3;
  EXPECT_NEAR(map.restitution(0, kSubstrate, v) * (v + kGravity * 1e-2), 0.8 * v, 1e-15);
  map.set_time_step(1e-4);
  EXPECT_NEAR(map.restitution(0, kSubstrate, v) * (v + kGravity * 1e-4), 0.8 * v, 1e-15);
  EXPECT_EQ(map.restitution(0, kSubstrate, 0), 0);  // at rest it stays at rest
  EXPECT_EQ(map.restitution(0, 1, v), 0.9);
  EXPECT_EQ(PairCoefficients(scene, {}, 1e-2).restitution(0, kSubstrate, v), 0.8);
}

TEST(BulletCoefficients, AMultibodysRestitutionMakesUpForGravityOnTheSideThatItPullsTo) {
  // A step's gravity drives a ball into the floor with v + g dt, away from the lid with v − g dt,
  // and past a wall.
  Scene scene = scene_of(steel_ball(0.05), {rolling_along_x(0.05, 0, 1)}, {});
  Box box;
  box.width = 1;
  box.on_floor = box.on_wall = box.on_lid = {PairContact{0.8, 0, 0}};
  scene.box = box;
  BulletSettings settings;
  settings.body = BodyKind::multibody;
  const PairCoefficients map(scene, settings, 1e-2);
  const double v = 0.3, kick = kGravity * 1e-2;
  EXPECT_NEAR(map.restitution(0, kFloor, v) * (v + kick), 0.8 * v, 1e-15);
  EXPECT_NEAR(map.restitution(0, kLid, v) * (v - kick), 0.8 * v, 1e-15);
  EXPECT_EQ(map.restitution(0, kWall, v), 0.8);
}

TEST(BulletCoefficients, FactorsMultiplyWhatTheMapsGive) {
  SubstrateContact ground = ground_with_friction(0.2);
  ground.rolling = RollingFriction(0.01);
  ground.drilling_length = 1e-3;
  ground.restitution = 0.5;
  const Scene scene = two_balls(steel_ball(0.05), ground, {0.6, 0.3, 0});
  BulletSettings settings;
  settings.friction_factor = 2;
  settings.restitution_factor = 0.5;
  settings.rolling_friction_factor = 3;
  settings.spinning_friction_factor = 4;
  const PairCoefficients map(scene, settings, 1e-3);
  EXPECT_DOUBLE_EQ(map.friction(0, kSubstrate, true), 0.4);
  EXPECT_DOUBLE_EQ(map.friction(0, 1, true), 0.6);
  EXPECT_DOUBLE_EQ(map.restitution(0, kSubstrate, 1), 0.25);
  EXPECT_DOUBLE_EQ(map.restitution(0, 1, 1), 0.3);
  EXPECT_DOUBLE_EQ(map.rolling_friction(0, kSubstrate, 1, false), 3 * 1.4 * 0.01 * 0.05);
  EXPECT_DOUBLE_EQ(map.spinning_friction(0, kSubstrate), 4e-3);
}

TEST(BulletCoefficients, NaiveTakesTheNumbersStraight) {
  const SubstrateContact ground = rough_ground(RollingFriction({{0, 0.001}, {1, 0.002}}));
  PairContact pair;
  pair.restitution = 0.9;
  const Scene pair_scene = two_balls(steel_ball(0.01), ground, pair);
  const BodyFields ball = naive_ball(pair_scene, 0);
  EXPECT_EQ(ball.friction, 0.1);
  EXPECT_EQ(ball.restitution, 0.9);
  EXPECT_EQ(ball.rolling_friction, 0.001);
  EXPECT_EQ(ball.spinning_friction, 2e-5);
  EXPECT_EQ(naive_surface(pair_scene, kFloor).friction, 0.1);
  EXPECT_EQ(naive_surface(pair_scene, kFloor).restitution, 0.4);

  const Scene alone = scene_of(steel_ball(0.01), {rolling_along_x(0.01, 0, 1)}, ground);
  EXPECT_EQ(naive_ball(alone, 0).restitution, 0.4);
}

TEST(BulletCoefficients, NaiveTakesALawAtItsReferenceSpeed) {
  PairContact pair;
  pair.restitution = PowerLawRestitution{0.32, 0.234, 0.01};
  EXPECT_DOUBLE_EQ(naive_ball(two_balls(steel_ball(0.01), {}, pair), 1).restitution, 0.32);
}

}  // namespace
}  // namespace slipcheck::bullet
