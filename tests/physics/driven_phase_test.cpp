#include "physics/motion/driven_phase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "driven_scene.h"
#include "physics/closed_forms.h"

namespace slipcheck {
namespace {

using namespace test;

TEST(DrivenRolling, FollowsAnOscillatingPlaneWithTwoSevenths) {
  // K (11)-(15): v̇ = a_S/(1+A), so that x = x_S/(1+A) + c t; from rest on the plane, whose velocity
  // is ω X at t = 0: v = v_S/(1+A) + ω X A/(1+A).
  Scene scene = scene_with(0.5, 0.1);
  const double X = 0.003, f = 5, omega = 2 * kPi * f;
  scene.motion = SubstrateMotion::oscillation({X, 0}, f, 0);
  const DrivenPhase phase = scene.phase(0, at_rest(scene));
  ASSERT_EQ(phase.kind(), Kind::rolling);
  EXPECT_EQ(phase.duration(), std::numeric_limits<double>::infinity());
  for (const double t : {0.01, 0.123, 1.7}) {
    const BodyState s = phase.at(t);
    const double v = omega * X * (2.0 / 7 * std::cos(omega * t) + 5.0 / 7);
    EXPECT_NEAR(s.velocity.x(), v, 1e-15);
    EXPECT_NEAR(s.position.x(), X * (2.0 / 7 * std::sin(omega * t) + 5.0 / 7 * omega * t), 1e-15);
    EXPECT_LE(slip_of(scene, t, s).norm(), 1e-15);
  }
  EXPECT_NEAR(phase.largest_acceleration(), 2.0 / 7 * omega * omega * X, 1e-12);
}

TEST(DrivenRolling, GoesDownASlopeWithFiveSevenths) {
  Scene scene = scene_with(0.5, 0.1);
  scene.downhill = {0.3, 0.4};
  const DrivenPhase phase = scene.phase(0, at_rest(scene));
  ASSERT_EQ(phase.kind(), Kind::rolling);
  EXPECT_TRUE(phase.is_parabola());
  expect_close(phase.at(2).velocity, 2 * 5.0 / 7 * Vector3(0.3, 0.4, 0), 1e-15);
  // Rolling friction: less by μ_r g, and none at all below A/(1+A) |a_G| = μ_r(0) g.
  scene.contact.rolling = RollingFriction(0.01);
  expect_close(scene.phase(0, at_rest(scene)).at(2).velocity,
               2 * (5.0 / 7 * 0.5 - 0.01 * kGravity) * Vector3(0.6, 0.8, 0), 1e-15);
  scene.contact.rolling = RollingFriction(0.04);
  const DrivenPhase held = scene.phase(0, at_rest(scene));
  EXPECT_TRUE(held.is_at_rest());
  EXPECT_EQ(held.duration(), std::numeric_limits<double>::infinity());
}

TEST(DrivenRolling, BreaksLooseAtAnArcsine) {
  // K (17), (25): |a_S| = (1+A) μ_s g, and with a slope along the shaking |a_S − a_G|.
  Scene scene = scene_with(0.2, 0.1);
  const double f = 10, omega = 2 * kPi * f, limit = 3.5 * 0.2 * kGravity;
  const double X = 1.5 * limit / (omega * omega);
  scene.motion = SubstrateMotion::oscillation({X, 0}, f, 0);
  const DrivenPhase level = scene.phase(0, at_rest(scene));
  EXPECT_NEAR(level.duration(), std::asin(1 / 1.5) / omega, 1e-15);
  scene.downhill = {-0.5, 0};
  const DrivenPhase tilted = scene.phase(0, at_rest(scene));
  // ω² X sin ω t − 0.5 = limit, before the other side is reached.
  EXPECT_NEAR(tilted.duration(), std::asin((limit + 0.5) / (1.5 * limit)) / omega, 1e-15);
  const DrivenPhase slide = scene.phase(tilted.duration(), tilted.at_end());
  EXPECT_EQ(slide.kind(), Kind::sliding);
  EXPECT_TRUE(slide.is_parabola());
  // The surface of the body stays behind: friction pulls it forward along −a_G + a_S < 0.
  EXPECT_NEAR(slide.acceleration().x(), -0.5 - 0.1 * kGravity, 1e-15);
  EXPECT_GT(slide.duration(), 1e-3);
}

TEST(DrivenSlide, AcrossASlopeMatchesIntegration) {
  Scene scene = scene_with(0.5, 0.3);
  BodyState state = at_rest(scene);
  state.velocity = {0.5, 0.2, 0};
  state.angular_velocity = {20, -90, 3};
  for (const double slope : {0.5, 3.0, 6.0, 3.5 * 0.3 * kGravity, 11.0, 14.0}) {
    scene.downhill = {0, slope};
    const DrivenPhase phase = scene.phase(0, state);
    ASSERT_EQ(phase.kind(), Kind::sliding);
    const double friction = 3.5 * 0.3 * kGravity;
    EXPECT_EQ(std::isfinite(phase.duration()), slope < friction);
    const double t = std::min(0.9 * phase.duration(), 0.15);
    // h = 1e-5 s: the integrator's error is of order (h/t)⁴.
    const BodyState expected = integrated(scene, Kind::sliding, 0, state, t, 20000);
    const BodyState found = phase.at(t);
    expect_close(found.position, expected.position, 1e-12);
    expect_close(found.velocity, expected.velocity, 1e-11);
    expect_close(scene.ball.radius * found.angular_velocity,
                 scene.ball.radius * expected.angular_velocity, 1e-11);
    if (!std::isfinite(phase.duration())) continue;
    EXPECT_LE(slip_of(scene, phase.duration(), phase.at(phase.duration())).norm(), 1e-14);
    EXPECT_EQ(scene.phase(phase.duration(), phase.at_end()).kind(), Kind::rolling);
  }
}

TEST(DrivenSlide, OnAnOscillatingPlaneMatchesIntegration) {
  Scene scene = scene_with(0.3, 0.1);
  scene.downhill = {0.2, 0.5};
  scene.motion = SubstrateMotion::oscillation({0.004, 0.001}, 6, 0.7);
  BodyState state = at_rest(scene);
  state.velocity = {0.3, 0.4, 0};
  state.angular_velocity = {20, -50, 0};
  Follower follower{scene, 0, state};
  double slid = 0;
  follower.run(1, [&](const DrivenPhase& phase, double t) {
    if (phase.kind() == Kind::sliding && slid == t) slid = t + phase.duration();
  });
  // The slip comes close to zero and turns three times.
  EXPECT_LE(follower.phases, 120);
  ASSERT_GT(slid, 0.05);
  ASSERT_LT(slid, 0.5);
  Follower again{scene, 0, state};
  again.run(0.9 * slid);
  // Error of the integration: order 4 of h = 5e-6 s.
  const BodyState expected = integrated(scene, Kind::sliding, 0, state, 0.9 * slid, 20000);
  expect_close(again.state.position, expected.position, 1e-12);
  expect_close(again.state.velocity, expected.velocity, 1e-11);
  expect_close(scene.ball.radius * again.state.angular_velocity,
               scene.ball.radius * expected.angular_velocity, 1e-11);
}

TEST(DrivenSlide, AlongTheShakingIsAParabolaAndEndsWhereTheSlipDoes) {
  // u = u_0 − (v_S(t) − v_S(0)) − (1+A) μ_k g t; the centre feels a constant friction.
  Scene scene = scene_with(0.5, 0.1);
  const double X = 0.002, f = 8, omega = 2 * kPi * f;
  scene.motion = SubstrateMotion::oscillation({X, 0}, f, 0.4);
  BodyState state = at_rest(scene);
  state.velocity.x() += 0.2;
  const DrivenPhase phase = scene.phase(0, state);
  ASSERT_TRUE(phase.is_parabola());
  const double t = phase.duration();
  const double slip =
      0.2 - omega * X * (std::cos(omega * t + 0.4) - std::cos(0.4)) - 3.5 * 0.1 * kGravity * t;
  EXPECT_NEAR(slip, 0, 1e-15);
  EXPECT_NEAR(phase.acceleration().x(), -0.1 * kGravity, 1e-15);
}

TEST(DrivenPhase, AKinkOfTheSubstrateEndsThePhase) {
  Scene scene = scene_with(0.5, 0.1);
  scene.motion = SubstrateMotion::table({{0, {0, 0}}, {0.3, {0.03, 0}}, {1, {0.03, 0}}});
  const DrivenPhase before = scene.phase(0, at_rest(scene));
  ASSERT_EQ(before.kind(), Kind::resting);
  EXPECT_EQ(before.duration(), 0.3);
  EXPECT_DOUBLE_EQ(before.position_at(0.3).x(), 0.03);
  const DrivenPhase after = scene.phase(0.3, before.at_end());
  EXPECT_EQ(after.kind(), Kind::sliding);
  EXPECT_NEAR(after.duration(), 0.1 / (3.5 * 0.1 * kGravity), 1e-15);
}

TEST(DrivenPhase, OnALevelStillPlaneItIsSlideToRoll) {
  const Scene scene = scene_with(0.5, 0.1);
  BodyState state = at_rest(scene);
  state.velocity = {0.3, 0.1, 0};
  state.angular_velocity = {5, 40, 0};
  const SlideToRoll exact(scene.ball, 0.1, kGravity, state.velocity, state.angular_velocity);
  const DrivenPhase phase = scene.phase(0, state);
  EXPECT_NEAR(phase.duration(), exact.sliding_time, 1e-16);
  expect_close(phase.at_end().velocity, exact.rolling_velocity, 1e-16);
  expect_close(phase.at_end().position - state.position, exact.displacement, 1e-17);
}

TEST(DrivenPhase, FliesDownhillAndLands) {
  Scene scene = scene_with(0.5, 0.1);
  scene.downhill = {1, 0};
  BodyState state = at_rest(scene);
  state.velocity.z() = 0.5;
  const DrivenPhase phase = scene.phase(0, state);
  const double t = 1 / kGravity;
  EXPECT_NEAR(phase.duration(), t, 1e-16);
  EXPECT_NEAR(phase.at_end().position.x(), t * t / 2, 1e-16);
  EXPECT_EQ(phase.at_end().position.z(), scene.ball.radius);
}

TEST(DrivenPhase, DrillingRunsBesideTheSlide) {
  Scene scene = scene_with(0.5, 0.1);
  scene.downhill = {0, 1};
  scene.contact.drilling_length = 1e-5;
  BodyState state = at_rest(scene);
  state.velocity.x() = 1;
  state.angular_velocity.z() = -2;
  const DrivenPhase phase = scene.phase(0, state);
  EXPECT_NEAR(phase.duration(), 2 * 0.4 * 4e-6 / (1e-5 * kGravity), 1e-15);
  EXPECT_EQ(phase.at_end().angular_velocity.z(), 0);
}

TEST(DrivenPhase, RefusesWhatTheCvodeSolverAloneCanDo) {
  SubstrateContact contact;
  EXPECT_TRUE(DrivenPhase::can(contact));
  contact.coupled_radius = 1e-5;
  EXPECT_FALSE(DrivenPhase::can(contact));
  contact.coupled_radius = 0;
  contact.rolling_while_sliding = true;
  EXPECT_FALSE(DrivenPhase::can(contact));
}

}  // namespace
}  // namespace slipcheck
