// One test for each misprint of Kondic (K), Brilliantov et al. (B) and Luding (L) that
// physics-notes.md and docs/model.md list: the corrected equation meets the integrated forces, the
// printed one does not. Rows (44), (55), (61), (62), D and F have theirs beside the functions in
// closed_forms_test.cpp and pair_insight_test.cpp.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "../support/runge_kutta.h"
#include "physics/closed_forms.h"
#include "physics/contact/collision.h"
#include "physics/contact/elastic_pair.h"
#include "physics/contact/normal_force.h"
#include "physics/contact/pair_insight.h"
#include "physics/contact/tangential_force.h"
#include "soft_pair.h"

namespace slipcheck {
namespace {

using test::integrated;
using test::SoftPair;
using test::SubstrateFriction;

constexpr double kGravity = 9.81;
constexpr double kRadius = 0.002;
const double kMass = 7850 * 4 * M_PI / 3 * std::pow(kRadius, 3);
const Sphere kBall{kRadius, kMass, 0.4};

LinearContact elastic_steel() {
  return LinearContact::with_collision_time(kMass / 2, 1, 2.55e-5, ContactEnd::zero_overlap);
}
RollingPair symmetric_pair(double v_rel) {
  RollingPair pair;
  pair.spheres = {RollingSphere{kBall, v_rel / 2, 0.5, 0.1},
                  RollingSphere{kBall, -v_rel / 2, 0.5, 0.1}};
  pair.gravity = kGravity;
  pair.confined = true;
  return pair;
}

/// A ball on a substrate that is accelerated, in the substrate's frame: the lowest point sticks as
/// far as a friction of `viscosity` u, at most `cap`, holds it. Acceleration and slip once that is
/// steady.
struct OnSubstrate {
  Vector3 acceleration, slip;
};
OnSubstrate carried(const Vector3& downhill, const Vector3& substrate, double cap) {
  const double viscosity = 20 * kMass / 1e-3;
  const Vector3 lever = -kRadius * Vector3::UnitZ();
  const auto rates = [&](double, const BodyState& s) {
    const Vector3 u = s.velocity + s.angular_velocity.cross(lever);
    const double size = u.norm();
    Vector3 force = -viscosity * u;
    if (viscosity * size > cap) force = -cap / size * u;
    return test::Rates{downhill - substrate + force / kMass,
                       lever.cross(force) / kBall.moment_of_inertia()};
  };
  // The transient falls as exp(−(1 + A) 20 t/1 ms): e^-35 in half a millisecond.
  const BodyState early = test::integrate({}, 0.5e-3, 2000, rates);
  const BodyState late = test::integrate(early, 0.5e-3, 2000, rates);
  return {(late.velocity - early.velocity) / 0.5e-3 + substrate, slip_velocity(late, kRadius)};
}

TEST(KondicErratum, K24GravityBesideTheCollisionForces) {
  const Vector3 downhill(0, -1.7, 0), substrate(0.6, 0.4, 0);
  const Vector3 found = rolling_acceleration(2.5, downhill, substrate);
  EXPECT_LE((found - carried(downhill, substrate, 1).acceleration).norm(), 1e-9);
  EXPECT_LE((found - (5.0 / 7 * downhill + 2.0 / 7 * substrate)).norm(), 1e-15);
  // Printed: (2/7)(a_S + a_G).
  EXPECT_GT((found - 2.0 / 7 * (substrate + downhill)).norm(), 0.4 * downhill.norm());
}

TEST(KondicErratum, K25StickingIsLimitedByTheSubstratesNormalForce) {
  // No collision, F_N^c = 0, yet it rolls, up to 1.75 g with μ_s = 1/2.
  const double limit = rolling_limit(2.5, 0.5, kGravity);
  EXPECT_NEAR(limit, 1.75 * kGravity, 1e-14);
  const double cap = 0.5 * kMass * kGravity;
  const double stuck = limit * kMass / (3.5 * 20 * kMass / 1e-3);  // what the viscous law lets slip
  EXPECT_LT(carried({0, 0, 0}, {0.999 * limit, 0, 0}, cap).slip.norm(), stuck);
  EXPECT_GT(carried({0, 0, 0}, {1.01 * limit, 0, 0}, cap).slip.norm(), 1.1 * stuck);
  // Downhill pulls against it.
  EXPECT_LT(carried({0.5 * limit, 0, 0}, {1.499 * limit, 0, 0}, cap).slip.norm(), stuck);
}

TEST(KondicErratum, K33K34SlidingBeginsAtTwiceThePrintedTimeAndOverlap) {
  const LinearContact contact = elastic_steel();
  for (double v : {0.01, 0.03, 0.1}) {
    const RollingPair pair = symmetric_pair(v);
    const SoftPair::Result seen = integrated(contact, pair, SubstrateFriction::on).collide(200'000);
    const SlidingOnset onset = pair_insight(contact, pair).onset;
    const double step = 5e-6 / contact.contact_frequency();
    EXPECT_NEAR(onset.exact_time, seen.slides_from, step);
    // First order in ω0 t_min, which is below 0.03.
    EXPECT_NEAR(onset.time, seen.slides_from, step + 2e-4 * onset.time);
    EXPECT_NEAR(onset.overlap, v * seen.slides_from, v * (step + 2e-4 * onset.time));
    EXPECT_GT(seen.slides_from, 1.9 * (0.5 * onset.time));  // printed: half
  }
}

TEST(KondicErratum, K36K37TurningByTheSubstrateTakesTheDoubledTime) {
  // R ΔΩ while they roll, ½ A μ_s g t_min, and while they slide, A μ_k g (t_col − t_min). The roll
  // counts at small speeds. Next order in ω0 t_min = 0.05.
  const LinearContact contact = elastic_steel();
  const RollingPair pair = symmetric_pair(0.006);
  const PairInsight found = pair_insight(contact, pair);
  const SoftPair::Result seen = integrated(contact, pair, SubstrateFriction::on).collide(200'000);
  const double turned = pair.spheres[0].speed - seen.end.w[0];
  EXPECT_NEAR(found.substrate_turning / turned, 1, 2e-3);
  const double printed = 0.5 * found.onset.time;
  const double with_printed =
      2.5 * kGravity * (0.5 * 0.5 * printed + 0.1 * (found.collision_time - printed));
  EXPECT_GT(std::abs(with_printed / turned - 1), 5e-3);
}

TEST(KondicErratum, C1C4SlowestCollisionThatMakesThemSlide) {
  // v^b = 2 (1 + A) μ_s g/ω0. What rolls through the collision carries m (1 + A)/A, so √(5/7) v^b
  // is the limit for solid spheres, still above the printed half.
  const LinearContact contact = elastic_steel();
  const double v_b = pair_insight(contact, symmetric_pair(0.1)).onset.v_b;
  EXPECT_NEAR(v_b, 2 * 3.5 * 0.5 * kGravity / contact.contact_frequency(), 1e-18);
  const double limit = std::sqrt(5.0 / 7) * v_b;
  const auto slides = [&](double v) {
    return !std::isinf(
        integrated(contact, symmetric_pair(v), SubstrateFriction::on).collide().slides_from);
  };
  EXPECT_FALSE(slides(0.5 * v_b));
  EXPECT_FALSE(slides(0.999 * limit));
  EXPECT_TRUE(slides(1.001 * limit));
}

TEST(KondicErratum, K55K57E13RubbingIsExponentialInTheDurationOfTheContact) {
  // ΔΩ = −½ (1 − e^(−2C))(Ω_i + Ω_j), C = ½ A γ_S t_col without damping: (E13) lost t_col.
  for (double t_col : {1e-5, 2.55e-5, 1e-4})
    for (double rate : {100.0, 4000.0, 20000.0}) {
      const LinearContact contact =
          LinearContact::with_collision_time(kMass / 2, 1, t_col, ContactEnd::zero_overlap);
      RollingPair pair = symmetric_pair(0.1);
      pair.spheres[1].speed = 0;
      pair.rubbing_rate = rate;
      pair.rubbing_friction = std::numeric_limits<double>::infinity();
      const SoftPair::State end = integrated(contact, pair, SubstrateFriction::off).collide().end;
      const double share = 1 - end.w[0] / pair.spheres[0].speed;
      const PairInsight found = pair_insight(contact, pair);
      EXPECT_NEAR(found.rubbing_constant, 0.5 * 2.5 * rate * t_col, 1e-12);
      EXPECT_NEAR(found.exponential_share, share, 1e-4 * share);     // the end falls on a step
      EXPECT_NEAR(end.w[1] / pair.spheres[0].speed, -share, 1e-12);  // rounding of 1e5 steps
      // What the paper's first order is off by: C².
      const double c = found.rubbing_constant;
      EXPECT_NEAR(c - share, c * c, c * c * c + 1e-4 * share);
    }
}

TEST(KondicErratum, AppBCollisionTimeOfSteel) {
  // Hertz with the printed constants, by integration in steps of some 1e-5 of the collision.
  const ElasticMaterial steel{2.06e11, 0.28, 0};
  const double modulus = hertz_modulus(steel, steel, kRadius / 2);
  const auto duration = [&](double rho, double v) {
    const HertzForce force{rho};
    BodyState s;
    s.velocity.x() = v;
    const double h = 2e-10;
    const auto rates = [&](double, const BodyState& y) {
      return test::Rates{-force.elastic(y.position.x()) / (kMass / 2) * Vector3::UnitX(),
                         Vector3::Zero()};
    };
    long n = 0;
    do s = test::integrate(s, h, 1, rates), ++n;
    while (s.position.x() > 0);
    return static_cast<double>(n) * h;
  };
  EXPECT_NEAR(duration(modulus, 0.1), 1.93e-5, 0.005e-5);
  EXPECT_NEAR(duration(modulus, 1.0), 1.22e-5, 0.005e-5);
  // (B1) with half the force makes the printed times, 2^(2/5) too long.
  EXPECT_NEAR(duration(modulus / 2, 0.1), 2.55e-5, 0.005e-5);
  EXPECT_NEAR(duration(modulus / 2, 1.0), 1.61e-5, 0.005e-5);
}

// --- B -------------------------------------------------------------------------------------------

/// Two free spheres in a plane, their line of centres along x (it turns by far less than t_c): a
/// linear spring between them and a tangential force, integrated.
struct FreePair {
  Sphere a, b;
  double v_a = 0, v_b = 0;  // across the line of centres
  double w_a = 0, w_b = 0;

  double slip() const { return v_a - v_b - a.radius * w_a - b.radius * w_b; }
  double energy() const {
    return 0.5 * (a.mass * v_a * v_a + b.mass * v_b * v_b + a.moment_of_inertia() * w_a * w_a +
                  b.moment_of_inertia() * w_b * w_b);
  }
  /// The tangential force on the first over the slip and F_N; F_N = k (g/ω) sin ωt.
  template <class Law>
  void collide(double stiffness, double speed, const Law& law) {
    const double m = effective_mass(a, b), omega = std::sqrt(stiffness / m);
    const auto rate = [&](double t, const Eigen::Vector4d& s) -> Eigen::Vector4d {
      const double normal = stiffness * speed / omega * std::sin(omega * t);
      const double force = law(s[0] - s[1] - a.radius * s[2] - b.radius * s[3], normal);
      return {force / a.mass, -force / b.mass, -a.radius * force / a.moment_of_inertia(),
              -b.radius * force / b.moment_of_inertia()};
    };
    const Eigen::Vector4d s =
        test::integrate(rate, Eigen::Vector4d(v_a, v_b, w_a, w_b), 0, M_PI / omega, 100000);
    v_a = s[0], v_b = s[1], w_a = s[2], w_b = s[3];
  }
};

FreePair unlike_pair() {
  FreePair pair{{0.002, 2e-4, 0.4}, {0.003, 5e-4, 2.0 / 3}};
  pair.v_a = 0.2;
  pair.v_b = -0.1;
  pair.w_a = 30;
  pair.w_b = -50;
  return pair;
}

TEST(BrilliantovErratum, B8B38TangentialRestitutionIsARatioOfVelocities) {
  // For F_T = −γ m_eff g_T without cap: m_eff κ ζ̈ = −γ m_eff ζ̇, ζ̇(t_c)/ζ̇(0) = e^(−γ t_c/κ). Printed
  // is ζ(t_c)/ζ(0), and ζ(0) = 0.
  const FreePair before = unlike_pair();
  const double m = effective_mass(before.a, before.b), k = 1e6;
  const double kappa = tangential_mass_ratio(before.a, before.b);
  for (double gamma : {100.0, 3000.0}) {
    FreePair pair = before;
    const ViscousForce law{gamma * m, 1e9};
    pair.collide(k, 1,
                 [&](double u, double) { return -std::copysign(law.viscous(std::abs(u)), u); });
    const double t_c = M_PI / std::sqrt(k / m);
    EXPECT_NEAR(pair.slip() / before.slip(), std::exp(-gamma * t_c / kappa), 1e-9);
  }
  EXPECT_NEAR(tangential_mass_ratio(kBall, kBall), 2.0 / 7, 1e-16);
}

TEST(BrilliantovErratum, B39FrictionIsAgainstTheSlip) {
  for (double friction : {0.02, 0.2, 5.0}) {
    FreePair pair = unlike_pair();
    const double m = effective_mass(pair.a, pair.b), k = 1e6, g = 0.5;
    const ViscousForce law{5e3 * m, friction};
    const double start = pair.slip(), energy = pair.energy();
    pair.collide(k, g, [&](double u, double normal) {
      return -std::copysign(std::min(law.viscous(std::abs(u)), law.cap(normal)), u);
    });
    EXPECT_LT(pair.energy(), energy);
    EXPECT_GT(pair.slip() / start, 0);
    EXPECT_LT(pair.slip() / start, 1);
    // Coulomb alone: Δg_T = −μ 2 g/κ, which this one comes near where it is capped throughout.
    const double coulomb = 1 - friction * 2 * g / tangential_mass_ratio(pair.a, pair.b) / start;
    EXPECT_GT(pair.slip() / start, coulomb - 1e-9);
    if (friction == 0.02) {
      EXPECT_NEAR(pair.slip() / start, coulomb, 1e-2);
    }

    // Printed: −sgn(g_T) min{−γ m_eff |g_T|, μ F_N} is −γ m_eff |g_T| wherever F_N pushes, and
    // drives the slip on.
    FreePair driven = unlike_pair();
    driven.collide(k, g, [&](double u, double normal) {
      return -std::copysign(1, u) * std::min(-law.viscous(std::abs(u)), law.cap(normal));
    });
    EXPECT_GT(driven.energy(), energy);
  }
}

/// Two free hard spheres that collide obliquely.
struct HardPair {
  Sphere a{0.002, 2e-4, 0.4}, b{0.003, 5e-4, 2.0 / 3};
  SubstrateContact substrate;
  BodyState sa, sb;

  Vector3 n() const { return (sa.position - sb.position).normalized(); }
  Vector3 relative() const {
    return sa.velocity - sb.velocity -
           (a.radius * sa.angular_velocity + b.radius * sb.angular_velocity).cross(n());
  }
  CollisionResult collide_with(const PairContact& contact) {
    return collide(contact, {}, {a, substrate, sa, false}, {b, substrate, sb, false});
  }
};

HardPair oblique_pair(std::mt19937_64& random) {
  const auto u = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  HardPair pair;
  const Vector3 n = Vector3(u(), u(), u()).normalized();
  pair.sa.position = (pair.a.radius + pair.b.radius) * n;
  pair.sa.velocity = -(1.5 + u()) * n + n.cross(Vector3(u(), u(), u()));
  pair.sb.velocity = 0.1 * Vector3(u(), u(), u());
  pair.sa.angular_velocity = 100 * Vector3(u(), u(), u());
  pair.sb.angular_velocity = 100 * Vector3(u(), u(), u());
  return pair;
}

TEST(BrilliantovErratum, B42B43ImpulsesOfBothRestitutions) {
  // P = κ m_eff (ε^T − 1) g_T − m_eff (1 + ε^N) g_N, Δv_1 = P/m_1, Δω_1 = −(R_1/J_1) n×P, and for
  // the second −P and −(R_2/J_2) n×P.
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const HardPair before = oblique_pair(random);
    HardPair pair = before;
    const double e_n = 0.7, e_t = 0.3;  // ε^T = −β0, friction without bound
    const Vector3 n = before.n(), g = before.relative(), g_n = n.dot(g) * n, g_t = g - g_n;
    const double m = effective_mass(pair.a, pair.b);
    const double kappa = tangential_mass_ratio(pair.a, pair.b);
    const Vector3 P = kappa * m * (e_t - 1) * g_t - m * (1 + e_n) * g_n;
    const CollisionResult result = pair.collide_with({e_n, 1e9, -e_t});
    EXPECT_LE((result.impulse - P).norm(), 1e-17);
    EXPECT_LE((pair.sa.velocity - before.sa.velocity - P / pair.a.mass).norm(), 1e-13);
    EXPECT_LE((pair.sb.velocity - before.sb.velocity + P / pair.b.mass).norm(), 1e-13);
    for (const auto& [sphere, after, start] :
         {std::tuple(pair.a, pair.sa, before.sa), std::tuple(pair.b, pair.sb, before.sb)}) {
      const Vector3 turn = -(sphere.radius / sphere.moment_of_inertia()) * n.cross(P);
      EXPECT_LE((after.angular_velocity - start.angular_velocity - turn).norm(), 1e-9);
    }
    // The impulses alone: both restitutions, momentum and angular momentum.
    EXPECT_LE((pair.relative() - (e_t * g_t - e_n * g_n)).norm(), 1e-13);
    const auto momentum = [](const HardPair& p) {
      return Vector3(p.a.mass * p.sa.velocity + p.b.mass * p.sb.velocity);
    };
    const auto angular = [](const HardPair& p) {
      return Vector3(p.a.mass * p.sa.position.cross(p.sa.velocity) +
                     p.b.mass * p.sb.position.cross(p.sb.velocity) +
                     p.a.moment_of_inertia() * p.sa.angular_velocity +
                     p.b.moment_of_inertia() * p.sb.angular_velocity);
    };
    EXPECT_LE((momentum(pair) - momentum(before)).norm(), 1e-18);
    EXPECT_LE((angular(pair) - angular(before)).norm(), 1e-20);
    // Printed, with the factor m_eff/(2 m_1) on both parts: they do not part with ε^N.
    const auto printed = [&](double mass, double sign) {
      return sign * m / (2 * mass) * ((e_t - 1) * g_t - (1 + e_n) * g_n);
    };
    const Vector3 parting = g + printed(pair.a.mass, 1) - printed(pair.b.mass, -1);
    EXPECT_GT(std::abs(parting.dot(n) / g.dot(n) + e_n), 0.5);
  }
}

TEST(BrilliantovErratum, Figure2RoughReversesAndSmoothKeepsTheTangentialVelocity) {
  // Printed: "ε^T → −1" in both limits.
  std::mt19937_64 random(8);
  const HardPair before = oblique_pair(random);
  const Vector3 n = before.n();
  const auto tangential = [&](const HardPair& p) {
    return Vector3(p.relative() - n.dot(p.relative()) * n);
  };
  HardPair rough = before, smooth = before;
  rough.collide_with({1.0, 1e9, 1.0});
  smooth.collide_with({1.0, 0.0, 1.0});
  EXPECT_LE((tangential(rough) + tangential(before)).norm(), 1e-13);
  EXPECT_LE((tangential(smooth) - tangential(before)).norm(), 1e-13);
}

// --- L -------------------------------------------------------------------------------------------

TEST(Luding, L5L12TangentsOfTheAnglesBeforeAndAfter) {
  // Ψ = g_t/g_n with g_n that before the impact: Ψ2 = −β0 Ψ1 where the contact sticks and
  // Ψ1 − (1 + 1/q)(1 + e) μ where it slides; equal spheres.
  std::mt19937_64 random(9);
  int sticks = 0, slides = 0;
  for (int trial = 0; trial < 300; ++trial) {
    HardPair pair = oblique_pair(random);
    pair.b = pair.a;
    pair.sa.position = 2 * pair.a.radius * pair.n();
    const Vector3 n = pair.n(), g = pair.relative();
    const double e = 0.9, mu = 0.1, beta0 = 0.4;
    const Vector3 g_t = g - g.dot(n) * n;
    const double psi1 = g_t.norm() / -g.dot(n);
    pair.collide_with({e, mu, beta0});
    const double psi2 = pair.relative().dot(g_t.normalized()) / -g.dot(n);
    const double sliding = psi1 - (1 + 1 / 0.4) * (1 + e) * mu, sticking = -beta0 * psi1;
    EXPECT_NEAR(psi2, std::max(sliding, sticking), 1e-12 * (1 + psi1));
    ++(sliding > sticking ? slides : sticks);
  }
  EXPECT_GT(sticks, 20);
  EXPECT_GT(slides, 20);
}

}  // namespace
}  // namespace slipcheck
