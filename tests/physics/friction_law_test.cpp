// Friction over the speed of slip, in both rules of collision.

#include <gtest/gtest.h>

#include <cmath>

#include "physics/contact/collision.h"
#include "physics/contact/elastic_pair.h"
#include "physics/contact/planar_collision.h"

namespace slipcheck {
namespace {

constexpr ExponentialFriction kAlciatore{9.951e-3, 0.108, 1.088};

double alciatore(double v) { return 9.951e-3 + 0.108 * std::exp(-1.088 * v); }

TEST(FrictionLaw, GoesThroughMarlowsPointsToTheirDigits) {
  // TP A.14: 0.11, 0.06 and 0.01 at 0.1, 1 and 10 m/s times sin 45°.
  const FrictionLaw law = kAlciatore;
  EXPECT_NEAR(friction_at(law, 0.1 * M_SQRT1_2), 0.11, 0.005);
  EXPECT_NEAR(friction_at(law, M_SQRT1_2), 0.06, 0.005);
  EXPECT_NEAR(friction_at(law, 10 * M_SQRT1_2), 0.01, 0.005);
}

TEST(FrictionLaw, ATableIsLinearBetweenItsPointsAndConstantOutside) {
  const FrictionLaw law = TabulatedFriction({{0.5, 0.1}, {1.5, 0.04}});
  EXPECT_EQ(friction_at(law, 0), 0.1);
  EXPECT_NEAR(friction_at(law, 1), 0.07, 1e-16);
  EXPECT_EQ(friction_at(law, 9), 0.04);
}

TEST(FrictionLaw, OtherUnitsOfSpeedChangeNoValue) {
  for (const FrictionLaw& law : {FrictionLaw(0.2), FrictionLaw(kAlciatore),
                                 FrictionLaw(TabulatedFriction({{0, 1}, {2, 0}}))})
    EXPECT_NEAR(friction_at(with_speeds_times(law, 40), 40 * 0.7), friction_at(law, 0.7), 1e-15);
}

TEST(FrictionLaw, OnlyWhatIsZeroAtAllSpeedsIsNone) {
  EXPECT_FALSE(has_friction(0));
  EXPECT_TRUE(has_friction(kAlciatore));
  EXPECT_TRUE(has_friction(TabulatedFriction({{0, 0}, {1, 0.1}})));
  EXPECT_FALSE(has_friction(TabulatedFriction({{0, 0}, {1, 0}})));
}

/// The throw of an object ball at rest by a cue ball without spin that cuts it at the angle φ.
double throw_angle(double speed, double phi, const FrictionLaw& friction) {
  const Sphere ball{0.028575, 0.17, 0.4};
  const SubstrateContact none;
  const PairContact contact{1.0, friction, 0};
  const Vector3 n(1, 0, 0);  // from the cue ball to the object ball
  BodyState cue, object;
  object.position = 2 * ball.radius * n;
  cue.velocity = speed * Vector3(std::cos(phi), std::sin(phi), 0);
  collide(contact, {}, {ball, none, cue, false}, {ball, none, object, false});
  return std::atan2(object.velocity.y(), object.velocity.x());
}

TEST(FrictionLaw, ThrowIsThatOfAlciatoresTPA14) {
  // tan θ = min(μ(v_rel) v cos φ/v_rel, 1/7) v sin φ/(v cos φ) with v_rel = v sin φ.
  for (const double v : {0.5, 2.0, 6.0})
    for (const double degrees : {5.0, 20.0, 30.0, 60.0}) {
      const double phi = degrees * M_PI / 180, v_rel = v * std::sin(phi);
      const double expected = std::atan(
          std::min(alciatore(v_rel) * v * std::cos(phi) / v_rel, 1.0 / 7) * std::tan(phi));
      EXPECT_NEAR(throw_angle(v, phi, kAlciatore), expected, 1e-14) << v << ' ' << degrees;
    }
}

TEST(FrictionLaw, ALawThatIsOneNumberDoesWhatTheNumberDoes) {
  for (const double phi : {0.1, 0.6, 1.2}) {
    const double number = throw_angle(2, phi, 0.06);
    EXPECT_EQ(throw_angle(2, phi, ExponentialFriction{0.06, 0, 1}), number);
    EXPECT_EQ(throw_angle(2, phi, TabulatedFriction({{0, 0.06}, {1, 0.06}})), number);
  }
}

TEST(FrictionLaw, TheRuleInThePlaneIsTheOneInSpace) {
  const double m = 0.17, kappa = 2.0 / 7;
  for (const double u_t : {-3.0, -0.2, 0.01, 0.4, 5.0}) {
    const PairContact law{0.9, kAlciatore, 0};
    const PairContact number{0.9, alciatore(std::abs(u_t)), 0};
    const PlanarImpulse a = planar_impulse(law, 0.9, m / 2, kappa, -1.5, u_t);
    const PlanarImpulse b = planar_impulse(number, 0.9, m / 2, kappa, -1.5, u_t);
    EXPECT_DOUBLE_EQ(a.tangential, b.tangential);
    EXPECT_DOUBLE_EQ(a.dissipated, b.dissipated);
    EXPECT_NE(a.tangential, 0);
  }
}

}  // namespace
}  // namespace slipcheck
