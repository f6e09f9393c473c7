#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "driven_scene.h"

namespace slipcheck {
namespace {

using namespace test;

/// The laws in integrated form over a phase, by five-point Gauss quadrature on panels as short as
/// the direction of the friction asks for.
void expect_laws(const Scene& scene, const DrivenPhase& phase, double time, double span,
                 double tolerance) {
  constexpr std::array kAt{0.0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array kWeight{0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  Vector3 velocity = Vector3::Zero(), way = Vector3::Zero(), turn = Vector3::Zero();
  const double largest =
      scene.motion.largest_acceleration() + scene.downhill.norm() +
      (1 + scene.ball.inverse_shape_factor()) * scene.contact.kinetic_friction * kGravity;
  const auto speed_at = [&](double t) {
    const BodyState now = phase.at(t);
    if (phase.kind() == Kind::sliding) return slip_of(scene, time + t, now).norm();
    return (now.velocity - scene.motion.velocity(time + t)).norm();
  };
  // What begins from zero is at first lost in the rounding of the velocities it is the difference
  // of, and its direction with it.
  const bool begins = speed_at(0) < 1e-12;
  const double first = begins ? 2e-3 * span : 0;
  double begin = first;
  while (begin < span) {
    double panel = std::min(span / 16, 0.3 * speed_at(begin) / largest);
    const double least = begins ? std::min(0.2 * begin, span / 100) : 1e-7 * span;
    panel = std::min(std::max(panel, least), span - begin);
    const double half = 0.5 * panel, middle = begin + half;
    begin = span - begin - panel < 1e-9 * span ? span : begin + panel;
    for (int k = -2; k <= 2; ++k) {
      const auto index = static_cast<std::size_t>(std::abs(k));
      const double t = middle + (k < 0 ? -half : half) * kAt[index];
      const double weight = half * kWeight[index];
      const BodyState s = phase.at(t);
      const Rates r = rates(scene, phase.kind(), time + t, s);
      EXPECT_LE(r.acceleration.norm(), phase.largest_acceleration() * (1 + 1e-6) + 1e-9);
      velocity += weight * r.acceleration;
      way += weight * s.velocity;
      turn += weight * r.angular_acceleration;
    }
  }
  const BodyState start = phase.at(first), end = phase.at(span);
  expect_close(end.velocity - start.velocity, velocity, tolerance);
  expect_close(end.position - start.position, way, tolerance);
  turn.z() = end.angular_velocity.z() - start.angular_velocity.z();
  expect_close(scene.ball.radius * (end.angular_velocity - start.angular_velocity),
               scene.ball.radius * turn, tolerance);
}

/// What sticks may stick, and what rests is held.
void expect_hold(const Scene& scene, const DrivenPhase& phase, double time, double span) {
  if (phase.kind() != Kind::rolling && phase.kind() != Kind::resting) return;
  const double A = scene.ball.inverse_shape_factor();
  for (int k = 0; k <= 20; ++k) {
    const double t = k * span / 20;
    const double load = (scene.downhill - scene.motion.acceleration(time + t).head<2>()).norm();
    // Beyond the limit by the margin of rounding and that of the time, ω ε t.
    EXPECT_LE(load, (1 + A) * scene.contact.static_friction * kGravity * (1 + 1e-9) + 1e-12);
    if (phase.kind() != Kind::resting) continue;
    EXPECT_LE(A / (1 + A) * load, scene.contact.rolling(0) * kGravity * (1 + 1e-9) + 1e-12);
  }
}

Scene random_scene(std::mt19937_64& random, int n) {
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<>(a, b)(random);
  };
  Scene scene;
  scene.ball = {uniform(0.001, 0.02), 1, uniform(0.2, 1)};
  const double mu = uniform(0.02, 0.4);
  scene.contact.kinetic_friction = mu;
  scene.contact.static_friction = n % 3 == 0 ? mu : mu * uniform(1, 2);
  if (n % 4 == 1) scene.contact.rolling = RollingFriction(uniform(0.001, 0.05));
  if (n % 4 == 2)
    scene.contact.rolling = RollingFriction(
        {{0, uniform(0, 0.03)}, {uniform(0.01, 0.05), uniform(0, 0.03)}, {0.2, 0.02}});
  const double f = uniform(1, 50), strength = uniform(0.1, 8) * mu * kGravity;
  const double X = strength / std::pow(2 * kPi * f, 2), angle = uniform(0, 6);
  if (n % 5 != 0)
    scene.motion =
        SubstrateMotion::oscillation({X * std::cos(angle), X * std::sin(angle)}, f, uniform(0, 6));
  const double slope = uniform(0, 4) * mu * kGravity;
  if (n % 2 == 0) scene.downhill = {slope, 0};
  if (n % 10 == 5)
    scene.motion = SubstrateMotion::table(
        {{0.1, {0, 0}}, {0.2, {uniform(-0.1, 0.1), 0.02}}, {0.5, {0.1, uniform(-0.1, 0.1)}}});
  if (n % 11 == 3) scene.contact.drilling_length = 1e-4 * scene.ball.radius;
  return scene;
}

TEST(DrivenPhase, RandomBodiesObeyTheLawsAndNeverChatter) {
  std::mt19937_64 random(1);
  std::normal_distribution<> gauss;
  constexpr double kSpeed = 0.2;
  for (int n = 0; n < 300; ++n) {
    const Scene scene = random_scene(random, n);
    BodyState state = at_rest(scene);
    if (n % 7 != 0) {
      state.velocity += kSpeed * Vector3(gauss(random), gauss(random), 0);
      state.angular_velocity =
          kSpeed / scene.ball.radius * Vector3(gauss(random), gauss(random), gauss(random));
    }
    const bool shaken = scene.motion.kind() == SubstrateMotion::Kind::oscillation;
    const double end = shaken ? 6 / scene.motion.frequency() : 1;
    Follower follower{scene, 0, state};
    BodyState last = state;
    follower.run(end, [&](const DrivenPhase& phase, double time) {
      EXPECT_GT(phase.duration(), 0);
      const double scale = last.velocity.norm() + scene.motion.largest_speed() + 0.1;
      // Only what a phase takes for rounding may be dropped between phases.
      expect_close(phase.start().velocity, last.velocity, 1e-13 * scale);
      expect_close(scene.ball.radius * phase.start().angular_velocity,
                   scene.ball.radius * last.angular_velocity, 1e-13 * scale);
      const double whole = std::min(phase.duration(), end - time);
      expect_hold(scene, phase, time, whole);
      // The quadrature sets the tolerance: it cannot follow a direction at the very end of a slide
      // and follows one that turns at a near stop to 1e-10.
      if ((follower.phases + n) % 3 == 0 && whole > 1e-7)
        expect_laws(scene, phase, time, 0.5 * whole, 1e-9 * scale);
      last = phase.duration() < end - time ? phase.at_end() : phase.at(whole);
    });
    EXPECT_EQ(follower.time, end);
    // Twelve swings, each with a slide that begins, turns and ends, some thirty pieces long.
    EXPECT_LE(follower.phases, 600);
    EXPECT_LE(follower.longest_standstill, 1);
    ASSERT_FALSE(HasFailure()) << "scene " << n;
  }
}

/// What a collision does to a phase: it cuts it anywhere. The motion goes on as if it had not.
TEST(DrivenPhase, CutAnywhereItGoesOnTheSame) {
  std::mt19937_64 random(2);
  for (int n = 0; n < 100; ++n) {
    const Scene scene = random_scene(random, n);
    BodyState state = at_rest(scene);
    state.velocity += Vector3(0.2, 0.1, 0);
    const double end = scene.motion.kind() == SubstrateMotion::Kind::oscillation
                           ? 2 / scene.motion.frequency()
                           : 0.6;
    Follower whole{scene, 0, state}, cut{scene, 0, state};
    whole.run(end);
    while (cut.time < end)
      cut.run(std::min(end, cut.time + std::uniform_real_distribution<>(0, 0.02)(random)));
    // Rolling friction that falls with the speed lets errors of 1e-13 grow a little; a slip near
    // zero that turns leaves with them too.
    const double scale = state.velocity.norm() + whole.state.velocity.norm() + 0.1;
    expect_close(cut.state.velocity, whole.state.velocity, 1e-11 * scale);
    expect_close(cut.state.position, whole.state.position, 1e-11 * scale);
    ASSERT_FALSE(HasFailure()) << "scene " << n;
  }
}

}  // namespace
}  // namespace slipcheck
