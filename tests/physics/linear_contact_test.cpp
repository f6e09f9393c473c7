#include "physics/contact/linear_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../support/extremes.h"
#include "../support/runge_kutta.h"

namespace slipcheck {
namespace {

using End = LinearContact::End;

/// A collision by itself: m̄ ξ̈ = −k ξ − γ m̄ ξ̇ from ξ = 0, ξ̇ = v by Runge-Kutta, the end found by
/// halving the last step. Its error is of order h⁴, here below 1e-11.
struct Collision {
  double time, restitution, largest_overlap;
};
Collision integrated(const LinearContact& contact, double v, End end) {
  const double w2 = contact.stiffness() / contact.reduced_mass(), gamma = contact.damping_rate();
  double deepest = 0;
  const auto rate = [&](double, const Vector3& s) {  // of ξ, ξ̇, t
    return Vector3(s[1], -w2 * s[0] - gamma * s[1], 1);
  };
  const auto over = [&](const Vector3& s) {
    return end == End::zero_overlap ? s[0] < 0 : w2 * s[0] + gamma * s[1] < 0;
  };
  const auto seen = [&](const Vector3& s) { deepest = test::largest_of(deepest, s[0]); };
  const Vector3 last =
      test::integrate_until(over, rate, Vector3(0, v, 0), 1e-3 / std::sqrt(w2), 1e-18, seen);
  return {last[2], -last[1] / v, deepest};
}

TEST(LinearContact, CollisionMatchesTheIntegratedForceLaw) {
  for (End end : {End::zero_overlap, End::zero_force})
    for (double ratio : {0.0, 0.07, 0.5, 1.5, 2.0, 4.0}) {
      if (ratio >= 2 && end == End::zero_overlap) continue;  // never ends
      const double k = 2e6, m = 1.3e-4;
      const LinearContact contact(m, k, ratio * std::sqrt(k / m), end);
      const Collision found = integrated(contact, 0.1, end);
      EXPECT_NEAR(contact.collision_time() / found.time, 1, 1e-9) << ratio;
      EXPECT_NEAR(contact.restitution(), found.restitution, 1e-9) << ratio;
      // The deepest of the frames, a thousandth of a radian from the turning point.
      EXPECT_NEAR(contact.largest_overlap(0.1) / found.largest_overlap, 1, 1e-6) << ratio;
    }
}

TEST(LinearContact, EachEndRuleInvertsItsOwnRelation) {
  for (End end : {End::zero_overlap, End::zero_force})
    for (double e : {0.2, 0.5, 0.9, 1.0}) {
      const LinearContact by_time = LinearContact::with_collision_time(1.3e-4, e, 2.55e-5, end);
      EXPECT_NEAR(by_time.restitution(), e, 1e-14);
      EXPECT_NEAR(by_time.collision_time(), 2.55e-5, 1e-18);
      const LinearContact by_stiffness = LinearContact::with_stiffness(1.3e-4, e, 1e6, end);
      EXPECT_NEAR(by_stiffness.restitution(), e, 1e-14);
      EXPECT_DOUBLE_EQ(by_stiffness.stiffness(), 1e6);
    }
}

TEST(LinearContact, DampingSetForZeroOverlapGives90203UnderTheClamp) {
  // Measured by integration (physics notes): 0.90203 for e_n = 0.9.
  const LinearContact set =
      LinearContact::with_collision_time(1.3e-4, 0.9, 2.55e-5, End::zero_overlap);
  const LinearContact clamped(set.reduced_mass(), set.stiffness(), set.damping_rate(),
                              End::zero_force);
  EXPECT_NEAR(clamped.restitution(), 0.90203, 5e-6);
}

TEST(LinearContact, DampingRateAndTimeUnderBothEndRules) {
  for (End end : {End::zero_overlap, End::zero_force})
    for (double rate : {0.0, 1e3, 1e5, 1e6}) {
      const LinearContact contact = LinearContact::with_damping_rate(1.3e-4, rate, 2.55e-5, end);
      EXPECT_EQ(contact.damping_rate(), rate);
      EXPECT_NEAR(contact.collision_time() / 2.55e-5, 1, 1e-13) << rate;
    }
}

TEST(LinearContact, TheClampReachesEveryRestitution) {
  // e^−2 at critical damping, in proportion to ε^−2 far above it.
  const LinearContact critical(1, 1, 2, End::zero_force);
  EXPECT_NEAR(critical.restitution(), std::exp(-2.0), 1e-15);
  EXPECT_NEAR(critical.collision_time(), 2, 1e-15);
  for (double e : {1e-6, 0.01, 0.1353, 0.1354}) {
    const LinearContact contact = LinearContact::with_stiffness(1.3e-4, e, 1e6, End::zero_force);
    EXPECT_NEAR(contact.restitution() / e, 1, 1e-12);
    EXPECT_EQ(contact.is_over_critical(), e < std::exp(-2.0));
  }
}

TEST(LinearContact, OverCriticalNeverReachesZeroOverlap) {
  for (double ratio : {2.0, 3.0}) {
    const LinearContact contact(1, 1, ratio, End::zero_overlap);
    EXPECT_EQ(contact.restitution(), 0);
    EXPECT_EQ(contact.collision_time(), std::numeric_limits<double>::infinity());
  }
  // Critical: ξ = v t e^(−ω0 t), deepest at 1/ω0.
  EXPECT_NEAR(LinearContact(1, 1, 2, End::zero_overlap).largest_overlap(1), std::exp(-1.0), 1e-15);
}

TEST(Rubbing, K55FirstOrderAndExponential) {
  // Steel, R = 2 mm, t_col = 2.55e-5 s, e_n = 0.9, γ_S = γ_N/2: 0.132 and 0.116 (physics notes).
  const LinearContact contact =
      LinearContact::with_collision_time(1.3e-4, 0.9, 2.55e-5, End::zero_overlap);
  const double c = rubbing_constant(2.5, 0.5 * contact.damping_rate(), contact.contact_frequency());
  EXPECT_NEAR(c, 0.132, 5e-4);
  EXPECT_NEAR(rubbed_share(c), 0.116, 5e-4);
}

}  // namespace
}  // namespace slipcheck
