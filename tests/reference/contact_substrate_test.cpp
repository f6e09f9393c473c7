#include <gtest/gtest.h>

#include <cmath>

#include "../support/runge_kutta.h"
#include "physics/contact/coupled_friction.h"
#include "reference/forces/contact_solver.h"
#include "soft_scenes.h"

// One ball on a substrate that is tilted, moves, or rubs in other ways than plainly.

namespace slipcheck {
namespace {

constexpr double kG = 9.81, kRadius = 0.002;

BodyState at_rest() { return test::rolling_at(0, 0, 0, 0); }

BodyState state_after(const ContactScene& scene, double time) {
  ContactSolver solver(scene, scene.hard.initial);
  const SolvedRun run = solver.run(until_time(time), nullptr);
  EXPECT_TRUE(run.reached) << run.reason;
  EXPECT_LT(std::abs(run.balance->error()), 1e-10);
  return solver.states()[0];
}

void tilt(Scene& scene, double angle) {
  scene.gravity = kG * std::cos(angle);
  scene.downhill = {0, -kG * std::sin(angle)};
}

TEST(ContactSubstrate, K24RollsDownASlopeWithFiveSeventhsOfGravity) {
  ContactScene scene = test::one_ball(at_rest());
  tilt(scene.hard, 0.1);
  const BodyState end = state_after(scene, 0.5);
  const double a = 5.0 / 7 * kG * std::sin(0.1);
  EXPECT_NEAR(end.velocity.y(), -a * 0.5, 1e-12);
  EXPECT_NEAR(end.position.y(), -a * 0.125, 1e-12);
  EXPECT_NEAR(end.angular_velocity.x(), a * 0.5 / kRadius, 1e-9);
}

TEST(ContactSubstrate, K17SlipsOnASlopeSteeperThanSevenHalvesMu) {
  // Rolling needs (2/7) g sinθ of friction: it slides from tan θ = (7/2) μ_s on, with a = g(sinθ −
  // μ_k cosθ).
  for (const bool steep : {false, true}) {
    const double angle = std::atan(3.5 * 0.5 * (steep ? 1.001 : 0.999));
    ContactScene scene = test::one_ball(at_rest());
    tilt(scene.hard, angle);
    const double a =
        steep ? kG * (std::sin(angle) - 0.1 * std::cos(angle)) : 5.0 / 7 * kG * std::sin(angle);
    EXPECT_NEAR(state_after(scene, 0.2).velocity.y(), -0.2 * a, 1e-11);
  }
}

TEST(ContactSubstrate, K18SlidesAcrossASlopeOnATurningSlip) {
  // Against RK4 of v̇ = g_∥ − μ_k g û, u̇ = g_∥ − (1+A) μ_k g û; the slip is far from zero.
  BodyState start = at_rest();
  start.velocity.x() = 0.8;
  ContactScene scene = test::one_ball(start);
  tilt(scene.hard, 0.15);
  const double g = scene.hard.gravity, down = scene.hard.downhill.y();
  using State = Eigen::Vector4d;  // v, u
  State s(0.8, 0, 0.8, 0);
  const double end = 0.15;
  s = test::integrate(
      [&](double, const State& x) {
        const Eigen::Vector2d friction = -0.1 * g * x.tail<2>().normalized();
        State rate;
        rate << friction, 3.5 * friction;
        rate(1) += down;
        rate(3) += down;
        return rate;
      },
      s, 0, end, 4000);
  const BodyState seen = state_after(scene, end);
  EXPECT_NEAR(seen.velocity.x(), s(0), 1e-11);
  EXPECT_NEAR(seen.velocity.y(), s(1), 1e-11);
}

TEST(ContactSubstrate, K18SlideAcrossASlopeEndsInRolling) {
  // However the slip turns, friction and slip change in proportion: (1+A)(v − ∫g_∥) − u is kept, so
  // the velocity when the slip ends follows from that time alone.
  BodyState start = at_rest();
  start.velocity.x() = 0.3;
  ContactScene scene = test::one_ball(start);
  tilt(scene.hard, 0.1);
  struct End final : FrameSink {
    double time = 0;
    BodyState state;
    void take(double t, const Frame& frame) override {
      if (time == 0 && t > 0 && slip_velocity(frame.bodies[0], kRadius).norm() < 1e-12) {
        time = t;
        state = frame.bodies[0];
      }
    }
  } rolling;
  ContactSolver solver(scene, scene.hard.initial);
  solver.run(until_time(1), &rolling);
  ASSERT_GT(rolling.time, 0.3 / (3.5 * 0.1 * kG));
  const double down = scene.hard.downhill.y();
  // (1+A) v − u at both ends; u is driven by g_∥ once, v too: the difference grows by A g_∥ t.
  EXPECT_NEAR(3.5 * rolling.state.velocity.x(), 3.5 * 0.3 - 0.3, 1e-11);
  EXPECT_NEAR(3.5 * rolling.state.velocity.y(), 2.5 * down * rolling.time, 1e-11);
}

TEST(ContactSubstrate, K15RollsWithTwoSeventhsOfTheSubstratesAcceleration) {
  // v follows (2/7)(v_S(t) − v_S(0)) while it sticks: amplitude ω² < 1.75 g for μ_s = 0.5.
  ContactScene scene = test::one_ball(at_rest());
  const double amplitude = 0.004, frequency = 10;
  scene.hard.motion = SubstrateMotion::oscillation({amplitude, 0}, frequency, 0);
  const double w = 2 * M_PI * frequency;
  ASSERT_LT(amplitude * w * w, 1.75 * kG);
  // It starts to roll with the substrate.
  scene.hard.initial[0].velocity.x() = 0;
  scene.hard.initial[0].angular_velocity =
      rolling_angular_velocity(Vector3(-amplitude * w, 0, 0), kRadius);
  const double t = 0.33;
  const BodyState end = state_after(scene, t);
  const double moved = amplitude * w * (std::cos(w * t) - 1);
  EXPECT_NEAR(end.velocity.x(), 2.0 / 7 * moved, 1e-11);
}

TEST(ContactSubstrate, K17BreaksLooseWhereTheSubstratePassesSevenHalvesMuG) {
  // The first slip comes when a_S = (1+A) μ_s g = 1.75 g; the frames show it.
  ContactScene scene = test::one_ball(at_rest());
  const double amplitude = 0.01, frequency = 8, w = 2 * M_PI * frequency;
  ASSERT_GT(amplitude * w * w, 1.75 * kG);
  scene.hard.motion = SubstrateMotion::oscillation({amplitude, 0}, frequency, 0);
  scene.hard.initial[0].angular_velocity =
      rolling_angular_velocity(Vector3(-amplitude * w, 0, 0), kRadius);
  struct Times final : FrameSink {
    std::vector<double> times;
    void take(double t, const Frame&) override { times.push_back(t); }
  } film;
  ContactSolver solver(scene, scene.hard.initial);
  const SolvedRun run = solver.run(until_time(0.5), &film);
  ASSERT_GT(film.times.size(), 3u);
  EXPECT_NEAR(film.times[1], std::asin(1.75 * kG / (amplitude * w * w)) / w, 1e-12);
  EXPECT_LT(std::abs(run.balance->error()), 1e-10);
}

TEST(ContactSubstrate, ABeltThatStartsAtOnceDragsTheBallToTwoSeventhsOfItsSpeed) {
  ContactScene scene = test::one_ball(at_rest());
  scene.hard.motion = SubstrateMotion::table({{0.1, {0, 0}}, {2.1, {0.6, 0}}});
  const BodyState end = state_after(scene, 1);
  EXPECT_NEAR(end.velocity.x(), 2.0 / 7 * 0.3, 1e-12);
  EXPECT_NEAR(end.angular_velocity.y(), (2.0 / 7 - 1) * 0.3 / kRadius, 1e-9);
}

TEST(ContactSubstrate, AUniformlyMovingPlaneIsAStillOneSeenFromATrain) {
  BodyState start = at_rest();
  start.velocity = {0.3, 0.1, 0};
  start.angular_velocity = {20, -30, 5};
  const ContactScene still = test::one_ball(start);
  BodyState boosted = start;
  boosted.velocity += Vector3(0.7, -0.2, 0);
  ContactScene moving = test::one_ball(boosted);
  moving.hard.motion = SubstrateMotion::constant({0.7, -0.2});
  const BodyState a = state_after(still, 0.4), b = state_after(moving, 0.4);
  EXPECT_LT((b.velocity - a.velocity - Vector3(0.7, -0.2, 0)).norm(), 1e-12);
  EXPECT_LT((b.position - a.position - 0.4 * Vector3(0.7, -0.2, 0)).norm(), 1e-12);
}

TEST(ContactSubstrate, K16RollingFrictionHoldsABallOnAGentleSlope) {
  // Rolling without friction would take (5/7) g sinθ; μ_r g cosθ holds it up to tan θ = (7/5) μ_r.
  for (const bool steep : {false, true}) {
    const double angle = std::atan(1.4 * 0.01 * (steep ? 1.01 : 0.99));
    ContactScene scene = test::one_ball(at_rest());
    tilt(scene.hard, angle);
    scene.hard.substrate[0].rolling = RollingFriction(0.01);
    const double a = 5.0 / 7 * kG * std::sin(angle) - 0.01 * kG * std::cos(angle);
    EXPECT_NEAR(state_after(scene, 0.5).velocity.y(), steep ? -0.5 * a : 0, 1e-12);
  }
}

TEST(ContactSubstrate, K16BallThatRollsUphillStopsAndComesBackOrStays) {
  // Up with (5/7) g sinθ + μ_r g cosθ, down with the difference.
  const double angle = 0.05, up = 0.2;
  for (const double mu : {0.01, 0.2}) {
    ContactScene scene = test::one_ball(test::rolling_at(0, 0, 0, up));
    tilt(scene.hard, angle);
    scene.hard.substrate[0].rolling = RollingFriction(mu);
    const double pull = 5.0 / 7 * kG * std::sin(angle), drag = mu * kG * std::cos(angle);
    const double top = up / (pull + drag), t = 1.5;
    const double expected = pull > drag ? -(pull - drag) * (t - top) : 0;
    EXPECT_NEAR(state_after(scene, t).velocity.y(), expected, 1e-11);
  }
}

TEST(ContactSubstrate, RollingFrictionWhileSlidingIsACouple) {
  // (1+q) μ_r R N against the turning: u̇ = −(1+A) μ_k g − A (1+q) μ_r g while it spins up, so the
  // slip ends later than without: t = u/((1+A)(μ_k g − …)). Derived for a ball that slides without
  // spin at the start: Ω̇ = (A/R)(μ_k − (1+q) μ_r) g.
  BodyState start = at_rest();
  start.velocity.x() = 0.3;
  ContactScene scene = test::one_ball(start);
  scene.hard.substrate[0].rolling = RollingFriction(0.02);
  scene.hard.substrate[0].rolling_while_sliding = true;
  const double spin_up = 2.5 * (0.1 - 1.4 * 0.02) * kG;  // of RΩ
  const double t = 0.3 / (0.1 * kG + spin_up);
  const BodyState end = state_after(scene, 0.999 * t);
  EXPECT_NEAR(end.velocity.x(), 0.3 - 0.1 * kG * 0.999 * t, 1e-12);
  EXPECT_NEAR(kRadius * end.angular_velocity.y(), spin_up * 0.999 * t, 1e-12);
  const BodyState rolls = state_after(scene, 1.1 * t);
  EXPECT_NEAR(rolls.velocity.x(), 0.3 - 0.1 * kG * t - 0.02 * kG * 0.1 * t, 1e-12);
}

TEST(ContactSubstrate, CoupledDrillingFollowsTheDiscIntegral) {
  // A ball that slides and spins: v̇, Ω̇_h by the force, Ω̇_z by the torque of the disc, against RK4
  // well before the end of the sliding.
  BodyState start = at_rest();
  start.velocity.x() = 0.05;
  start.angular_velocity.z() = 600;
  for (const bool hertzian : {false, true}) {
    ContactScene scene = test::one_ball(start);
    SubstrateContact& contact = scene.hard.substrate[0];
    contact.coupled_radius = 2e-4;
    contact.hertzian_pressure = hertzian;
    contact.drilling_length = 0.1 * 2e-4 * (hertzian ? 3 * M_PI / 16 : 2.0 / 3);
    using State = Eigen::Vector3d;  // v, u, Ω_z
    State s(0.05, 0.05, 600);
    const auto pressure = hertzian ? DiscPressure::hertzian : DiscPressure::uniform;
    const double end = 0.02;
    s = test::integrate(
        [&](double, const State& x) {
          const CoupledFriction f = coupled_friction(pressure, x(1), 2e-4 * x(2));
          const double a = 0.1 * kG * f.force;
          return State(-a, -3.5 * a, -0.1 * kG * 2e-4 * f.torque / (0.4 * kRadius * kRadius));
        },
        s, 0, end, 4000);
    ASSERT_GT(s(1), 1e-4);
    const BodyState seen = state_after(scene, end);
    EXPECT_NEAR(seen.velocity.x(), s(0), 1e-10);
    EXPECT_NEAR(seen.angular_velocity.z(), s(2), 1e-6);
    // Slower than Coulomb alone would stop it.
    EXPECT_GT(seen.velocity.x(), 0.05 - 0.1 * kG * end);
  }
}

TEST(ContactSubstrate, CoupledSlidingAndSpinEndTogether) {
  BodyState start = at_rest();
  start.velocity.x() = 0.05;
  start.angular_velocity.z() = 300;
  ContactScene scene = test::one_ball(start);
  SubstrateContact& contact = scene.hard.substrate[0];
  contact.coupled_radius = 4e-4;
  contact.drilling_length = 0.1 * 4e-4 * 2 / 3;
  ContactSolver solver(scene, scene.hard.initial);
  const SolvedRun run = solver.run({Run::Until::rolling, 0, 5}, nullptr);
  ASSERT_TRUE(run.reached) << run.reason;
  EXPECT_GT(std::abs(solver.states()[0].angular_velocity.z()), 1);
  // Once the slip counts as ended the ball rolls at 5/7 of its speed, to that slip.
  EXPECT_NEAR(solver.states()[0].velocity.x(), 5.0 / 7 * 0.05, 1e-6);
}

TEST(ContactSubstrate, ABouncingBallFollowsTheGeometricSeries) {
  BodyState start = at_rest();
  start.position.z() = kRadius + 0.05;
  ContactScene scene = test::one_ball(start);
  scene.hard.substrate[0].restitution = 0.5;
  ContactSolver solver(scene, scene.hard.initial);
  const SolvedRun run = solver.run({Run::Until::rest, 0, 5}, nullptr);
  ASSERT_TRUE(run.reached) << run.reason;
  // t = √(2h/g) (1 + e)/(1 − e); the bounces below 1e-10 of the speed are cut off.
  EXPECT_NEAR(run.end_time, std::sqrt(2 * 0.05 / kG) * 3, 1e-9);
}

}  // namespace
}  // namespace slipcheck
