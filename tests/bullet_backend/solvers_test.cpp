// Every solver with either kind of body does what a contact asks for, or is refused with the
// reason; contact springs and sleeping.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "../support/refusal.h"
#include "bullet_run.h"

namespace slipcheck {
namespace {

using Kinds = std::tuple<const char*, const char*>;  // body, solver

class BulletSolvers : public ::testing::TestWithParam<Kinds> {
 protected:
  Settings settings() const {
    const auto& [body, solver] = GetParam();
    return with(shipped("physical"), {{"body", body}, {"solver", solver}});
  }
  RemoteEngine engine_{bullet_executable("double")};
};

TEST_P(BulletSolvers, RestRollSlideAndCollide) {
  const double e = 0.9, speed = 0.3, rate = 240, mu = 0.1;
  PairContact pair;
  pair.restitution = e;
  BodyState sliding = rolling_along_x(kRadius, 0.2, 0.5);
  sliding.angular_velocity.setZero();
  Scene scene =
      scene_of(steel_ball(kRadius),
               {rolling_along_x(kRadius, 0, 0), rolling_along_x(kRadius, 0.1, speed), sliding,
                rolling_along_x(kRadius, -0.11, speed), rolling_along_x(kRadius, -0.1, 0)},
               ground_with_friction(mu), pair);
  const auto frames = run(engine_, scene, settings(), rate, 12);  // slides for 0.146 s
  const double t = 12 / rate;
  const auto& end = frames.back().bodies;
  EXPECT_LT(end[0].velocity.norm(), 1e-9);
  EXPECT_NEAR(end[0].position.z(), kRadius, 1e-6 * kRadius);
  EXPECT_NEAR(end[1].velocity.x(), speed, 1e-9);
  // Lemke's friction has other limits (see LemkeTakesTheFrictionForAnImpulse), here none that it
  // would reach.
  const bool lemke = std::get<1>(GetParam()) == std::string("lemke");
  EXPECT_NEAR(end[2].velocity.x(), lemke ? 0.5 * 5 / 7 : 0.5 - mu * kGravity * t, 1e-9);
  const auto hit = std::ranges::find_if(frames, touch_each_other);
  ASSERT_NE(hit, frames.end());
  EXPECT_NEAR((hit->bodies[4].velocity - hit->bodies[3].velocity).x() / speed, e, 1e-6);
}

TEST_P(BulletSolvers, RollingAndSpinningFrictionAreForIterationsOnly) {
  // btMLCPSolver gathers rows of contacts and of friction, and leaves out the other two.
  const double mu_r = 0.01, rate = 240, t = 24 / rate;
  const std::string solver = std::get<1>(GetParam());
  const bool iterates = solver == "sequential_impulse" || solver == "nncg";
  SubstrateContact ground = ground_with_friction(0.1);
  ground.rolling = RollingFriction(mu_r);
  ground.drilling_length = 0.01 * kRadius;
  BodyState spinning = rolling_along_x(kRadius, 1, 0);
  spinning.angular_velocity.z() = 100;
  const Scene scene =
      scene_of(steel_ball(kRadius), {rolling_along_x(kRadius, 0, 0.3), spinning}, ground);
  const auto frames = run(engine_, scene, settings(), rate, 24);
  const auto& end = frames.back().bodies;
  const double lost = iterates ? mu_r * kGravity * t : 0;                     // of v
  const double spent = iterates ? 0.01 * kGravity * t / (0.4 * kRadius) : 0;  // of ω_z
  EXPECT_NEAR(end[0].velocity.x(), 0.3 - lost, 1e-6);
  EXPECT_NEAR(end[1].angular_velocity.z(), 100 - spent, 1e-6 * 100);
  const auto missing = texts_of(engine_.configure(scene, settings(), 1 / rate).not_represented);
  EXPECT_EQ(std::ranges::count(missing,
                               "rolling and drilling friction (the solver passes over "
                               "their torques)"),
            iterates ? 0 : 1);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, BulletSolvers,
    ::testing::Values(Kinds{"rigid", "sequential_impulse"}, Kinds{"rigid", "nncg"},
                      Kinds{"rigid", "dantzig"}, Kinds{"rigid", "pgs"}, Kinds{"rigid", "lemke"},
                      Kinds{"multibody", "sequential_impulse"}, Kinds{"multibody", "dantzig"},
                      Kinds{"multibody", "pgs"}, Kinds{"multibody", "lemke"}),
    [](const auto& param) {
      return std::string(std::get<0>(param.param)) + "_" + std::get<1>(param.param);
    });

class BulletBodies : public ::testing::TestWithParam<const char*> {
 protected:
  RemoteEngine engine_{bullet_executable("double")};
};

TEST_P(BulletBodies, LemkeTakesTheFrictionForAnImpulse) {
  // btLemkeSolver knows no limit that depends on another row, and Bullet's rows hold μ until it is
  // multiplied: each step takes μ·1 N s from a sliding ball, whatever its weight, here 41 N s.
  const double mu = 0.1, mass = 1000, rate = 240;
  BodyState state = rolling_along_x(0.3, 0, 1);
  state.angular_velocity.setZero();
  const Scene scene = scene_of({0.3, mass, 0.4}, {state}, ground_with_friction(mu));
  const Settings settings = with(
      shipped("physical"), {{"body", GetParam()}, {"solver", "lemke"}, {"scale_radius_to", 0.0}});
  const auto frames = run(engine_, scene, settings, rate, 24);
  EXPECT_NEAR((1 - frames.back().bodies[0].velocity.x()) / (24 * mu / mass), 1, 1e-6);
  const auto missing = texts_of(engine_.configure(scene, settings, 1 / rate).not_represented);
  EXPECT_EQ(std::ranges::count(missing,
                               "the limit of friction (the Lemke solver takes the "
                               "coefficient for an impulse)"),
            1);
}

TEST(BulletSolversRefused, NncgHasNoMultibodies) {
  RemoteEngine engine(bullet_executable("double"));
  const Scene scene = scene_of(steel_ball(kRadius), {rolling_along_x(kRadius, 0, 0)}, {});
  EXPECT_EQ(test::refusal_of<Refused>([&] {
              engine.configure(scene, {{"body", "multibody"}, {"solver", "nncg"}}, 1e-3);
            }),
            "bullet: solver: nncg is for rigid bodies only, and body is multibody");
  EXPECT_TRUE(engine.alive());
  engine.configure(scene, {{"body", "rigid"}, {"solver", "nncg"}}, 1e-3);
}

/// Relative velocity after each step of two equal balls, mass m each, that fly at each other: a
/// spring k/2 and a damper 2 c between them (Bullet adds the springs in series, but the dampers),
/// by implicit Euler, which is what Bullet's soft rows are:
///     λ = h (k' x − (h k' + c') v)/(1 + (h² k' + h c')/m*), λ >= 0, m* = m/2.
double spring_restitution(double overlap, double approach, double h, double mass, double k,
                          double c) {
  const double k_pair = k / 2, c_pair = 2 * c, reduced = mass / 2;
  double x = overlap, v = -approach;  // v > 0 parts them
  while (x > 0) {
    const double lambda = h * (k_pair * x - (h * k_pair + c_pair) * v) /
                          (1 + (h * h * k_pair + h * c_pair) / reduced);
    v += std::max(0.0, lambda) / reduced;
    x -= v * h;
  }
  return v / approach;
}

TEST_P(BulletBodies, ContactSpringsAreImplicitEulerAndLoseByIt) {
  const double rate = 1000, h = 1 / rate, speed = 0.1;
  const Sphere ball = steel_ball(kRadius);
  const double reduced = ball.mass / 2;
  PairContact dead;
  dead.restitution = 0.0;
  for (const double steps : {2.0, 10.0, 50.0}) {  // of an undamped contact, π √(m*/k')
    const double omega = std::numbers::pi / (steps * h);
    const double k = 2 * reduced * omega * omega;
    // e = exp(−π ζ/√(1 − ζ²)) is meant to be 0.9: c' = 2 ζ √(k' m*).
    const double log_e = std::log(0.9), zeta = -log_e / std::hypot(std::numbers::pi, log_e);
    const double c = zeta * reduced * omega;
    for (const double phase : {0.1, 0.5, 0.9}) {
      BodyState left, right;
      left.position.z() = right.position.z() = 1;
      right.position.x() = kRadius + 0.5 * (2 + phase) * speed * h;
      left.position.x() = -right.position.x();
      left.velocity.x() = 0.5 * speed;
      right.velocity.x() = -0.5 * speed;
      Scene scene = scene_of(ball, {left, right}, {}, dead);
      scene.gravity = 0;
      const auto frames = run(engine_, scene,
                              {{"body", GetParam()},
                               {"contact_stiffness", k},
                               {"contact_damping", c},
                               {"multibody_linear_damping", 0.0},
                               {"restitution_velocity_threshold", 0.0}},
                              rate, static_cast<std::size_t>(3 * steps + 10));
      const auto& end = frames.back().bodies;
      const double out = (end[1].velocity - end[0].velocity).x() / speed;
      const double expected =
          spring_restitution((1 - phase) * speed * h, speed, h, ball.mass, k, c);
      EXPECT_NEAR(out, expected, 1e-9) << steps << " steps, phase " << phase;
      EXPECT_LT(out, 0.85);
    }
  }
}

TEST_P(BulletBodies, ASlowBallGoesOnWhereSleepingIsOff) {
  const double speed = 0.004;
  const Scene scene =
      scene_of(steel_ball(0.005), {rolling_along_x(0.005, 0, speed)}, ground_with_friction(0.1));
  const auto after_3_s = [&](bool sleeping) {
    const Settings settings = {{"body", GetParam()},
                               {"sleeping", sleeping},
                               {"two_friction_directions", true},
                               {"multibody_linear_damping", 0.0},
                               {"multibody_angular_damping", 0.0},
                               {"multibody_sleeping_threshold", 1.0}};
    return run(engine_, scene, settings, 240, 720).back().bodies[0];
  };
  EXPECT_NEAR(after_3_s(false).velocity.x(), speed, 1e-5);
  EXPECT_NEAR(after_3_s(false).position.x(), 3 * speed, 3e-5);
  EXPECT_EQ(after_3_s(true).velocity.x(), 0);
  EXPECT_NEAR(after_3_s(true).position.x(), 2 * speed, 0.03 * 2 * speed);  // asleep after 2 s
}

INSTANTIATE_TEST_SUITE_P(Bodies, BulletBodies, ::testing::Values("rigid", "multibody"),
                         [](const auto& param) { return std::string(param.param); });

}  // namespace
}  // namespace slipcheck
