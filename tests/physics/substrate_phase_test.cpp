#include "physics/motion/substrate_phase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../support/runge_kutta.h"

namespace slipcheck {
namespace {

using Kind = SubstratePhase::Kind;
constexpr double kGravity = 9.81;

Sphere steel_ball() { return {0.002, 2.6e-4, 0.4}; }

SubstrateContact rough(double static_friction = 0.5, double kinetic = 0.1) {
  SubstrateContact contact;
  contact.static_friction = static_friction;
  contact.kinetic_friction = kinetic;
  return contact;
}

void expect_close(const Vector3& a, const Vector3& b, double tolerance) {
  EXPECT_LE((a - b).norm(), tolerance) << a.transpose() << " against " << b.transpose();
}

/// Newton and Euler for a sphere under Coulomb friction, K (18), written with forces and torques.
test::Rates sliding_rates(const Sphere& ball, double mu, const BodyState& s) {
  const Vector3 lever = -ball.radius * Vector3::UnitZ();
  const Vector3 slip = s.velocity + s.angular_velocity.cross(lever);
  const Vector3 force = -mu * ball.mass * kGravity * slip.normalized();
  return {force / ball.mass, lever.cross(force) / ball.moment_of_inertia()};
}

TEST(SlidingPhase, ObliqueSlideMatchesIntegration) {
  const Sphere ball = steel_ball();
  BodyState state;
  state.position = {0.1, -0.2, ball.radius};
  state.velocity = {0.2, 0.05, 0};
  state.angular_velocity = {30, -80, 0};
  const SubstratePhase phase(ball, rough(), kGravity, state);
  ASSERT_EQ(phase.kind(), Kind::sliding);
  // Up to 90 % of the slide: the integrator's error there is of order h⁴ and below 1e-12.
  const double t = 0.9 * phase.duration();
  const BodyState expected = test::integrate(
      state, t, 2000, [&](double, const BodyState& s) { return sliding_rates(ball, 0.1, s); });
  const BodyState found = phase.at(t);
  expect_close(found.position, expected.position, 1e-14);
  expect_close(found.velocity, expected.velocity, 1e-13);
  expect_close(found.angular_velocity, expected.angular_velocity, 1e-10);
}

TEST(SlidingPhase, EndsWithoutSlipAndGoesOnRolling) {
  const Sphere ball{0.03, 0.2, 2.0 / 3};
  BodyState state;
  state.position.z() = ball.radius;
  state.velocity = {1, 2, 0};
  const SubstratePhase phase(ball, rough(), kGravity, state);
  // t = |u|/((1+A) μ g) with A = 3/2.
  EXPECT_NEAR(phase.duration(), std::sqrt(5.0) / (2.5 * 0.1 * kGravity), 1e-15);
  const BodyState end = phase.at_end();
  EXPECT_LE(slip_velocity(end, ball.radius).norm(), 1e-15);
  const SubstratePhase next(ball, rough(), kGravity, end);
  EXPECT_EQ(next.kind(), Kind::rolling);
  EXPECT_EQ(next.duration(), std::numeric_limits<double>::infinity());
}

TEST(SlidingPhase, WithoutKineticFrictionItNeverEnds) {
  BodyState state;
  state.position.z() = 0.002;
  state.velocity.x() = 1;
  const SubstratePhase phase(steel_ball(), rough(0, 0), kGravity, state);
  EXPECT_EQ(phase.kind(), Kind::sliding);
  EXPECT_EQ(phase.duration(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(phase.at(3).position.x(), 3);
}

TEST(RollingPhase, ConstantFrictionStopsAtVSquaredOverTwoMuG) {
  SubstrateContact contact = rough();
  contact.rolling = RollingFriction(0.01);
  BodyState state;
  state.position.z() = 0.002;
  state.velocity = {0.3, 0.4, 0};
  state.angular_velocity = rolling_angular_velocity(state.velocity, 0.002);
  const SubstratePhase phase(steel_ball(), contact, kGravity, state);
  ASSERT_EQ(phase.kind(), Kind::rolling);
  EXPECT_NEAR(phase.duration(), 0.5 / (0.01 * kGravity), 1e-14);
  const BodyState end = phase.at_end();
  EXPECT_NEAR(end.position.norm(), 0.25 / (2 * 0.01 * kGravity), 1e-5);  // z is there too
  expect_close(end.velocity, Vector3::Zero(), 0);
  EXPECT_TRUE(SubstratePhase(steel_ball(), contact, kGravity, end).is_at_rest());
}

/// Rolls through the whole table by phases and compares with integration of v̇ = −μ_r(v) g v̂.
void expect_table_matches(const RollingFriction& friction, double speed, double duration) {
  SubstrateContact contact = rough();
  contact.rolling = friction;
  const Sphere ball = steel_ball();
  BodyState state;
  state.position.z() = ball.radius;
  state.velocity = {speed, 0, 0};
  state.angular_velocity = rolling_angular_velocity(state.velocity, ball.radius);
  const BodyState start = state;
  double left = duration;
  for (int n = 0; n < 10; ++n) {
    const SubstratePhase phase(ball, contact, kGravity, state);
    if (phase.duration() >= left) {
      state = phase.at(left);
      break;
    }
    left -= phase.duration();
    state = phase.at_end();
  }
  const BodyState expected =
      test::integrate(start, duration, 20000, [&](double, const BodyState& s) {
        const double v = s.velocity.norm();
        return test::Rates{-friction(v) * kGravity / v * s.velocity, Vector3::Zero()};
      });
  // The kinks of the table cost the integrator its order: h² times the jump of the slope.
  expect_close(state.position, expected.position, 1e-9);
  expect_close(state.velocity, expected.velocity, 1e-9);
}

TEST(RollingPhase, RisingAndFallingTablesMatchIntegration) {
  expect_table_matches(RollingFriction({{0, 0.002}, {0.2, 0.01}, {0.5, 0.004}}), 0.6, 6.0);
  expect_table_matches(RollingFriction({{0, 0.02}, {1, 0.005}}), 0.8, 5.0);
}

TEST(RollingPhase, FrictionThatVanishesWithTheSpeedNeverStopsTheBody) {
  SubstrateContact contact = rough();
  contact.rolling = RollingFriction({{0, 0}, {1, 0.01}});
  BodyState state;
  state.position.z() = 0.002;
  state.velocity.x() = 0.5;
  state.angular_velocity = rolling_angular_velocity(state.velocity, 0.002);
  const SubstratePhase phase(steel_ball(), contact, kGravity, state);
  EXPECT_EQ(phase.duration(), std::numeric_limits<double>::infinity());
  // v = v0 exp(−g t/100).
  EXPECT_NEAR(phase.at(20).velocity.x(), 0.5 * std::exp(-kGravity * 0.2), 1e-15);
}

TEST(Drilling, StopsAfterSpinTimesInertiaOverTorque) {
  SubstrateContact contact = rough();
  contact.drilling_length = 2.0 / 3 * 0.1 * 1e-4;
  const Sphere ball = steel_ball();
  BodyState state;
  state.position.z() = ball.radius;
  state.angular_velocity = {0, 0, -50};
  const SubstratePhase phase(ball, contact, kGravity, state);
  EXPECT_EQ(phase.kind(), Kind::resting);
  const double torque = contact.drilling_length * ball.mass * kGravity;
  EXPECT_NEAR(phase.duration(), 50 * ball.moment_of_inertia() / torque, 1e-12);
  EXPECT_EQ(phase.at_end().angular_velocity.z(), 0);
  EXPECT_NEAR(phase.at(phase.duration() / 2).angular_velocity.z(), -25, 1e-12);
}

TEST(Drilling, LeavesTheSlidingAlone) {
  SubstrateContact contact = rough();
  BodyState state;
  state.position.z() = 0.002;
  state.velocity.x() = 0.3;
  const SubstratePhase without(steel_ball(), contact, kGravity, state);
  contact.drilling_length = 1e-5;
  state.angular_velocity.z() = 1e6;
  const SubstratePhase with(steel_ball(), contact, kGravity, state);
  EXPECT_EQ(with.duration(), without.duration());
  expect_close(with.at_end().velocity, without.at_end().velocity, 0);
}

TEST(FlyingPhase, LandsAtTheRootWithoutCancellation) {
  BodyState state;
  state.position.z() = 0.002;
  state.velocity = {0.1, 0, 0.005};
  const SubstratePhase jump(steel_ball(), rough(), kGravity, state);
  ASSERT_EQ(jump.kind(), Kind::flying);
  EXPECT_NEAR(jump.duration(), 2 * 0.005 / kGravity, 1e-18);  // t^z of K App. F
  EXPECT_EQ(jump.at_end().position.z(), 0.002);
  EXPECT_NEAR(jump.at_end().velocity.z(), -0.005, 1e-17);

  // A long way above, thrown downwards: 1 m, 3 m/s.
  state.position.z() = 1.002;
  state.velocity.z() = -3;
  const SubstratePhase thrown(steel_ball(), rough(), kGravity, state);
  EXPECT_NEAR(thrown.duration(), (-3 + std::sqrt(9 + 2 * kGravity)) / kGravity, 1e-15);
}

TEST(FlyingPhase, AConfinedBodyNeverFlies) {
  BodyState state;
  state.position.z() = 0.002;
  state.velocity = {0.1, 0, 0.005};
  EXPECT_TRUE(SubstratePhase(steel_ball(), rough(), kGravity, state, true).is_supported());
}

TEST(SubstrateImpulse, EqualsTheSameImpulseSpreadOverASlide) {
  // A push F for a time t along a slide gives the impulse J = F t: the velocities after it are
  // those after sliding under the normal force J/t, with gravity playing F/m.
  const Sphere ball = steel_ball();
  BodyState state;
  state.position.z() = ball.radius;
  state.velocity = {0.3, -0.1, 0};
  state.angular_velocity = {5, 7, 0};
  const SubstratePhase slide(ball, rough(), kGravity, state);
  const double t = 0.4 * slide.duration();
  BodyState pushed = state;
  apply_substrate_impulse(ball, rough(), ball.mass * kGravity * t, pushed);
  expect_close(pushed.velocity, slide.at(t).velocity, 1e-16);
  expect_close(pushed.angular_velocity, slide.at(t).angular_velocity, 1e-13);
}

TEST(SubstrateImpulse, WhatIsLeftAfterStickingGoesIntoRollingFriction) {
  const Sphere ball = steel_ball();
  SubstrateContact contact = rough();
  contact.rolling = RollingFriction(0.01);
  BodyState state;
  state.position.z() = ball.radius;
  state.velocity = {0.3, 0, 0};
  const SubstratePhase slide(ball, contact, kGravity, state);
  const SubstratePhase roll(ball, contact, kGravity, slide.at_end());
  const double t_roll = 0.5;
  BodyState pushed = state;
  apply_substrate_impulse(ball, contact, ball.mass * kGravity * (slide.duration() + t_roll),
                          pushed);
  expect_close(pushed.velocity, roll.at(t_roll).velocity, 1e-16);
}

TEST(Landing, ReboundsWithRestitutionAndRubsWithItsImpulse) {
  const Sphere ball = steel_ball();
  SubstrateContact contact = rough();
  contact.restitution = 0.5;
  BodyState state;
  state.position.z() = ball.radius;
  state.velocity = {1, 0, -0.4};
  land(ball, contact, 0, state);
  EXPECT_DOUBLE_EQ(state.velocity.z(), 0.2);
  // Sliding throughout: μ m (1 + e) |v_z|.
  EXPECT_DOUBLE_EQ(state.velocity.x(), 1 - 0.1 * 0.6);
  BodyState slow = state;
  slow.velocity.z() = -1e-9;
  land(ball, contact, 1e-6, slow);
  EXPECT_EQ(slow.velocity.z(), 0);
}

}  // namespace
}  // namespace slipcheck
