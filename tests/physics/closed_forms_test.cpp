#include "physics/closed_forms.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../support/runge_kutta.h"

namespace slipcheck {
namespace {

constexpr double kGravity = 9.81;
const Sphere kBall{0.002, 2.6e-4, 0.4};

/// Integrates Coulomb sliding until the slip, along one line, has vanished: returns time and state.
/// The friction is constant while it slides, so Runge-Kutta is exact up to rounding.
struct Slid {
  double time;
  BodyState state;
};
Slid slide_until_rolling(const BodyState& start, double mu) {
  const auto rates = [&](const BodyState& s) {
    const Vector3 lever = -kBall.radius * Vector3::UnitZ();
    const Vector3 slip = s.velocity + s.angular_velocity.cross(lever);
    const Vector3 force = -mu * kBall.mass * kGravity * slip.normalized();
    return test::Rates{force / kBall.mass, lever.cross(force) / kBall.moment_of_inertia()};
  };
  // With the direction held, so that the law goes on smoothly past the end.
  const auto held = [&](double, const BodyState&) { return rates(start); };
  const Vector3 u0 = slip_velocity(start, kBall.radius);
  double low = 0, high = 10;
  // Bisection on the sign of the slip along its first direction.
  for (int n = 0; n < 100; ++n) {
    const double t = 0.5 * (low + high);
    const BodyState s = test::integrate(start, t, 4, held);
    (slip_velocity(s, kBall.radius).dot(u0) > 0 ? low : high) = t;
  }
  return {low, test::integrate(start, low, 4, held)};
}

TEST(SlideToRoll, MatchesIntegrationForAnObliqueStart) {
  BodyState start;
  start.velocity = {0.3, -0.2, 0};
  start.angular_velocity = {20, -40, 3};
  const SlideToRoll closed(kBall, 0.1, kGravity, start.velocity, start.angular_velocity);
  const Slid slid = slide_until_rolling(start, 0.1);
  EXPECT_NEAR(closed.sliding_time, slid.time, 1e-14);
  EXPECT_LE((closed.rolling_velocity - slid.state.velocity).norm(), 1e-14);
  EXPECT_LE((closed.displacement - slid.state.position).norm(), 1e-15);
  EXPECT_NEAR(closed.energy_change,
              start.velocity.squaredNorm() - slid.state.velocity.squaredNorm(), 1e-14);
  EXPECT_LE((closed.momentum_change - (start.velocity - slid.state.velocity)).norm(), 1e-14);
}

TEST(SlideToRoll, BowlingBall) {
  // Sliding without spin: v^s = 5/7 v, t^s = 2 v/(7 μ g), s = 12 v²/(49 μ g).
  const SlideToRoll closed(kBall, 0.2, kGravity, {1, 0, 0}, {0, 0, 0});
  EXPECT_NEAR(closed.rolling_velocity.x(), 5.0 / 7, 1e-16);
  EXPECT_NEAR(closed.sliding_time, 2 / (7 * 0.2 * kGravity), 1e-16);
  EXPECT_NEAR(closed.sliding_distance, 12 / (49 * 0.2 * kGravity), 1e-16);
}

/// Two equal spheres on a line by way of their forces: a hard normal impulse, then each slides.
struct Pushed {
  double v, s, t;
};
Pushed collide_and_slide(double v_i, double v_j, double e, double c) {
  const double mean = 0.5 * (v_i + v_j);
  BodyState i;
  i.velocity.x() = mean - e * (v_i - mean);  // in the centre-of-mass frame: −e times
  i.angular_velocity.y() = (v_i - c * (v_i + v_j)) / kBall.radius;  // Ω − c(Ω_i + Ω_j), rolling
  const Slid slid = slide_until_rolling(i, 0.1);
  return {slid.state.velocity.x(), slid.state.position.x(), slid.time};
}

TEST(HeadOnCollision, K62RollingVelocityAfterCollisionAndSlide) {
  for (double e : {0.0, 0.5, 0.9, 1.0})
    for (double c : {0.0, 0.132, 0.5})
      for (double v_j : {-0.1, 0.0, 0.03}) {
        const HeadOnCollision closed{2.5, e, c};
        const Pushed expected = collide_and_slide(0.1, v_j, e, c);
        EXPECT_NEAR(closed.rolling_velocity(0.1, v_j), expected.v, 1e-14);
        EXPECT_NEAR(std::abs(closed.slip_after(0.1, v_j)) / (3.5 * 0.1 * kGravity), expected.t,
                    1e-14);
      }
}

TEST(HeadOnCollision, K62StruckParticleSlipsMoreWithRubbing) {
  // ½(1 + e) + C for a target at rest: it is spun backwards.
  const HeadOnCollision closed{2.5, 0.9, 0.13};
  EXPECT_NEAR(closed.slip_after(0, 0.1), 0.1 * (0.5 * 1.9 + 0.13), 1e-16);
}

TEST(HeadOnCollision, K44SlidingDistance) {
  // 0.087 cm at v_rel = 10 cm/s, e_n = 0.9, μ_k = 0.1 (physics notes; g = 981 cm/s²).
  const HeadOnCollision closed{2.5, 0.9, 0};
  const double s = closed.symmetric_sliding_distance(0.1, 0.1, kGravity);
  EXPECT_NEAR(s, 0.087e-2, 0.0005e-2);
  EXPECT_NEAR(s, std::abs(collide_and_slide(0.05, -0.05, 0.9, 0).s), 1e-15);
}

TEST(HeadOnCollision, K46ToK49LossesOfTheCollisionAndOfTheSlide) {
  const double v = 0.05;
  for (double e : {0.5, 0.7, 0.9, 1.0}) {
    const SymmetricLosses losses = HeadOnCollision{2.5, e, 0}.symmetric_losses();
    // Sphere i comes along +x and is thrown back at −e v; what it then has it loses by sliding.
    const double slid = collide_and_slide(v, -v, e, 0).v;
    const double slide_energy = (e * v * e * v - slid * slid) / (v * v);
    const double slide_momentum = (slid - -e * v) / v;
    EXPECT_NEAR(losses.sliding_energy, slide_energy, 1e-13);
    EXPECT_NEAR(losses.sliding_momentum, slide_momentum, 1e-13);
    EXPECT_NEAR(losses.energy_ratio(), (1 - e * e) / slide_energy, 1e-12);
    EXPECT_NEAR(losses.momentum_ratio(), (1 - e) / slide_momentum, 1e-12);
  }
  // Elastic: 40/49, the paper's 80 %, and 4/7, its 60 %; all of it by sliding.
  const SymmetricLosses elastic = HeadOnCollision{2.5, 1, 0}.symmetric_losses();
  EXPECT_NEAR(elastic.sliding_energy, 40.0 / 49, 1e-15);
  EXPECT_NEAR(elastic.sliding_momentum, 4.0 / 7, 1e-15);
  EXPECT_EQ(elastic.energy_ratio(), 0);
  EXPECT_EQ(elastic.momentum_ratio(), 0);
}

TEST(HeadOnCollision, K47K49LossesAreEqualAt53Over73And5Over9) {
  // (47) = 1: (1+A)²(1 − e) = e − 1 + 2Ae, e = ((1+A)² + 1)/((1+A)² + 1 + 2A); (49) = 1: e =
  // A/(2+A).
  EXPECT_NEAR((HeadOnCollision{2.5, 53.0 / 73, 0}.symmetric_losses().energy_ratio()), 1, 1e-14);
  EXPECT_NEAR((HeadOnCollision{2.5, 5.0 / 9, 0}.symmetric_losses().momentum_ratio()), 1, 1e-14);
}

TEST(HeadOnCollision, K65K66APairLosesTwiceAsMuchByASymmetricCollision) {
  // Of the energy that both have before an elastic collision: 2A/(1+A)² with a target at rest,
  // 4A/(1+A)² at equal speeds.
  const auto lost = [](double v_i, double v_j, double e, double c) {
    double sum = 0;
    for (const bool first : {true, false}) {
      const double own = first ? v_i : v_j, other = first ? v_j : v_i;
      const double before = HeadOnCollision{2.5, e, c}.velocity_after(own, other);
      const double after = collide_and_slide(own, other, e, c).v;
      sum += before * before - after * after;
    }
    return sum / (v_i * v_i + v_j * v_j);
  };
  EXPECT_NEAR(lost(0.1, 0, 1, 0), 20.0 / 49, 1e-13);
  EXPECT_NEAR(lost(0.1, -0.1, 1, 0), 40.0 / 49, 1e-13);
  // K (64) corrected, the sum of (62) corrected and (63): rubbing makes the pair lose more, not
  // less as K has it, [2Ae(1+e) + e² − 1 + 4C(1+A) − 4C²]/(2(1+A)²).
  const double A = 2.5, e = 0.9, c = 0.13;
  EXPECT_NEAR(
      lost(0.1, 0, e, c),
      (2 * A * e * (1 + e) + e * e - 1 + 4 * c * (1 + A) - 4 * c * c) / (2 * (1 + A) * (1 + A)),
      1e-13);
  EXPECT_GT(lost(0.1, 0, e, c), lost(0.1, 0, e, 0));
}

TEST(HeadOnCollision, EffectiveRestitutionIsWhatIsLeftOfTheRelativeVelocity) {
  for (double e : {0.4, 0.7, 0.9, 1.0})
    for (double c : {0.0, 0.1}) {
      const HeadOnCollision closed{2.5, e, c};
      const double vi = 0.2, vj = -0.05;
      const double parting = collide_and_slide(vj, vi, e, c).v - collide_and_slide(vi, vj, e, c).v;
      EXPECT_NEAR(closed.effective_restitution(), parting / (vi - vj), 1e-13);
    }
  EXPECT_NEAR((HeadOnCollision{2.5, 0.9, 0}.effective_restitution()), 0.357, 5e-4);
}

TEST(HeadOnCollision, K61ZeroSlidingDistance) {
  EXPECT_NEAR((HeadOnCollision{2.5, 1, 0}.zero_sliding_distance_ratio()), -6, 1e-14);
  for (double e : {0.8, 0.9, 1.0})
    for (double c : {0.0, 0.1}) {
      const double ratio = HeadOnCollision{2.5, e, c}.zero_sliding_distance_ratio();
      EXPECT_NEAR(collide_and_slide(0.1 * ratio, 0.1, e, c).s, 0, 1e-15) << e << ' ' << c;
    }
}

}  // namespace
}  // namespace slipcheck
