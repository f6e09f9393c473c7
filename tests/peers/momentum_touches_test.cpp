#include "peer_backends/shared/momentum_touches.h"

#include <gtest/gtest.h>

#include "../scenes.h"

namespace slipcheck {
namespace {

TEST(MomentumTouches, ACentralHitGivesTheImpulseToTheBit) {
  const Scene scene = test::free_pair(0.15, -0.15, 0.0021);
  std::vector<BodyState> after = scene.initial;
  after[0].velocity.x() = -0.135;
  after[1].velocity.x() = 0.135;
  const auto touches = momentum_touches(scene, scene.initial, after, 1e-3);
  ASSERT_EQ(touches.size(), 1u);
  EXPECT_EQ(touches[0].first, 0);
  EXPECT_EQ(touches[0].second, 1);
  EXPECT_NEAR(touches[0].normal_impulse / (scene.bodies[0].mass * 0.285), 1, 1e-12);
}

TEST(MomentumTouches, BallsThatBrakeBesideEachOtherDoNotTouch) {
  Scene scene = test::head_on(0.15, -0.15, 0.9, 0.005);
  std::vector<BodyState> after = scene.initial;
  for (BodyState& state : after) {
    state.velocity.x() *= 0.99;
    state.position += 1e-3 * state.velocity;
  }
  const auto touches = momentum_touches(scene, scene.initial, after, 1e-3);
  ASSERT_EQ(touches.size(), 2u);  // each with the substrate, by its weight
  for (const Touch& touch : touches) {
    EXPECT_EQ(touch.second, kSubstrate);
    EXPECT_NEAR(touch.normal_impulse, scene.bodies[0].mass * 9.81e-3, 1e-15);
  }
}

/// Two that part while friction brakes them by more than their overlap still pushes.
TEST(MomentumTouches, AnOverlapTellsWhereFrictionIsMoreThanWhatPushes) {
  Scene scene = test::head_on(-0.15, 0.15, 0.9, 0.00199);
  std::vector<BodyState> after = scene.initial;
  after[0].velocity.x() += 1e-4;
  after[1].velocity.x() -= 1e-4;
  const auto touches = [&](OverlapPushes overlaps) {
    return momentum_touches(scene, scene.initial, after, 1e-3, 0, overlaps).size();
  };
  EXPECT_EQ(touches(OverlapPushes::no), 2u);  // each with the substrate
  EXPECT_EQ(touches(OverlapPushes::yes), 3u);
  // Before or after the step is enough; else there was none.
  for (BodyState& state : after) state.position.x() *= 1.1;
  EXPECT_EQ(touches(OverlapPushes::yes), 3u);
  scene.initial = after;
  EXPECT_EQ(touches(OverlapPushes::yes), 2u);
}

TEST(MomentumTouches, ABallThatFliesTouchesNothing) {
  Scene scene = test::head_on(0.15, 0.15, 0.9);
  scene.initial[0].position.z() = scene.initial[1].position.z() = 0.1;
  std::vector<BodyState> after = scene.initial;
  for (BodyState& state : after) state.velocity.z() -= 9.81e-3;
  EXPECT_TRUE(momentum_touches(scene, scene.initial, after, 1e-3).empty());
}

TEST(MomentumTouches, AThirdBallOfALineIsPushedByTheSecond) {
  Scene scene = test::steel_scene(3);
  scene.gravity = 0;
  const double mass = scene.bodies[0].mass;
  for (std::size_t i = 0; i < 3; ++i)
    scene.initial[i].position = {0.004 * static_cast<double>(i), 0, 1};
  scene.initial[0].velocity.x() = 0.3;
  std::vector<BodyState> after = scene.initial;
  after[0].velocity.x() = 0.05;
  after[1].velocity.x() = 0.05;
  after[2].velocity.x() = 0.2;
  const auto touches = momentum_touches(scene, scene.initial, after, 1e-3);
  ASSERT_EQ(touches.size(), 2u);
  EXPECT_NEAR(touches[0].normal_impulse / mass, 0.25, 1e-12);
  EXPECT_NEAR(touches[1].normal_impulse / mass, 0.2, 1e-12);
}

TEST(MomentumTouches, ASurfaceThatComesPushesAlongItsOwnNormal) {
  Scene scene = test::steel_scene(1);
  scene.gravity = 0;
  scene.has_substrate = false;
  const Vector3 normal(0.6, 0, 0.8);
  const auto course = SubstrateMotion::constant({0.5, 0});
  scene.surfaces = {{PlaneShape{Vector3::Zero(), normal},
                     SurfaceMotion::moving(course, normal, Vector3::UnitY())}};
  const double radius = scene.bodies[0].radius;
  // At 0.1 s the plane is 5 cm on, and hits the ball at rest there: it leaves with 0.8 m/s.
  scene.initial[0] = {};
  scene.initial[0].position = (0.05 + radius) * normal;
  std::vector<BodyState> after = scene.initial;
  after[0].velocity = 0.8 * normal;
  after[0].position += 1e-3 * after[0].velocity;
  const auto touches = momentum_touches(scene, scene.initial, after, 1e-3, 0.1);
  ASSERT_EQ(touches.size(), 1u);
  EXPECT_EQ(touches[0].second, surface_touch(0));
  EXPECT_NEAR(touches[0].normal_impulse / scene.bodies[0].mass, 0.8, 1e-12);
  EXPECT_TRUE(momentum_touches(scene, scene.initial, after, 1e-3, 0).empty());  // not there yet
}

TEST(InImpact, IsWhatOverlapsTheSubstrateAndDoesNotRest) {
  Scene scene = test::steel_scene(1);
  scene.initial[0].position.z() = 0.002 - 1e-6;
  EXPECT_FALSE(in_impact(scene, scene.initial, 1e-4));
  scene.initial[0].velocity.z() = 0.1;
  EXPECT_TRUE(in_impact(scene, scene.initial, 1e-4));
  // Of two bodies the observer sees a collision of several steps as one.
  EXPECT_FALSE(
      in_impact(test::free_pair(0, 0, 0.0019), test::free_pair(0, 0, 0.0019).initial, 1e-4));
}

}  // namespace
}  // namespace slipcheck
