// What a frame holds, and that the same start gives the same frames.

#include <gtest/gtest.h>

#include <cmath>

#include "bullet_run.h"
#include "same_bits.h"

namespace slipcheck {
namespace {

/// Five rolling balls of two sizes that meet one another.
Scene crowd() {
  SubstrateContact ground = ground_with_friction(0.1);
  ground.rolling = RollingFriction(0.001);
  PairContact pair;
  pair.restitution = 0.8;
  Scene scene = scene_of(steel_ball(0.005), {}, ground, pair);
  for (int i = 0; i < 5; ++i) {
    const double radius = i % 2 == 0 ? 0.005 : 0.004;
    scene.bodies.push_back(steel_ball(radius));
    scene.initial.push_back(rolling_along_x(radius, 0.03 * i, 0.5 - 0.25 * i));
    scene.material.push_back(0);
  }
  return scene;
}

class BulletWorldTest : public ::testing::TestWithParam<const char*> {};

TEST_P(BulletWorldTest, AFreshStartIsTheSameBitForBit) {
  const Scene scene = crowd();
  RemoteEngine engine(bullet_executable(GetParam()));
  const auto first = run(engine, scene, kDefault, 500, 300);

  // Another scene in between, then the same again without configuring anew, then a new process.
  run(engine, scene_of(steel_ball(0.1), {rolling_along_x(0.1, 0, 3)}, {}), kNaive, 60, 50);
  expect_same_bits(run(engine, scene, kDefault, 500, 300), first);
  engine.start(scene.initial);
  std::vector<Frame> again;
  engine.advance(300, [&](const Frame& frame) { again.push_back(frame); });
  expect_same_bits(again, first);
  RemoteEngine other(bullet_executable(GetParam()));
  expect_same_bits(run(other, scene, kDefault, 500, 300), first);
}

TEST_P(BulletWorldTest, APlaneCarriesARollingBallsWeightHoweverManyPointsItHas) {
  const Sphere ball = steel_ball(0.002);
  const Scene scene = scene_of(ball, {rolling_along_x(0.002, 0, 0.3)}, ground_with_friction(0.1));
  RemoteEngine engine(bullet_executable(GetParam()));
  const auto frames = run(engine, scene, kDefault, 1000, 500);
  double sum = 0;
  for (const Frame& frame : frames) {
    ASSERT_EQ(frame.touches.size(), 1u);
    EXPECT_EQ(frame.touches[0].first, 0);
    EXPECT_EQ(frame.touches[0].second, kSubstrate);
    sum += frame.touches[0].normal_impulse;
  }
  // The ball stays where it is: the impulses make up its weight but for its last vertical velocity.
  const double last = frames.back().bodies[0].velocity.z();
  EXPECT_NEAR(sum / (ball.mass * kGravity * 0.5), 1, 2e-3) << last;
}

TEST_P(BulletWorldTest, ACollisionsImpulseIsTheChangeOfMomentum) {
  PairContact pair;
  pair.restitution = 0.9;
  const Sphere ball = steel_ball(0.002);
  const Scene scene =
      scene_of(ball, {rolling_along_x(0.002, 0, 0.3), rolling_along_x(0.002, 0.005, 0)}, {}, pair);
  RemoteEngine engine(bullet_executable(GetParam()));
  double impulse = 0;
  const auto frames = run(engine, scene, kDefault, 1000, 50);
  for (const Frame& frame : frames) {
    for (const Touch& touch : frame.touches) {
      if (touch.second == kSubstrate) continue;
      EXPECT_EQ(touch.first, 0);
      EXPECT_EQ(touch.second, 1);
      impulse += touch.normal_impulse;
    }
  }
  // No friction anywhere: the struck ball got all its momentum from the touch.
  const double momentum = ball.mass * frames.back().bodies[1].velocity.x();
  EXPECT_GT(momentum, 0);
  EXPECT_NEAR(impulse / momentum, 1, 1e-5);  // single precision
}

TEST_P(BulletWorldTest, ASlowBallFallsAsleepAndTouchesNothingThen) {
  // Without rolling friction it rolls for ever; Bullet freezes what is slower than 0.8 m/s and
  // 1 rad/s for 2 s.
  const Scene scene =
      scene_of(steel_ball(0.005), {rolling_along_x(0.005, 0, 0.004)}, ground_with_friction(0.1));
  RemoteEngine engine(bullet_executable(GetParam()));
  const auto frames = run(engine, scene, kDefault, 240, 600);
  EXPECT_NEAR(frames[470].bodies[0].velocity.x(), 0.004, 1e-5);  // after 1.96 s
  EXPECT_FALSE(frames[470].touches.empty());
  EXPECT_EQ(frames[490].bodies[0].velocity.x(), 0);  // after 2.05 s
  EXPECT_TRUE(frames[490].touches.empty());
  EXPECT_EQ(frames[490].bodies[0].position.x(), frames[599].bodies[0].position.x());
  EXPECT_NEAR(frames[599].bodies[0].position.x(), 0.004 * 2.0, 0.004 * 0.03);
}

TEST_P(BulletWorldTest, ABallInTheAirTouchesNothing) {
  BodyState state;
  state.position = Vector3(0, 0, 1);
  const Scene scene = scene_of(steel_ball(0.01), {state}, ground_with_friction(0.1));
  RemoteEngine engine(bullet_executable(GetParam()));
  for (const Frame& frame : run(engine, scene, kDefault, 240, 60)) {
    EXPECT_TRUE(frame.touches.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Precisions, BulletWorldTest, ::testing::Values("double", "single"),
                         [](const auto& param) { return std::string(param.param); });

}  // namespace
}  // namespace slipcheck
