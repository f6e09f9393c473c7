#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bullet_run.h"

namespace slipcheck {
namespace {

Scene everything() {
  Scene scene =
      scene_of(steel_ball(0.01), {rolling_along_x(0.01, 0, 0), rolling_along_x(0.01, 1, 0)},
               rough_ground(RollingFriction({{0, 0.01}, {1, 0.02}})), {0.9, 0.3, 0.5});
  scene.confined = true;
  return scene;
}

TEST(BulletProfiles, BothPrecisionsSayWhoTheyAre) {
  for (const std::string precision : {"single", "double"}) {
    const RemoteEngine engine(bullet_executable(precision));
    EXPECT_EQ(engine.info().engine, "bullet");
    EXPECT_EQ(engine.info().version, "3.24");
    EXPECT_EQ(engine.info().precision, precision);
  }
}

TEST(BulletProfiles, AStepBelowItsEpsilonIsRefused) {
  RemoteEngine single(bullet_executable("single"));
  EXPECT_THROW(single.configure(everything(), kDefault, 1e-7), Refused);
  RemoteEngine as_double(bullet_executable("double"));
  EXPECT_NO_THROW(as_double.configure(everything(), kDefault, 1e-7));
}

TEST(BulletProfiles, DefaultAppliesThePairsOwnNumbers) {
  RemoteEngine engine(bullet_executable("double"));
  const Applied applied = engine.configure(everything(), kDefault, 1e-3);
  EXPECT_EQ(number(applied, "friction"), 0.1);
  EXPECT_EQ(number(applied, "substrate_restitution"), 0.4);
  EXPECT_EQ(number(applied, "restitution"), 0.9);
  EXPECT_EQ(number(applied, "pair_friction"), 0.3);
  EXPECT_EQ(number(applied, "spinning_friction"), 2e-5);
  EXPECT_EQ(std::get<std::string>(applied.settings.at("rolling_friction")), "by speed");
  EXPECT_EQ(number(applied, "time_step"), 1e-3);
  EXPECT_EQ(number(applied, "gravity"), kGravity);
}

TEST(BulletProfiles, SettingsAreBulletsOwn) {
  RemoteEngine engine(bullet_executable("double"));
  const Applied applied = engine.configure(everything(), kDefault, 1e-3);
  // As printed in Bullet's manual and headers of 3.24; the threshold is stored as a float.
  EXPECT_EQ(number(applied, "erp"), 0.2);
  EXPECT_EQ(number(applied, "erp2"), 0.2);
  EXPECT_EQ(number(applied, "solver_iterations"), 10);
  EXPECT_EQ(std::get<bool>(applied.settings.at("split_impulse")), true);
  EXPECT_NEAR(number(applied, "split_impulse_threshold"), -0.04, 1e-9);
  EXPECT_NEAR(number(applied, "restitution_velocity_threshold"), 0.2, 1e-8);
  EXPECT_EQ(number(applied, "linear_sleeping_threshold"), 0.8);
  EXPECT_EQ(number(applied, "angular_sleeping_threshold"), 1);
  // 0.02 times half the diagonal of the sphere's bounding box, not of its radius.
  EXPECT_NEAR(number(applied, "contact_breaking_threshold"), 0.02 * std::sqrt(3) * 0.01, 1e-12);
}

TEST(BulletProfiles, NaiveGetsBulletsProducts) {
  RemoteEngine engine(bullet_executable("double"));
  const Applied applied = engine.configure(everything(), kNaive, 1e-3);
  EXPECT_DOUBLE_EQ(number(applied, "friction"), 0.1 * 0.1);
  EXPECT_DOUBLE_EQ(number(applied, "pair_friction"), 0.1 * 0.1);
  EXPECT_DOUBLE_EQ(number(applied, "restitution"), 0.9 * 0.9);
  EXPECT_DOUBLE_EQ(number(applied, "substrate_restitution"), 0.9 * 0.4);
  EXPECT_DOUBLE_EQ(number(applied, "rolling_friction"), 0.01 * 0.1);
  EXPECT_DOUBLE_EQ(number(applied, "spinning_friction"), 2e-5 * 0.1);
}

TEST(BulletProfiles, NaiveSlidesWithTheSquareOfTheFriction) {
  // As in BulletSliding.ItIsBrakedByTheFrictionOfTheScene, with μ².
  EXPECT_NEAR(braking_friction(0.4, kNaive) / 0.16, 1, 1e-3);
}

TEST(BulletProfiles, ChangingTheProfileLeavesNothingBehind) {
  RemoteEngine engine(bullet_executable("double"));
  engine.configure(everything(), kDefault, 1e-3);
  const Applied naive = engine.configure(everything(), kNaive, 1e-3);
  EXPECT_DOUBLE_EQ(number(naive, "friction"), 0.01);
  const Applied back = engine.configure(everything(), kDefault, 1e-3);
  EXPECT_EQ(number(back, "friction"), 0.1);
}

TEST(BulletProfiles, WhatDiffersIsNamedByBodyAndPair) {
  Scene scene = everything();
  scene.bodies[1].radius = 0.02;
  scene.bodies.push_back(scene.bodies[0]);
  scene.initial.push_back(rolling_along_x(0.01, 2, 0));
  scene.material = {0, 0, 1};
  scene.substrate = {ground_with_friction(0.1), ground_with_friction(0.2)};
  scene.substrate[0].rolling = RollingFriction(0.01);
  PairContact soft;
  soft.restitution = 0.5;
  scene.pairs = {scene.pairs[0], soft, soft, soft};
  RemoteEngine engine(bullet_executable("double"));
  const Applied applied = engine.configure(scene, kDefault, 1e-3);
  EXPECT_EQ(number(applied, "friction[1]"), 0.1);
  EXPECT_EQ(number(applied, "friction[2]"), 0.2);
  EXPECT_DOUBLE_EQ(number(applied, "rolling_friction[0]"), 1.4 * 0.01 * 0.01);
  EXPECT_DOUBLE_EQ(number(applied, "rolling_friction[1]"), 1.4 * 0.01 * 0.02);
  EXPECT_EQ(number(applied, "restitution[0-1]"), 0.9);
  EXPECT_EQ(number(applied, "restitution[0-2]"), 0.5);
  EXPECT_EQ(applied.settings.count("restitution"), 0u);
  EXPECT_EQ(applied.settings.count("restitution[1-2]"), 0u);  // the same materials again
}

TEST(BulletProfiles, WhatIsNotRepresentedIsSaid) {
  RemoteEngine engine(bullet_executable("double"));
  const Applied rich = engine.configure(everything(), kDefault, 1e-3);
  for (const char* what :
       {"static friction", "rolling friction only while rolling", "rolling friction alike",
        "restitution below 0.2 m/s", "tangential restitution", "confinement"}) {
    EXPECT_TRUE(lists(rich, what)) << what;
  }
  EXPECT_FALSE(lists(rich, "rolling friction that depends on the speed"));
  EXPECT_FALSE(lists(rich, "coupled drilling"));
  Scene scene = everything();
  scene.substrate[0].coupled_radius = 1e-3;
  scene.substrate[0].rolling_while_sliding = true;
  const Applied coupled = engine.configure(scene, kDefault, 1e-3);
  EXPECT_TRUE(lists(coupled, "coupled drilling"));
  EXPECT_EQ(number(coupled, "spinning_friction"), 2e-5);
  // Bullet's rolling friction acts on what slides too.
  EXPECT_FALSE(lists(coupled, "rolling friction only while rolling"));
  EXPECT_TRUE(lists(coupled, "rolling friction alike"));
  const Applied naive = engine.configure(everything(), kNaive, 1e-3);
  EXPECT_TRUE(lists(naive, "rolling friction that depends on the speed"));

  PairContact dead;
  dead.restitution = 0.0;
  const Scene plain =
      scene_of(steel_ball(0.01), {rolling_along_x(0.01, 0, 0), rolling_along_x(0.01, 1, 0)},
               ground_with_friction(0.1), dead);
  EXPECT_TRUE(engine.configure(plain, kDefault, 1e-3).not_represented.empty());

  Scene heavy = everything();
  heavy.bodies[0].mass = 1000;
  EXPECT_TRUE(lists(engine.configure(heavy, kDefault, 1e-2), "rolling and drilling torque"));
  EXPECT_FALSE(lists(engine.configure(everything(), kDefault, 1e-2), "rolling and drilling"));
}

}  // namespace
}  // namespace slipcheck
