#include "reference/events/event_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "../scenes.h"
#include "../support/runge_kutta.h"
#include "physics/closed_forms.h"
#include "physics/numbers.h"
#include "scene/ode.h"

namespace slipcheck {
namespace {

const RunEnd kRolling{Run::Until::rolling, 0, 10};
const RunEnd kRest{Run::Until::rest, 0, 100};

/// Keeps every frame.
struct Recorder final : FrameSink {
  void take(double time, const Frame& frame) override {
    times.push_back(time);
    frames.push_back(frame);
  }
  std::vector<double> times;
  std::vector<Frame> frames;
};

TEST(EventSolver, SymmetricPairEndsAsTheClosedFormSays) {
  for (double e : {0.5, 0.7, 0.9, 1.0}) {
    const Scene scene = test::head_on(0.15, -0.15, e);
    EventSolver solver(scene, scene.initial);
    Recorder seen;
    const SolvedRun run = solver.run(kRolling, &seen);
    ASSERT_TRUE(run.reached) << run.reason;
    EXPECT_EQ(run.collisions, 1u);
    const double t_collision = (0.01 - 0.004) / 0.3;
    const double slide = 0.15 * (1 + e) / (3.5 * 0.1 * 9.81);
    // 1e-14: a few roundings of numbers of order 0.1.
    EXPECT_NEAR(run.end_time, t_collision + slide, 1e-14);
    const double v = HeadOnCollision{2.5, e, 0}.rolling_velocity(0.15, -0.15);
    EXPECT_NEAR(solver.states()[0].velocity.x(), v, 1e-14);
  }
}

TEST(EventSolver, FramesComeBeforeAndAfterEachEvent) {
  const Scene scene = test::head_on(0.15, -0.15, 0.9);
  EventSolver solver(scene, scene.initial);
  Recorder seen;
  solver.run(kRolling, &seen);
  // Start, before and after the collision, two ends of sliding at one instant.
  ASSERT_EQ(seen.times.size(), 5u);
  EXPECT_EQ(seen.times[1], seen.times[2]);
  EXPECT_GT(seen.frames[1].bodies[0].velocity.x(), 0);
  EXPECT_LT(seen.frames[2].bodies[0].velocity.x(), 0);
  ASSERT_EQ(seen.frames[2].touches.size(), 3u);  // the pair, and both with the substrate
  EXPECT_EQ(seen.frames[2].touches[0].second, 1);
}

/// Two balls by small steps: semi-implicit Euler with hard collisions where they overlap. Its error
/// is of first order in the step and vanishes with it; shares nothing with the solver.
std::vector<BodyState> stepped(const Scene& scene, double end, double h) {
  std::vector<BodyState> s = scene.initial;
  const auto n_steps = static_cast<long>(std::llround(end / h));
  const double R = scene.bodies[0].radius, A = scene.bodies[0].inverse_shape_factor();
  for (long n = 0; n < n_steps; ++n) {
    for (std::size_t i = 0; i < s.size(); ++i) {
      const SubstrateContact& c = scene.on_substrate(i);
      const Vector3 u = s[i].velocity + R * Vector3::UnitZ().cross(s[i].angular_velocity);
      const double most = c.kinetic_friction * scene.gravity * h;
      if (u.norm() > (1 + A) * most) {
        s[i].velocity -= most * u.normalized();
        s[i].angular_velocity += A / R * most * Vector3::UnitZ().cross(u.normalized());
      } else {
        s[i].velocity -= u / (1 + A);
        s[i].angular_velocity += A / R / (1 + A) * Vector3::UnitZ().cross(u);
        const double v = s[i].velocity.norm();
        if (v > 0) s[i].velocity *= std::max(0.0, 1 - c.rolling(v) * scene.gravity * h / v);
        s[i].angular_velocity = Vector3::UnitZ().cross(s[i].velocity) / R;
      }
      s[i].position += h * s[i].velocity;
    }
    const Vector3 d = s[0].position - s[1].position;
    const Vector3 n_ij = d.normalized();
    const double g = n_ij.dot(s[0].velocity - s[1].velocity);
    if (d.norm() <= 2 * R && g < 0) {
      const double e = std::get<double>(scene.between(0, 1).restitution);
      s[0].velocity -= 0.5 * (1 + e) * g * n_ij;
      s[1].velocity += 0.5 * (1 + e) * g * n_ij;
    }
  }
  return s;
}

TEST(EventSolver, ObliqueCollisionWithRollingFrictionMatchesSmallSteps) {
  Scene scene = test::steel_scene(2);
  scene.substrate[0].rolling = RollingFriction({{0, 0.004}, {0.2, 0.02}, {0.4, 0.01}});
  scene.initial = {test::rolling_at(-0.02, 0.001, 0.3, 0), test::rolling_at(0, 0, -0.1, 0.05)};
  const double end = 0.6;
  EventSolver solver(scene, scene.initial);
  const SolvedRun run = solver.run(until_time(end), nullptr);
  ASSERT_EQ(run.collisions, 1u);
  const std::vector<BodyState> found = solver.states();
  // The steps see the collision up to h late; the line of centres has then turned by up to
  // v_rel h/(2R), and both velocities' normal parts (1 + e) v_rel with it.
  const double h = 1e-6;
  const double v_rel = (scene.initial[0].velocity - scene.initial[1].velocity).norm();
  const double velocity_error = 1.9 * v_rel * v_rel * h / 0.004;
  const auto expected = stepped(scene, end, h);
  for (std::size_t i : {0u, 1u}) {
    EXPECT_LE((found[i].velocity - expected[i].velocity).norm(), velocity_error) << i;
    EXPECT_LE((found[i].position - expected[i].position).norm(), velocity_error * end) << i;
  }
}

TEST(EventSolver, CollisionOnASpeedDependentRollPathIsFoundWhereItIs) {
  // A ball that slows down on a sloping table towards one at rest: the time is the root of
  // x(t) = gap with x from an independent integration.
  Scene scene = test::steel_scene(2);
  scene.substrate[0].rolling = RollingFriction({{0, 0.001}, {1, 0.05}});
  scene.initial = {test::rolling_at(-0.1, 0, 0.5, 0), test::rolling_at(0, 0, 0, 0)};
  const double t = EventSolver(scene, scene.initial).first_contact(10);
  const BodyState reached =
      test::integrate(scene.initial[0], t, 4000, [&](double, const BodyState& s) {
        const double v = s.velocity.norm();
        return test::Rates{-(0.001 + 0.049 * v) * 9.81 / v * s.velocity, Vector3::Zero()};
      });
  EXPECT_NEAR(reached.position.x(), -0.004, 1e-14);  // the integrator's h⁴ is below rounding
}

TEST(EventSolver, BallThatStopsShortOfAnotherDoesNotCollide) {
  Scene scene = test::steel_scene(2);
  scene.substrate[0].rolling = RollingFriction(0.05);
  // It rolls v²/(2 μ_r g) = 0.0917 m of the 0.096 m to the contact.
  scene.initial = {test::rolling_at(-0.1, 0, 0.3, 0), test::rolling_at(0, 0, 0, 0)};
  EventSolver solver(scene, scene.initial);
  EXPECT_EQ(solver.next_collision(10, 0), kNever);
  const SolvedRun run = solver.run(kRest, nullptr);
  EXPECT_TRUE(run.reached);
  EXPECT_EQ(run.collisions, 0u);
  EXPECT_NEAR(run.end_time, 0.3 / (0.05 * 9.81), 1e-14);
}

TEST(EventSolver, BallThatSlowsDownForEverNeverReachesAnother) {
  // μ_r = c v: v falls as e^(−c g t), the ball ends v/(c g) = 2 cm on, 8 cm short.
  Scene scene = test::steel_scene(2);
  scene.substrate[0].rolling = RollingFriction({{0, 0}, {1, 0.05}});
  scene.initial = {test::rolling_at(-0.1, 0, 0.01, 0), test::rolling_at(0, 0, 0, 0)};
  EventSolver solver(scene, scene.initial);
  EXPECT_EQ(solver.next_collision(1000, 0), kNever);
  ASSERT_TRUE(solver.run(until_time(10), nullptr).reached);
  const double decay = 0.05 * 9.81;
  // Rounding of numbers of order 0.1.
  EXPECT_NEAR(solver.states()[0].position.x(), -0.1 - 0.01 / decay * std::expm1(-10 * decay),
              1e-16);
}

TEST(EventSolver, RollingRunDoesNotEndBeforeTheLastCollision) {
  // Both roll from the start; they must still meet.
  const Scene scene = test::head_on(0.01, -0.01, 0.9, 0.5);
  EventSolver solver(scene, scene.initial);
  EXPECT_NEAR(solver.next_collision(1000, 0), (1 - 0.004) / 0.02, 1e-10);
  RunEnd end = kRolling;
  end.limit = 1000;
  EXPECT_EQ(solver.run(end, nullptr).collisions, 1u);
}

TEST(EventSolver, RunThatCannotEndSaysWhy) {
  Scene scene = test::steel_scene(1);
  scene.substrate[0].kinetic_friction = 0;
  scene.initial[0].velocity.x() = 1;
  EventSolver solver(scene, scene.initial);
  const SolvedRun run = solver.run(kRolling, nullptr);
  EXPECT_FALSE(run.reached);
  EXPECT_EQ(run.reason, "a body still slides or flies, or collides again, at the limit");
  EXPECT_EQ(run.end_time, 10);
}

TEST(EventSolver, ZeroLengthRunAndRunToATime) {
  const Scene scene = test::head_on(0.15, -0.15, 0.9);
  EventSolver at_once(scene, scene.initial);
  EXPECT_TRUE(at_once.run(until_time(0), nullptr).reached);
  EXPECT_EQ(at_once.states()[0].position.x(), -0.005);
  EventSolver later(scene, scene.initial);
  later.run(until_time(0.01), nullptr);
  EXPECT_DOUBLE_EQ(later.states()[0].position.x(), -0.005 + 0.0015);
}

TEST(EventSolver, InelasticCollapseEndsAndIsCounted) {
  // e_n < 1/A: the spins drive the balls together again and again.
  const Scene scene = test::head_on(0.15, -0.15, 0.2);
  EventSolver solver(scene, scene.initial);
  const SolvedRun run = solver.run(kRolling, nullptr);
  EXPECT_TRUE(run.reached) << run.reason;
  EXPECT_GT(run.collapses, 0u);
  // Momentum is zero and the spins are spent: both end at rest, up to the collapse speed.
  EXPECT_NEAR(solver.states()[0].velocity.x(), 0, 1e-6);
  // They never went through each other.
  EXPECT_GE((solver.states()[0].position - solver.states()[1].position).norm(), 0.004 - 1e-12);
}

TEST(EventSolver, EventLimitIsAnErrorNotALoop) {
  // Nothing keeps the collapse finite: the spins press the balls together at one instant.
  const Scene scene = test::head_on(0.15, -0.15, 0.0);
  EventSettings settings;
  settings.collapse_fraction = 0;
  settings.burst = 100;
  EventSolver solver(scene, scene.initial, settings);
  const SolvedRun run = solver.run(kRolling, nullptr);
  EXPECT_FALSE(run.reached);
  EXPECT_EQ(run.reason,
            "more than 1e+07 events for each body and second at 0.02 s: inelastic collapse; "
            "run.collapse or run.most_events decides what then happens");
}

TEST(EventSolver, BouncingBallFollowsTheGeometricSeries) {
  Scene scene = test::steel_scene(1);
  scene.substrate[0].restitution = 0.5;
  scene.initial[0].position.z() = 0.002 + 0.1;
  EventSolver solver(scene, scene.initial);
  const SolvedRun run = solver.run(kRest, nullptr);
  ASSERT_TRUE(run.reached);
  // t = sqrt(2h/g) (1 + 2 Σ e^n) = sqrt(2h/g) (1 + e)/(1 − e); the bounces that the cut-off drops
  // last 1e-10 of it.
  EXPECT_NEAR(run.end_time, std::sqrt(0.2 / 9.81) * 3, 1e-9);
}

TEST(EventSolver, StrikerIsLiftedFliesAndLandsWhereTheBallisticsSay) {
  // K App. F: the struck ball is pressed down, the striker lifted.
  Scene scene = test::head_on(0.3, 0, 0.9);
  scene.pairs[0].friction = 0.05;
  scene.pairs[0].tangential_restitution = 0;
  EventSolver solver(scene, scene.initial);
  Recorder seen;
  ASSERT_TRUE(solver.run(kRolling, &seen).reached);
  // Sliding contact throughout: v^z = μ (1 + e) v/2.
  const double lift = 0.05 * 1.9 * 0.3 / 2;
  EXPECT_NEAR(seen.frames[2].bodies[0].velocity.z(), lift, 1e-15);
  EXPECT_EQ(seen.frames[2].bodies[1].velocity.z(), 0);
  const double landing = seen.times[2] + 2 * lift / 9.81;
  bool landed = false;
  for (std::size_t k = 3; k < seen.times.size(); ++k)
    landed |=
        std::abs(seen.times[k] - landing) < 1e-15 && seen.frames[k].bodies[0].velocity.z() == 0;
  EXPECT_TRUE(landed);
  // Confined, it stays.
  scene.confined = true;
  EventSolver confined(scene, scene.initial);
  Recorder flat;
  confined.run(kRolling, &flat);
  for (const Frame& frame : flat.frames) EXPECT_EQ(frame.bodies[0].position.z(), 0.002);
}

TEST(EventSolver, AZeroFeatureChangesNoBit) {
  // A table of zeros, a drilling without a spin, and a substrate restitution that nothing falls on.
  Scene plain = test::head_on(0.2, -0.1, 0.9);
  Scene general = plain;
  general.substrate[0].rolling = RollingFriction({{0, 0}, {1, 0}});
  general.substrate[0].drilling_length = 1e-5;
  general.substrate[0].restitution = 0.5;
  EventSolver a(plain, plain.initial), b(general, general.initial);
  EXPECT_EQ(a.run(kRolling, nullptr).end_time, b.run(kRolling, nullptr).end_time);
  for (std::size_t i : {0u, 1u}) {
    EXPECT_EQ(a.states()[i].position, b.states()[i].position);
    EXPECT_EQ(a.states()[i].velocity, b.states()[i].velocity);
    EXPECT_EQ(a.states()[i].angular_velocity, b.states()[i].angular_velocity);
  }
}

/// One whose integration gives up.
struct FailingLaw final : CollisionLaw {
  CollisionResult collide(const CollisionRule&, CollidingBody, CollidingBody) const override {
    throw IntegrationFailure("too much work");
  }
};

TEST(EventSolver, ACollisionThatCannotBeIntegratedEndsTheRunWithItsReason) {
  Scene scene = test::head_on(0.15, -0.15, 0.9);
  scene.laws.assign(scene.pairs.size(), std::make_shared<FailingLaw>());
  EventSolver solver(scene, scene.initial);
  const SolvedRun run = solver.run({Run::Until::rolling, 0, 10}, nullptr);
  EXPECT_TRUE(run.failed);
  EXPECT_FALSE(run.reached);
  EXPECT_EQ(run.reason, "too much work");
}

}  // namespace
}  // namespace slipcheck
