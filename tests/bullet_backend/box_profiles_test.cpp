// What the engine says about a scene in a box, and which scenes it refuses.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "bullet_backend/coefficients.h"
#include "bullet_box.h"
#include "engine/scene_needs.h"

namespace slipcheck {
namespace {

/// Three balls of two materials in a shaken box with a lid, each contact different.
Scene everything() {
  Scene scene = box_of(steel_ball(0.01), {in_plane(0.05, 0.1, 0, 0), in_plane(0.1, 0.1, 0, 0),
                                          in_plane(0.15, 0.1, 0, 0)});
  scene.bodies[2].radius = 0.005;
  scene.material = {0, 0, 1};
  scene.substrate.resize(2);
  scene.gravity = kGravity;
  scene.pairs = {{0.9, 0.5, 0}, {0.8, 0.4, 0}, {0.8, 0.4, 0}, {0.7, 0.3, 0}};
  Box& box = *scene.box;
  box.floor = {0.002, 10};
  box.lid = 0.3;
  box.on_floor = {{0.6, 0.2, 0}, {0.5, 0.1, 0}};
  box.on_wall = {{PowerLawRestitution{}, 0.25, 0}, {PowerLawRestitution{}, 0.25, 0}};
  box.on_lid = {{0.3, 0.15, 0}, {0.3, 0.15, -1}};
  return scene;
}

TEST(BulletBoxProfiles, DefaultAppliesTheNumbersOfEverySurface) {
  RemoteEngine engine(bullet_executable("double"));
  const Applied applied = engine.configure(everything(), kDefault, 1e-3);
  EXPECT_EQ(number(applied, "restitution[0-1]"), 0.9);
  EXPECT_EQ(number(applied, "restitution[0-2]"), 0.8);
  EXPECT_EQ(number(applied, "pair_friction[0-2]"), 0.4);
  EXPECT_EQ(number(applied, "floor_restitution[0]"), 0.6);
  EXPECT_EQ(number(applied, "floor_restitution[2]"), 0.5);
  EXPECT_EQ(number(applied, "floor_friction[2]"), 0.1);
  EXPECT_EQ(std::get<std::string>(applied.settings.at("wall_restitution")), "by speed");
  EXPECT_EQ(number(applied, "wall_friction"), 0.25);
  EXPECT_EQ(number(applied, "lid_restitution"), 0.3);
  EXPECT_EQ(number(applied, "lid_friction[0]"), 0.15);
  EXPECT_EQ(number(applied, "lid_friction[2]"), 0);  // β0 = -1: the slip is kept
  EXPECT_EQ(std::get<std::string>(applied.settings.at("surface_velocity")), "step_before");
  EXPECT_EQ(std::get<bool>(applied.settings.at("walls_move")), false);
  EXPECT_DOUBLE_EQ(number(applied, "aabb_margin"), 0.02 * 0.01);
  EXPECT_DOUBLE_EQ(number(applied, "broadphase_tree_margin"), 0.05 * 0.01);
  EXPECT_EQ(applied.settings.count("friction"), 0u);  // there is no substrate
  EXPECT_EQ(applied.settings.count("rolling_friction"), 0u);
}

TEST(BulletBoxProfiles, NaiveGetsBulletsProducts) {
  RemoteEngine engine(bullet_executable("double"));
  const Applied applied = engine.configure(everything(), kNaive, 1e-3);
  // Balls have their contact with the first other ball, surfaces theirs with the first ball.
  EXPECT_DOUBLE_EQ(number(applied, "restitution[0-1]"), 0.9 * 0.9);
  EXPECT_DOUBLE_EQ(number(applied, "restitution[0-2]"), 0.9 * 0.8);
  EXPECT_DOUBLE_EQ(number(applied, "floor_restitution[0]"), 0.9 * 0.6);
  EXPECT_DOUBLE_EQ(number(applied, "floor_friction[2]"), 0.4 * 0.2);
  EXPECT_DOUBLE_EQ(number(applied, "wall_restitution[0]"), 0.9 * 0.32);
  EXPECT_DOUBLE_EQ(number(applied, "lid_friction[0]"), 0.5 * 0.15);
  EXPECT_TRUE(lists(applied, "restitution that depends on the impact speed"));
}

TEST(BulletBoxProfiles, WhatIsNotRepresentedIsSaid) {
  RemoteEngine engine(bullet_executable("double"));
  Scene scene = everything();
  // From 0.1 m balls come down with 1.4 m/s, 1.4 mm in a step of 1 ms, 6 mm in one at 240 Hz.
  Applied applied = engine.configure(scene, kDefault, 1e-3);
  EXPECT_EQ(texts_of(applied.not_represented),
            (std::vector<std::string>{
                "restitution below 0.2 m/s of approach",
                "the floor's velocity at the contact (it is the mean over the step before)"}));
  applied = engine.configure(scene, kDefault, 1.0 / 240);
  EXPECT_TRUE(lists(applied, "collisions of bodies that pass each other within a step"));
  for (auto* contacts : {&scene.box->on_floor, &scene.box->on_wall, &scene.box->on_lid}) {
    const PairContact saved = contacts->back();
    contacts->back() = {0.5, 0.1, 0.4};
    EXPECT_TRUE(lists(engine.configure(scene, kDefault, 1e-3), "tangential restitution"));
    contacts->back() = saved;
  }
  scene.box->floor = {};
  EXPECT_FALSE(lists(engine.configure(scene, kDefault, 1e-3), "the floor's velocity"));
  // What the materials would do on a substrate is of no account.
  scene.substrate[0].static_friction = 1;
  scene.substrate[0].rolling = RollingFriction(0.01);
  EXPECT_EQ(engine.configure(scene, kDefault, 1e-3).not_represented.size(), 1u);
}

TEST(BulletBoxProfiles, ASubstrateAfterABoxHasBulletsOwnMargins) {
  // The tree's margin is global in Bullet. Two runs of one scene, before a box and after it.
  const Scene scene =
      scene_of(steel_ball(0.01), {rolling_along_x(0.01, 0, 0.3), rolling_along_x(0.01, 0.03, 0)},
               ground_with_friction(0.1));
  RemoteEngine engine(bullet_executable("double"));
  const auto before = run(engine, scene, kDefault, 240, 100);
  run(engine, everything(), kDefault, 240, 10);
  const auto after = run(engine, scene, kDefault, 240, 100);
  EXPECT_EQ(before.back().bodies[1].position, after.back().bodies[1].position);
  EXPECT_EQ(before.back().bodies[1].angular_velocity, after.back().bodies[1].angular_velocity);
}

TEST(BulletMaterialPairs, StandForAllThatMeet) {
  Scene scene = everything();
  using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
  EXPECT_EQ(material_pairs(scene), (Pairs{{0, 1}, {0, 2}}));
  scene.material = {1, 0, 1};
  EXPECT_EQ(material_pairs(scene), (Pairs{{0, 1}, {0, 2}}));
  scene.material = {1, 1, 1};
  EXPECT_EQ(material_pairs(scene), (Pairs{{0, 1}}));
}

}  // namespace
}  // namespace slipcheck
