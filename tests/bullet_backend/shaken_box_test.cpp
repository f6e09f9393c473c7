// Many balls in a shaken box: what they may not do whatever Bullet makes of their collisions.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bullet_box.h"

namespace slipcheck {
namespace {

constexpr double kRate = 1000;  // [Hz]

/// `count` rough balls of 10 mm and some of 8 mm in rows between the walls, over a floor that moves
/// with up to 1 m/s.
Scene shaken(std::size_t count) {
  Scene scene = box_of(steel_ball(0.01), {});
  for (std::size_t i = 0; i < count; ++i) {
    const auto column = static_cast<double>(i % 8), row = static_cast<double>(i / 8);
    scene.bodies.push_back(steel_ball(i % 3 == 0 ? 0.008 : 0.01));
    scene.initial.push_back(in_plane(0.015 + 0.024 * column, 0.03 + 0.024 * row,
                                     0.3 * std::sin(3.0 * column + row), 0.2 * std::cos(row), 5));
    scene.material.push_back(0);
  }
  scene.gravity = kGravity;
  scene.pairs = {{0.9, 0.5, 0}};
  Box& box = *scene.box;
  box.floor = {0.016, 10};
  box.moving_walls = true;
  box.on_floor = box.on_wall = {{0.9, 0.5, 0}};
  return scene;
}

class BulletShakenBox : public ::testing::TestWithParam<const char*> {};

TEST_P(BulletShakenBox, NobodyLeavesItOrThePlane) {
  for (const char* profile : {"default", "naive", "physical", "tuned", "fast"}) {
    Scene scene = shaken(50);
    scene.box->lid = 0.5;
    RemoteEngine engine(bullet_executable(GetParam()));
    // Each step of `tuned` is up to nine.
    const std::size_t steps = profile == std::string("tuned") ? 200 : 1000;
    std::size_t n = 0, pairs = 0;
    for (const Frame& frame : run(engine, scene, shipped(profile), kRate, steps)) {
      const double t = (static_cast<double>(n) + frame.part) / kRate;
      n += frame.part == 1;
      for (const BodyState& body : frame.bodies) {
        ASSERT_TRUE(body.position.allFinite());
        // Balls go into walls by what they fly in a step and are pushed out; a centre behind one
        // would be 8 mm deep, at 1 kHz a flight with 8 m/s.
        ASSERT_GT(body.position.x(), 0) << profile << " at " << t;
        ASSERT_LT(body.position.x(), scene.box->width) << profile << " at " << t;
        ASSERT_GT(body.position.z(), scene.box->floor.height(t)) << profile << " at " << t;
        ASSERT_LT(body.position.z(), 0.5 + scene.box->floor.height(t)) << profile << " at " << t;
        ASSERT_EQ(body.position.y(), 0);
        ASSERT_EQ(body.velocity.y(), 0);
        ASSERT_EQ(body.angular_velocity.x(), 0);
        ASSERT_EQ(body.angular_velocity.z(), 0);
      }
      for (const Touch& touch : frame.touches) {
        ASSERT_GT(touch.normal_impulse, 0);
        ASSERT_TRUE(touch.second == kSubstrate || touch.second > touch.first);
        pairs += touch.second >= 0;
      }
    }
    EXPECT_GT(pairs, steps / 2);
  }
}

TEST_P(BulletShakenBox, AFreshStartIsTheSameBitForBit) {
  const Scene scene = shaken(50);
  RemoteEngine engine(bullet_executable(GetParam()));
  engine.configure(scene, kDefault, 1 / kRate);
  const auto frames_from = [&](double time) {
    std::vector<double> heights;
    engine.start(scene.initial, time);
    engine.advance(300, [&](const Frame& frame) {
      for (const BodyState& body : frame.bodies) heights.push_back(body.position.z());
    });
    return heights;
  };
  const auto first = frames_from(0.125);
  EXPECT_NE(frames_from(0.15), first);  // another phase of the floor
  EXPECT_EQ(frames_from(0.125), first);
}

TEST_P(BulletShakenBox, HundredsStayAwakeAndInIt) {
  const Scene scene = shaken(400);
  RemoteEngine engine(bullet_executable(GetParam()));
  const auto frames = run(engine, scene, kDefault, 240, 240);
  const double t = 1;
  for (const BodyState& body : frames.back().bodies) {
    // At 240 Hz and some m/s centres go behind walls for a step; out of reach of the push they
    // would fall for ever, g t²/2 = 5 m in the second.
    EXPECT_GT(body.position.z(), scene.box->floor.height(t) - 0.05);
    EXPECT_GT(body.position.x(), -0.05);
    EXPECT_LT(body.position.x(), scene.box->width + 0.05);
    EXPECT_NE(body.velocity, Vector3(0, 0, 0));
  }
}

TEST_P(BulletShakenBox, WhatLiesOnAShakenFloorNeverSleeps) {
  // A ω² = 0.4 m/s² < g: it stays on the floor, slower than Bullet's 0.8 m/s and 1 rad/s.
  Scene scene = box_of(steel_ball(0.01), {in_plane(0.1, 0.01, 0, 0)});
  scene.gravity = kGravity;
  scene.box->floor = {0.01, 1};
  RemoteEngine engine(bullet_executable(GetParam()));
  std::size_t n = 0;
  for (const Frame& frame : run(engine, scene, kDefault, kRate, 4000)) {
    const double t = static_cast<double>(++n) / kRate;
    // Bullet follows a step behind, V dt = 6e-5 m, with what penetration its 10 iterations and the
    // push of a fifth leave: g dt²/0.2 = 5e-5 m.
    if (n <= 100) continue;
    EXPECT_NEAR(frame.bodies[0].position.z(), 0.01 + scene.box->floor.height(t), 2e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(Precisions, BulletShakenBox, ::testing::Values("double", "single"),
                         [](const auto& param) { return std::string(param.param); });

}  // namespace
}  // namespace slipcheck
