// The rigid impulse of a cue, against the conservation laws and published formulas.

#include "physics/motion/cue_stroke.h"

#include <gtest/gtest.h>

#include <cmath>

namespace slipcheck {
namespace {

constexpr double kRounding = 1e-14;

Sphere pool_ball() { return {0.028575, 0.17, 0.4}; }

BodyState struck(const CueStroke& stroke, double impulse) {
  BodyState state;
  state.position.z() = pool_ball().radius;
  stroke.strike(pool_ball(), impulse, state);
  return state;
}

TEST(CueStroke, InTheCentreTheBallSlidesWithoutSpin) {
  const BodyState after = struck({}, 0.34);
  EXPECT_NEAR(after.velocity.x(), 2, kRounding);
  EXPECT_EQ(after.velocity.y(), 0);
  EXPECT_EQ(after.angular_velocity, Vector3::Zero());
}

TEST(CueStroke, AtTwoFifthsOfTheRadiusAboveItRollsAtOnce) {
  const Sphere ball = pool_ball();
  for (const double heading : {0.0, 1.0, 4.0}) {
    CueStroke stroke{.heading = {std::cos(heading), std::sin(heading)}};
    stroke.up = 0.4 * ball.radius;
    const BodyState after = struck(stroke, 0.3);
    EXPECT_NEAR(slip_velocity(after, ball).norm(), 0, kRounding);
    EXPECT_NEAR(after.velocity.head<2>().dot(stroke.heading), 0.3 / 0.17, kRounding);
  }
}

TEST(CueStroke, OnTheRightItSpinsCounterclockwiseFromAbove) {
  const Sphere ball = pool_ball();
  CueStroke stroke;
  stroke.right = 0.3 * ball.radius;
  const BodyState after = struck(stroke, 0.34);
  // ω = a J/I.
  EXPECT_NEAR(after.angular_velocity.z(), stroke.right * 0.34 / ball.moment_of_inertia(), 1e-11);
  EXPECT_EQ(after.angular_velocity.head<2>(), Vector2::Zero());
}

TEST(CueStroke, AngularMomentumAboutTheTipIsKept) {
  // The impulse acts there, so that I ΔΩ = r × m Δv whatever its line.
  const Sphere ball = pool_ball();
  CueStroke stroke{.heading = {0.6, 0.8}, .elevation = 0.5};
  stroke.right = -0.2 * ball.radius;
  stroke.up = 0.3 * ball.radius;
  const BodyState after = struck(stroke, 0.4);
  const Vector3 d = stroke.direction(), s(0.8, -0.6, 0), w = s.cross(d);
  const double depth =
      std::sqrt(ball.radius * ball.radius - stroke.right * stroke.right - stroke.up * stroke.up);
  const Vector3 tip = stroke.right * s + stroke.up * w - depth * d;
  EXPECT_NEAR(tip.norm(), ball.radius, kRounding);
  const Vector3 lost =
      ball.moment_of_inertia() * after.angular_velocity - tip.cross(ball.mass * after.velocity);
  EXPECT_NEAR(lost.norm(), 0, 1e-16);
}

TEST(CueStroke, LeckieAndGreenspansCoordinatesOfTheTipGiveTheirMotion) {
  // A cue along −y in their frame, tip at (a, c, b) with the vertical b:
  // v = F/m (0, −cos θ, −sin θ), ω = F/I (−c sin θ + b cos θ, a sin θ, −a cos θ).
  const Sphere ball = pool_ball();
  const double R = ball.radius, theta = 0.35, a = 0.25 * R, b = 0.3 * R, F = 0.2;
  const double c = std::sqrt(R * R - a * a - b * b);
  // Seen along the cue, −y, their +x is on the left.
  CueStroke stroke{.heading = {0, -1}, .elevation = theta};
  stroke.right = -a;
  stroke.up = b * std::cos(theta) - c * std::sin(theta);
  const BodyState after = struck(stroke, F);
  const double I = ball.moment_of_inertia();
  const Vector3 v = F / ball.mass * Vector3(0, -std::cos(theta), -std::sin(theta));
  const Vector3 omega = F / I *
                        Vector3(-c * std::sin(theta) + b * std::cos(theta), a * std::sin(theta),
                                -a * std::cos(theta));
  EXPECT_NEAR((after.velocity - v).norm(), 0, kRounding);
  EXPECT_NEAR((after.angular_velocity - omega).norm(), 0, 1e-12 * omega.norm());
}

TEST(CueStroke, WithoutLossTheEnergyOfCueAndBallStays) {
  const Sphere ball = pool_ball();
  const double V = 3, M = 0.54;
  CueStroke stroke{.elevation = 0.2};
  stroke.right = 0.2 * ball.radius;
  stroke.up = -0.35 * ball.radius;
  const double J = stroke.impulse(ball, V, M, 1);
  const BodyState after = struck(stroke, J);
  const double cue = V - J / M;
  const double energy = 0.5 * (M * cue * cue + ball.mass * after.velocity.squaredNorm() +
                               ball.moment_of_inertia() * after.angular_velocity.squaredNorm());
  EXPECT_NEAR(energy / (0.5 * M * V * V), 1, 1e-13);
}

TEST(CueStroke, TheTipPartsWithItsRestitution) {
  const Sphere ball = pool_ball();
  const double V = 2, M = 0.6, e = 0.7;
  CueStroke stroke;
  stroke.right = 0.3 * ball.radius;
  stroke.up = 0.2 * ball.radius;
  const double J = stroke.impulse(ball, V, M, e);
  const BodyState after = struck(stroke, J);
  const double depth =
      std::sqrt(ball.radius * ball.radius - stroke.right * stroke.right - stroke.up * stroke.up);
  const Vector3 tip(-depth, -stroke.right, stroke.up);  // heading x
  const double of_ball = (after.velocity + after.angular_velocity.cross(tip)).x();
  EXPECT_NEAR(of_ball - (V - J / M), e * V, 1e-13);
}

TEST(CueStroke, ATipSlipsOffWhereItsAngleToTheNormalIsBeyondThatOfFriction) {
  // sin φ = b/R where tan φ = μ.
  EXPECT_NEAR(largest_offset(0.6), std::sin(std::atan(0.6)), 1e-15);
  EXPECT_EQ(largest_offset(0), 0);
}

}  // namespace
}  // namespace slipcheck
