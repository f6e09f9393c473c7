#include "physics/contact/collision.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace slipcheck {
namespace {

struct TwoBodies {
  Sphere a{0.002, 2e-4, 0.4}, b{0.002, 2e-4, 0.4};
  SubstrateContact substrate;
  BodyState sa, sb;
  bool supported = false;

  CollisionResult collide_with(const PairContact& contact, const CollisionRule& rule = {}) {
    return collide(contact, rule, {a, substrate, sa, supported}, {b, substrate, sb, supported});
  }
  Vector3 contact_velocity() const {
    const Vector3 n = (sa.position - sb.position).normalized();
    return sa.velocity - sb.velocity -
           (a.radius * sa.angular_velocity + b.radius * sb.angular_velocity).cross(n);
  }
  Vector3 momentum() const { return a.mass * sa.velocity + b.mass * sb.velocity; }
  Vector3 angular_momentum() const {
    return a.mass * sa.position.cross(sa.velocity) + b.mass * sb.position.cross(sb.velocity) +
           a.moment_of_inertia() * sa.angular_velocity +
           b.moment_of_inertia() * sb.angular_velocity;
  }
  double energy() const {
    return 0.5 * (a.mass * sa.velocity.squaredNorm() + b.mass * sb.velocity.squaredNorm() +
                  a.moment_of_inertia() * sa.angular_velocity.squaredNorm() +
                  b.moment_of_inertia() * sb.angular_velocity.squaredNorm());
  }
};

/// Two rolling balls on the line x that have just met.
TwoBodies rolling_pair(double v_a, double v_b) {
  TwoBodies pair;
  pair.supported = true;
  pair.substrate.kinetic_friction = 0.1;
  pair.substrate.static_friction = 0.1;
  pair.sa.position = {-0.002, 0, 0.002};
  pair.sb.position = {0.002, 0, 0.002};
  pair.sa.velocity.x() = v_a;
  pair.sb.velocity.x() = v_b;
  pair.sa.angular_velocity = rolling_angular_velocity(pair.sa.velocity, 0.002);
  pair.sb.angular_velocity = rolling_angular_velocity(pair.sb.velocity, 0.002);
  return pair;
}

TEST(Collision, FreeUnlikeSpheresConserveAndFollowBothRestitutions) {
  std::mt19937_64 random(3);
  const auto u = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  for (int n = 0; n < 2000; ++n) {
    TwoBodies pair;
    pair.a = {0.002 * (1.5 + u()), 1e-4 * (1.5 + u()), 0.5 + 0.4 * u()};
    pair.b = {0.002 * (1.5 + u()), 1e-4 * (1.5 + u()), 0.5 + 0.4 * u()};
    const Vector3 n_ab = Vector3(u(), u(), u()).normalized();
    pair.sa.position = (pair.a.radius + pair.b.radius) * n_ab;
    pair.sa.velocity = {u(), u(), u()};
    pair.sb.velocity = pair.sa.velocity + (1.1 + u()) * n_ab + n_ab.cross(Vector3(u(), u(), u()));
    pair.sa.angular_velocity = 100 * Vector3(u(), u(), u());
    pair.sb.angular_velocity = 100 * Vector3(u(), u(), u());
    const PairContact contact{0.5 + 0.5 * u(), 0.3 * (1 + u()), u()};
    const TwoBodies before = pair;
    const Vector3 u0 = before.contact_velocity();
    const CollisionResult result = pair.collide_with(contact);
    const Vector3 u1 = pair.contact_velocity();

    const double e = std::get<double>(contact.restitution);
    const double un = n_ab.dot(u0);
    EXPECT_NEAR(n_ab.dot(u1), -e * un, 1e-13);
    EXPECT_LE((pair.momentum() - before.momentum()).norm(), 1e-18);
    EXPECT_LE((pair.angular_momentum() - before.angular_momentum()).norm(), 1e-20);
    EXPECT_LE(pair.energy(), before.energy() * (1 + 1e-14));

    // L (8), (11) with the κ of B (8): u_t' = −β u_t, β = min[β0, β1].
    const auto [ma, mb, qa, qb] =
        std::array{pair.a.mass, pair.b.mass, pair.a.shape_factor, pair.b.shape_factor};
    const double kappa = 1 / (1 + (ma * qa + mb * qb) / (qa * qb * (ma + mb)));
    const Vector3 ut0 = u0 - un * n_ab, ut1 = u1 - n_ab.dot(u1) * n_ab;
    const double beta1 =
        -1 + std::get<double>(contact.friction) * (1 + e) * std::abs(un) / (kappa * ut0.norm());
    const double beta = std::min(contact.tangential_restitution, beta1);
    EXPECT_LE((ut1 + beta * ut0).norm(), 1e-12);
    EXPECT_NEAR(result.impact_speed, -un, 1e-14);
  }
}

TEST(Collision, ElasticAndPerfectlyRoughConservesEnergy) {
  TwoBodies pair;
  pair.sa.position = {0.004, 0, 0};
  pair.sa.velocity = {-1, 0.3, 0.2};
  pair.sa.angular_velocity = {50, 60, 70};
  const double before = pair.energy();
  pair.collide_with({1.0, 1e9, 1.0});
  EXPECT_NEAR(pair.energy(), before, 1e-17);
}

TEST(Collision, SymmetricRollingPairDoesNotRub) {
  TwoBodies pair = rolling_pair(0.15, -0.15);
  pair.collide_with({0.9, 0.5, 0.0});
  EXPECT_NEAR(pair.sa.velocity.x(), -0.135, 1e-16);
  EXPECT_EQ(pair.sa.velocity.z(), 0);
  EXPECT_EQ(pair.sb.velocity.z(), 0);
  EXPECT_DOUBLE_EQ(pair.sa.angular_velocity.y(), 0.15 / 0.002);
}

TEST(Collision, RollingBallStrikesTargetAtRestPressesItAndIsLiftedByIt) {
  // The striker's front goes down and rubs the target's back downwards.
  TwoBodies pair = rolling_pair(0.3, 0);
  pair.substrate.kinetic_friction = 0;  // so that the reaction alone is seen
  pair.collide_with({0.9, 0.05, 0.0});
  // Sliding contact: vertical impulse μ (1 + e) m v/2, on the striker upwards.
  const double impulse = 0.05 * 1.9 * 2e-4 * 0.3 / 2;
  EXPECT_NEAR(pair.sa.velocity.z(), impulse / 2e-4, 1e-15);
  EXPECT_EQ(pair.sb.velocity.z(), 0);  // the substrate takes it
  // Both spins change alike, against the striker's.
  const double dw = impulse * 0.002 / pair.a.moment_of_inertia();
  EXPECT_NEAR(pair.sa.angular_velocity.y(), 0.3 / 0.002 - dw, 1e-11);
  EXPECT_NEAR(pair.sb.angular_velocity.y(), -dw, 1e-11);
}

TEST(Collision, ReactionOfTheSubstrateRubsThePressedBall) {
  TwoBodies without = rolling_pair(0.3, 0), with = without;
  without.substrate.kinetic_friction = 0;
  without.collide_with({0.9, 0.05, 0.0});
  with.collide_with({0.9, 0.05, 0.0});
  // μ_k times the reaction against the target's slip, which is forward.
  const double reaction = 0.05 * 1.9 * 2e-4 * 0.3 / 2;
  EXPECT_NEAR(with.sb.velocity.x(), without.sb.velocity.x() - 0.1 * reaction / 2e-4, 1e-15);
  EXPECT_EQ(with.sa.velocity, without.sa.velocity);
}

TEST(Collision, StickingContactOfConfinedSpheresExchangesHalfTheSpins) {
  // K (55) in the limit of strong rubbing: ΔΩ = −½ (Ω_i + Ω_j), since no centre moves vertically.
  TwoBodies pair = rolling_pair(0.3, -0.1);
  pair.substrate.kinetic_friction = 0;
  const double sum = pair.sa.angular_velocity.y() + pair.sb.angular_velocity.y();
  const double before = pair.sa.angular_velocity.y();
  pair.collide_with({0.9, 1e9, 0.0}, {.confined = true});
  EXPECT_NEAR(pair.sa.angular_velocity.y(), before - 0.5 * sum, 1e-11);
  EXPECT_EQ(pair.sa.velocity.z(), 0);
  EXPECT_EQ(pair.sb.velocity.z(), 0);
  EXPECT_NEAR(pair.contact_velocity().z(), 0, 1e-15);
}

TEST(Collision, StickingContactWithOneBallFreeToRise) {
  // Only the lifted ball's centre yields: C_z = (1 + 2A)/m, so P_z = m v/(1 + 2A) = m v/6.
  TwoBodies pair = rolling_pair(0.3, 0);
  pair.substrate.kinetic_friction = 0;
  pair.collide_with({0.9, 1e9, 0.0});
  EXPECT_NEAR(pair.sa.velocity.z(), 0.3 / 6, 1e-15);
  EXPECT_NEAR(pair.contact_velocity().z(), 0, 1e-15);
}

TEST(Collision, SmallBallUnderALargeOneIsHeldByThePlane) {
  // Unlike radii: the normal is inclined, the small ball is pressed down by the blow itself.
  TwoBodies pair;
  pair.supported = true;
  pair.a = {0.001, 1e-4, 0.4};
  pair.b = {0.004, 64e-4, 0.4};
  pair.sa.position = {0, 0, 0.001};
  pair.sb.position = {0.004, 0, 0.004};  // |Δ|² = 16 + 9 = 25 mm²
  pair.sa.velocity.x() = 1;
  pair.collide_with({0.8, 0.0, -1.0});
  const Vector3 n = (pair.sa.position - pair.sb.position).normalized();
  EXPECT_EQ(pair.sa.velocity.z(), 0);
  EXPECT_GT(pair.sb.velocity.z(), 0);
  EXPECT_NEAR(n.dot(pair.sa.velocity - pair.sb.velocity), -0.8 * n.x(), 1e-15);
}

TEST(Collision, SlowestReboundKeepsAPairFromStayingTogether) {
  TwoBodies pair = rolling_pair(1e-9, -1e-9);
  pair.collide_with({0.5, 0.0, -1.0}, {.slowest_rebound = 1e-6});
  EXPECT_NEAR(pair.sb.velocity.x() - pair.sa.velocity.x(), 1e-6, 1e-20);
}

TEST(Restitution, BridgesPowerLawIsCappedAtOne) {
  // Bridges, Hatzes and Lin: ε = 0.32 v^−0.234, v in cm/s.
  const RestitutionLaw ice = PowerLawRestitution{0.32, 0.234, 0.01};
  EXPECT_DOUBLE_EQ(restitution_at(ice, 0.01), 0.32);
  EXPECT_NEAR(restitution_at(ice, 0.02), 0.32 * std::pow(2, -0.234), 1e-16);
  EXPECT_EQ(restitution_at(ice, 1e-6), 1);
}

}  // namespace
}  // namespace slipcheck
