#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "../support/extremes.h"
#include "../support/runge_kutta.h"
#include "physics/closed_forms.h"
#include "physics/contact/coupled_friction.h"
#include "reference/steps/step_solver.h"
#include "step_scenes.h"

namespace slipcheck {
namespace {

using namespace test;

/// One ball, and when it first sticks.
struct SlideWatch final : FrameSink {
  explicit SlideWatch(double radius) : radius_(radius) {}
  void take(double time, const Frame& frame) override {
    const BodyState& s = frame.bodies[0];
    const bool slips = slip_velocity(s, radius_).head<2>().norm() > 1e-12;
    if (!slips && end < 0) end = time;
  }
  double end = -1;

 private:
  double radius_;
};

/// Balls that roll all the while collide as if of 7/5 their mass.
TEST(StepSolver, StaticFrictionAloneHoldsWhatRollsThroughASlowCollision) {
  constexpr double kRestitution = 0.9, kTime = 0.02, kSpeed = 0.005;
  ContactScene scene = colliding(kSpeed, -kSpeed, kRestitution, kTime);
  scene.hard.substrate[0].static_friction = 0.5;
  scene.hard.substrate[0].kinetic_friction = 0;
  // ξ'' + 2 β ξ' + ω0² ξ = 0 with masses of 7/5.
  const double beta = -std::log(kRestitution) / kTime, omega = M_PI / kTime;
  const double slower = beta / 1.4;
  const double expected =
      std::exp(-slower * M_PI / std::sqrt((omega * omega + beta * beta) / 1.4 - slower * slower));
  for (const StepSettings& settings :
       {StepSettings{.step = kTime / 800}, StepSettings{.step = kTime / 800, .general = true},
        StepSettings{.step = kTime / 800, .most_in_all_pairs = 1}}) {
    StepSolver solver(scene, scene.hard.initial, settings);
    solver.run(until_time(0.1), nullptr);
    EXPECT_LT(closing(solver.states()), 0);
    // Of the steps, that are of second order; it is 0.9 without friction.
    EXPECT_NEAR(-closing(solver.states()) / (2 * kSpeed), expected, 1e-5);
  }
}

TEST(StepSolver, SlidingTimeAndDistanceAreOfFirstOrder) {
  Scene scene = test::steel_scene(1);
  scene.initial[0].velocity = {0.3, 0.1, 0};
  scene.initial[0].angular_velocity = {20, -10, 0};
  const SlideToRoll exact(scene.bodies[0], 0.1, 9.81, scene.initial[0].velocity,
                          scene.initial[0].angular_velocity);
  const ContactScene all = alone(scene);
  double worst_time = 0, worst_place = 0;
  for (int halving = 0; halving < 3; ++halving) {
    double time_error = 0, place_error = 0;
    for (int phase = 0; phase < 8; ++phase) {
      const double h = 1e-4 / (1 << halving) * (1 + phase / 32.0);
      SlideWatch watch(0.002);
      StepSolver solver(all, scene.initial, {h});
      const SolvedRun run = solver.run(kRolling, &watch);
      ASSERT_TRUE(run.reached);
      time_error = test::largest_of(time_error, std::abs(watch.end - exact.sliding_time) / h);
      const BodyState s = solver.states()[0];
      const Vector3 place =
          exact.displacement + exact.rolling_velocity * (run.end_time - exact.sliding_time);
      place_error =
          test::largest_of(place_error, (s.position - scene.initial[0].position - place).norm() /
                                            (h * exact.slip.norm()));
      // The impulse that stops the slip is exact.
      EXPECT_LT((s.velocity - exact.rolling_velocity).norm(), 1e-13);
      EXPECT_LT(slip_velocity(s, 0.002).norm(), 1e-15);
    }
    // Both in units of a step: bounded, that is of first order at worst.
    EXPECT_LT(time_error, 1.5);
    worst_time = test::largest_of(worst_time, time_error);
    EXPECT_LT(place_error, 0.5);
    if (halving > 0) {
      EXPECT_LT(place_error, 1.2 * worst_place);
    }
    worst_place = place_error;
  }
  EXPECT_GT(worst_time, 0.1);
}

TEST(StepSolver, TurningSlipIsOfSecondOrder) {
  // A ball on a slope that slides across it: friction turns with the slip. Exact: Runge-Kutta.
  Scene scene = test::steel_scene(1);
  scene.downhill = {0, -4};
  scene.initial[0].velocity = {0.5, 0, 0};
  const ContactScene all = alone(scene);
  const double t = 0.05, A = 2.5, a = 0.1 * 9.81;
  // v̇ = downhill − a û and u̇ = downhill − (1+A) a û
  const auto rate = [&](double, const Eigen::Vector4d& s) -> Eigen::Vector4d {
    const Vector2 friction = -a * s.tail<2>().normalized();
    return {friction.x(), friction.y() - 4, (1 + A) * friction.x(), (1 + A) * friction.y() - 4};
  };
  const Vector2 v = test::integrate(rate, Eigen::Vector4d(0.5, 0, 0.5, 0), 0, t, 4000).head<2>();
  const auto error = [&](int steps) {
    StepSolver solver(all, scene.initial, {t / steps});
    solver.run(until_time(t), nullptr);
    return (solver.states()[0].velocity.head<2>() - v).norm();
  };
  EXPECT_NEAR(order(error, 100), 2, 0.1);
}

TEST(StepSolver, K16RollingStopsAfterItsDistance) {
  Scene scene = test::steel_scene(1);
  scene.substrate[0].rolling = RollingFriction(0.01);
  scene.initial[0] = test::rolling_at(0, 0, 0.06, 0.08);
  const ContactScene all = alone(scene);
  const double a = 0.01 * 9.81;
  for (const double h : {1e-3, 5e-4, 2.5e-4}) {
    StepSolver solver(all, scene.initial, {h});
    const SolvedRun run = solver.run({Run::Until::rest, 0, 10}, nullptr);
    ASSERT_TRUE(run.reached);
    EXPECT_NEAR(run.end_time, 0.1 / a, 1.5 * h);
    const BodyState s = solver.states()[0];
    EXPECT_EQ(s.velocity.norm(), 0);
    // Stopping within the last step costs a h²/8 at most.
    EXPECT_NEAR(s.position.head<2>().norm(), 0.005 / a, 0.13 * a * h * h);
  }
}

TEST(StepSolver, RollingFrictionOfATableFollowsItsExponential) {
  Scene scene = test::steel_scene(1);
  // μ_r = 0.1 v: v̇ = −0.1 g v.
  scene.substrate[0].rolling =
      RollingFriction(std::vector<RollingFriction::Point>{{0, 0}, {1, 0.1}});
  scene.initial[0] = test::rolling_at(0, 0, 0.1, 0);
  const ContactScene all = alone(scene);
  const auto error = [&](int steps) {
    StepSolver solver(all, scene.initial, {1.0 / steps});
    solver.run(until_time(1), nullptr);
    return std::abs(solver.states()[0].velocity.x() - 0.1 * std::exp(-0.981));
  };
  EXPECT_LT(error(1000), 1e-4);
  EXPECT_GT(order(error, 500), 0.9);
}

TEST(StepSolver, RollingFrictionWhileSlidingTurnsTheSphereOnly) {
  Scene scene = test::steel_scene(1);
  scene.substrate[0].rolling = RollingFriction(0.01);
  scene.substrate[0].rolling_while_sliding = true;
  scene.initial[0].velocity = {1, 0, 0};
  scene.initial[0].angular_velocity = {0, 50, 0};
  const ContactScene all = alone(scene);
  StepSolver solver(all, scene.initial, {1e-4});
  solver.run(until_time(0.01), nullptr);
  const BodyState s = solver.states()[0];
  // I Ω̇ = R μ_k m g − (1+q) μ_r m g R, all constant.
  EXPECT_NEAR(s.velocity.x(), 1 - 0.01 * 0.981, 1e-13);
  const double rate = 2.5 / 0.002 * 9.81 * (0.1 - 1.4 * 0.01);
  EXPECT_NEAR(s.angular_velocity.y(), 50 + 0.01 * rate, 1e-9);
}

TEST(StepSolver, DrillingStopsLinearly) {
  Scene scene = test::steel_scene(1);
  scene.substrate[0].drilling_length = 2e-6;
  scene.initial[0].angular_velocity = {0, 0, 30};
  const ContactScene all = alone(scene);
  StepSolver solver(all, scene.initial, {1e-4});
  const double rate = 2e-6 * 9.81 / (0.4 * 0.002 * 0.002);
  solver.run(until_time(1), nullptr);
  EXPECT_NEAR(solver.states()[0].angular_velocity.z(), 30 - rate, 1e-9);
  const SolvedRun run = solver.run({Run::Until::rest, 0, 10}, nullptr);
  EXPECT_NEAR(run.end_time, 30 / rate, 1.5e-4);
  EXPECT_EQ(solver.states()[0].angular_velocity.z(), 0);
}

TEST(StepSolver, CoupledDrillingFollowsTheIntegratedLaw) {
  Scene scene = test::steel_scene(1);
  SubstrateContact& contact = scene.substrate[0];
  contact.coupled_radius = 2e-4;
  contact.drilling_length = 2.0 / 3 * 0.1 * 2e-4;
  scene.initial[0].velocity = {0.05, 0, 0};
  scene.initial[0].angular_velocity = {0, 0, 400};
  const ContactScene all = alone(scene);
  // u̇ = −(1+A) μ g f(u, a_c Ω), I Ω̇ = −μ m g a_c t(u, a_c Ω): Runge-Kutta.
  const double t = 0.01, g = 9.81;
  const auto rate = [&](double, const Vector3& s) {  // of v, u, Ω
    const CoupledFriction c = coupled_friction(DiscPressure::uniform, s[1], 2e-4 * s[2]);
    const double a = -0.1 * g * c.force;
    return Vector3(a, 3.5 * a, -0.1 * g * 2e-4 * c.torque / (0.4 * 0.002 * 0.002));
  };
  const Vector3 exact = test::integrate(rate, Vector3(0.05, 0.05, 400), 0, t, 2000);
  const double v = exact[0], w = exact[2];
  ASSERT_GT(exact[1], 0.001);
  const auto error = [&](int steps) {
    StepSolver solver(all, scene.initial, {t / steps});
    solver.run(until_time(t), nullptr);
    const BodyState s = solver.states()[0];
    return std::abs(s.velocity.x() - v) / v + std::abs(s.angular_velocity.z() - w) / w;
  };
  EXPECT_NEAR(order(error, 100), 2, 0.1);
  EXPECT_LT(error(1000), 1e-4);
}

TEST(StepSolver, K24FiveSeventhsDownASlope) {
  Scene scene = test::steel_scene(1);
  const double tilt = 5 * M_PI / 180;
  scene.gravity = 9.81 * std::cos(tilt);
  scene.downhill = {0, -9.81 * std::sin(tilt)};
  const ContactScene all = alone(scene);
  StepSolver solver(all, scene.initial, {1e-3});
  solver.run(until_time(0.5), nullptr);
  const BodyState s = solver.states()[0];
  const double a = 5.0 / 7 * 9.81 * std::sin(tilt);
  EXPECT_NEAR(s.velocity.y(), -a * 0.5, 1e-13);
  EXPECT_NEAR(s.position.y(), -a * 0.125, 1e-13);
  EXPECT_NEAR(0.002 * s.angular_velocity.x(), a * 0.5, 1e-13);
}

TEST(StepSolver, SteepSlopeSlides) {
  // Rolling needs (2/7) g sinθ of friction: more than μ_s g cosθ beyond tanθ = 3.5 μ_s.
  Scene scene = test::steel_scene(1);
  scene.substrate[0].static_friction = 0.2;
  for (const double tan : {0.69, 0.71}) {
    const double tilt = std::atan(tan);
    scene.gravity = 9.81 * std::cos(tilt);
    scene.downhill = {9.81 * std::sin(tilt), 0};
    const ContactScene all = alone(scene);
    StepSolver solver(all, scene.initial, {1e-3});
    solver.run(until_time(0.1), nullptr);
    const double rolls = 5.0 / 7 * 9.81 * std::sin(tilt);
    const double slides = 9.81 * (std::sin(tilt) - 0.1 * std::cos(tilt));
    EXPECT_NEAR(solver.states()[0].velocity.x(), 0.1 * (tan < 0.7 ? rolls : slides), 1e-12);
  }
}

TEST(StepSolver, K15TwoSeventhsOfTheSubstratesVelocity) {
  Scene scene = test::steel_scene(1);
  scene.motion = SubstrateMotion::oscillation({0.01, 0.003}, 3, 0);
  const ContactScene all = alone(scene);
  // a = (2/7) a_S: v = (2/7) (v_S − v_S(0)) from a start at rest that rolls on the moving plane.
  BodyState start = scene.initial[0];
  const Vector3 first = scene.motion.velocity(0);
  start.angular_velocity = rolling_angular_velocity(-first, 0.002);
  const std::vector<BodyState> initial = {start};
  StepSolver solver(all, initial, {1e-4});
  for (const double t : {0.1, 0.25, 0.5}) {
    solver.run(until_time(t), nullptr);
    const Vector3 expected = 2.0 / 7 * (scene.motion.velocity(t) - first);
    EXPECT_LT((solver.states()[0].velocity - expected).norm(), 1e-12) << t;
  }
}

TEST(StepSolver, FastOscillationMakesTheBallSlide) {
  // Rolling asks for friction (5/7... of) m a_S/(1+A): K (17) holds up to a_S = 3.5 μ_s g.
  Scene scene = test::steel_scene(1);
  scene.substrate[0].static_friction = 0.1;
  for (const double share : {0.95, 1.05}) {
    const double amplitude = share * 3.5 * 0.1 * 9.81 / std::pow(2 * M_PI * 5, 2);
    scene.motion = SubstrateMotion::oscillation({amplitude, 0}, 5, M_PI / 2);
    const ContactScene all = alone(scene);
    StepSolver solver(all, scene.initial, {1e-5});
    solver.run(until_time(0.01), nullptr);
    const BodyState s = solver.states()[0];
    const double slip =
        (slip_velocity(s, 0.002) - scene.motion.velocity(solver.now())).head<2>().norm();
    EXPECT_EQ(slip > 1e-6, share > 1) << slip;
  }
}

/// A slip that the substrate's acceleration nearly keeps up fades over many steps. Against where it
/// was expected to point, friction of a step would overshoot it, and it jumped from side to side
/// until the substrate had turned. The exact velocity once it has gone is K (15)'s.
TEST(StepSolver, SlipFadesOnAShakenSubstrateAndIsGone) {
  Scene scene = test::steel_scene(1);
  scene.confined = true;
  scene.substrate[0].kinetic_friction = 0.5;
  scene.substrate[0].static_friction = 0.6;
  scene.motion = SubstrateMotion::oscillation({0.1, 0.05}, 2, 0.4);
  const ContactScene all = alone(scene);
  constexpr double kLength = 2e-4, kEnd = 0.1;
  int late = 0;
  for (int k = 0; k < 200; ++k) {
    std::vector<BodyState> initial = scene.initial;
    initial[0].velocity = {std::cos(k * M_PI / 100), std::sin(k * M_PI / 100), 0};
    initial[0].velocity *= 0.1 + 0.002 * k;
    EventSolver exact(scene, initial);
    exact.run(until_time(kEnd - 20 * kLength), nullptr);
    const auto slip = [&](const BodyState& state, double t) {
      return (slip_velocity(state, 0.002) - scene.motion.velocity(t)).head<2>().norm();
    };
    if (slip(exact.states()[0], exact.now()) > 1e-12) continue;  // not yet gone
    ++late;
    exact.run(until_time(kEnd), nullptr);
    StepSolver solver(all, initial, {.step = kLength, .general = k % 2 == 1});
    solver.run(until_time(kEnd), nullptr);
    const BodyState s = solver.states()[0];
    EXPECT_LT(slip(s, kEnd), 1e-12) << k;
    // What friction takes in the step in which the slip ends.
    EXPECT_LT((s.velocity - exact.states()[0].velocity).norm(), 0.5 * 9.81 * kLength) << k;
  }
  EXPECT_GT(late, 100);
}

TEST(StepSolver, FlightLandingAndRestitution) {
  Scene scene = test::steel_scene(1);
  scene.substrate[0].restitution = 0.5;
  scene.initial[0].position.z() = 0.002 + 0.05;
  scene.initial[0].velocity = {0.2, 0, 0};
  const ContactScene all = alone(scene);
  const double fall = std::sqrt(2 * 0.05 / 9.81), speed = 9.81 * fall;
  for (const double h : {1e-4, 5e-5}) {
    StepSolver solver(all, scene.initial, {h});
    solver.run(until_time(fall - 1e-3), nullptr);
    EXPECT_EQ(solver.states()[0].velocity.x(), 0.2);
    // Half way up and down of the rebound.
    solver.run(until_time(fall + 0.5 * speed / 9.81), nullptr);
    const BodyState s = solver.states()[0];
    EXPECT_NEAR(s.position.z() - 0.002, 0.25 * 0.05, speed * h);
    // μ_k (1+e) v_z of slip friction, K (18), below what would make it roll.
    const double expected = 0.2 - std::min(0.1 * 1.5 * speed, 0.2 / 3.5);
    EXPECT_NEAR(s.velocity.x(), expected, 1e-3 * 0.2);
  }
  StepSolver solver(all, scene.initial, {1e-4});
  const SolvedRun run = solver.run(kRolling, nullptr);
  ASSERT_TRUE(run.reached);
  EXPECT_EQ(solver.states()[0].position.z(), 0.002);
}

TEST(StepSolver, LandingOnAMovingSubstrateRubsInItsFrame) {
  Scene scene = test::steel_scene(1);
  scene.motion = SubstrateMotion::constant({0.3, 0});
  scene.initial[0].position.z() = 0.002 + 0.01;
  scene.initial[0].velocity = {0.3, 0, 0};  // with the substrate: no slip, no friction
  const ContactScene all = alone(scene);
  StepSolver solver(all, scene.initial, {1e-4});
  ASSERT_TRUE(solver.run(kRolling, nullptr).reached);
  EXPECT_NEAR(solver.states()[0].velocity.x(), 0.3, 1e-15);
  EXPECT_EQ(solver.states()[0].angular_velocity.norm(), 0);
}

}  // namespace
}  // namespace slipcheck
