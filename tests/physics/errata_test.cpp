// One test for each misprint of Kondic (K), Brilliantov et al. (B) and Luding (L) that
// docs/model.md lists: the corrected equation meets the integrated forces, the printed one does
// not. Rows (44), (55), (61), (62), D and F have theirs beside the functions in
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
#include "physics/contact/planar_collision.h"
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

TEST(KondicErratum, K39DampingTakesAQuarterOfPiEpsilonFromTheOverlap) {
  // x_max = (v/ω0)(1 − (π/4) ε); printed: (π/2) ε.
  for (const double epsilon : {0.01, 0.067}) {
    const double omega0 = elastic_steel().contact_frequency();
    const LinearContact contact(kMass / 2, elastic_steel().stiffness(), epsilon * omega0,
                                ContactEnd::zero_overlap);
    const double seen =
        integrated(contact, symmetric_pair(0.1), SubstrateFriction::off).collide().deepest;
    EXPECT_NEAR(contact.largest_overlap(0.1) / seen, 1, 1e-8);  // one step of 5e-5 radian, squared
    const double share = seen / (0.1 / omega0);
    EXPECT_NEAR(share, 1 - M_PI / 4 * epsilon, epsilon * epsilon);
    EXPECT_GT(share - (1 - M_PI / 2 * epsilon), 0.7 * epsilon);
  }
}

TEST(KondicErratum, DampingRatioIsTwoOverPiOfTheLoss) {
  // ε ≈ (2/π)(1 − e_n), printed with a minus; and ω0, printed 1e-5 s, is 1/(8.1e-6 s).
  for (const double loss : {1e-3, 1e-2}) {
    const auto contact =
        LinearContact::with_collision_time(kMass / 2, 1 - loss, 2.55e-5, ContactEnd::zero_overlap);
    EXPECT_NEAR(contact.damping_ratio() / (2 / M_PI * loss), 1, loss);
  }
  EXPECT_NEAR(1 / elastic_steel().contact_frequency(), 8.1e-6, 0.05e-6);
}

TEST(KondicErratum, VcIsTheOnsetAtTheFirstTouch) {
  // γ_N m̄ v = (1 + A) μ_s m g: v^c = 2 (1 + A) μ_s g/γ_N = 0.416 cm/s with γ_N = −(2/t_col) ln e_n;
  // printed g μ_s/γ_N.
  const auto contact =
      LinearContact::with_collision_time(kMass / 2, 0.9, 2.55e-5, ContactEnd::zero_overlap);
  const double v_c = 2 * 3.5 * 0.5 * kGravity * 2.55e-5 / (-2 * std::log(0.9));
  EXPECT_NEAR(v_c, 0.416e-2, 0.001e-2);
  EXPECT_NEAR(pair_insight(contact, symmetric_pair(0.1)).onset.v_c, v_c, 1e-15);
  const auto slides_from = [&](double v) {
    return integrated(contact, symmetric_pair(v), SubstrateFriction::on).collide().slides_from;
  };
  EXPECT_EQ(slides_from(1.002 * v_c), 0);
  EXPECT_GT(slides_from(0.998 * v_c), 0);
}

TEST(KondicErratum, C8RubbingHoldsTheLiftedSphereByItsWholeForce) {
  // F_N = (1 + A) μ_s m g + F_R [A − (1 + A) μ_s] at the first touch, with F_R = γ_S m̄ |v_p| below
  // the weight: the second term is printed with half of that.
  const auto contact =
      LinearContact::with_collision_time(kMass / 2, 0.9, 2.55e-5, ContactEnd::zero_overlap);
  const double gamma_n = contact.damping_rate(), gamma_s = gamma_n / 2;
  const double v_p = kGravity / gamma_s;  // F_R is half of the weight
  const auto v_m = [&](double of_rubbing) {
    return (2 * 3.5 * 0.5 * kGravity + of_rubbing * gamma_s * v_p * (2.5 - 3.5 * 0.5)) / gamma_n;
  };
  const auto slides_from = [&](double v) {
    RollingPair pair = symmetric_pair(v);
    for (RollingSphere& s : pair.spheres) s.speed += 0.5 * v_p;
    pair.rubbing_rate = gamma_s;
    pair.rubbing_friction = std::numeric_limits<double>::infinity();
    SoftPair soft = integrated(contact, pair, SubstrateFriction::on);
    soft.mu_s[1] = 1e9;  // of the sphere that is pressed down nothing is asked
    return soft.collide().slides_from;
  };
  EXPECT_EQ(slides_from(1.001 * v_m(1)), 0);
  EXPECT_GT(slides_from(0.999 * v_m(1)), 0);
  EXPECT_GT(slides_from(1.001 * v_m(0.5)), 0);
}

TEST(KondicErratum, E6CapOfTheRubbingEndsAtTwiceThePrintedOverlap) {
  // γ_S |v_p| = ν_s ω0² x/ω0·(ω0/|v_m|)…: x_crit/x_max = γ_S |v_p|/(ν_s ω0 |v_m|) without damping.
  const LinearContact contact = elastic_steel();
  const double omega0 = contact.contact_frequency(), gamma_s = 0.02 * omega0, cap = 0.5;
  RollingPair pair = symmetric_pair(0.1);
  pair.spheres[0].speed = 0.1, pair.spheres[1].speed = 0;
  pair.rubbing_rate = gamma_s;
  pair.rubbing_friction = cap;
  SoftPair soft = integrated(contact, pair, SubstrateFriction::off);
  // The largest force of friction while the cap rules is that at its end: F_R = ν_s k x_crit.
  const double critical = gamma_s * 0.1 / (cap * omega0 * 0.1);  // x_crit/x_max
  const double end_of_cap = cap * contact.stiffness() * critical * 0.1 / omega0;
  // Up to there the slip has fallen by A ν_s x_crit²/(x_max²)/2…: of second order in ε.
  EXPECT_NEAR(soft.collide().largest_rubbing / end_of_cap, 1, 2.5 * cap * critical * critical);
  EXPECT_GT(soft.collide().largest_rubbing, 1.9 * (0.5 * end_of_cap));  // printed: half
}

TEST(KondicErratum, K66RubbingAddsToTheLossBySliding) {
  // Of a pair whose target was at rest: v^f² − v^s² of both over v², (2 A e (1 + e) + e² − 1 +
  // 4 C (1 + A) − 4 C²)/(2 (1 + A)²), which grows with C. K says that it falls.
  const auto contact =
      LinearContact::with_collision_time(kMass / 2, 0.9, 2.55e-5, ContactEnd::zero_overlap);
  const auto loss = [&](double rubbing_rate, double& share) {
    RollingPair pair = symmetric_pair(0.1);
    pair.spheres[0].speed = 0.1, pair.spheres[1].speed = 0;
    pair.rubbing_rate = rubbing_rate;
    pair.rubbing_friction = std::numeric_limits<double>::infinity();
    SoftPair soft = integrated(contact, pair, SubstrateFriction::off);
    const SoftPair::State end = soft.collide().end;
    share = -end.w[1] / 0.1;
    double sum = 0;
    for (std::size_t i : {0u, 1u}) {
      soft.mu_k[i] = 0.1;
      const double rolls = soft.slide(end, i).velocity;
      sum += end.v[i] * end.v[i] - rolls * rolls;
    }
    return sum / 0.01;
  };
  const auto expected = [](double C) {
    return (5 * 0.9 * 1.9 + 0.81 - 1 + 14 * C - 4 * C * C) / (2 * 3.5 * 3.5);
  };
  double share = 0;
  EXPECT_NEAR(loss(0, share), expected(0), 1e-5);
  EXPECT_NEAR(expected(0), 0.3412, 5e-5);
  const double rubbed = loss(contact.damping_rate() / 2, share);
  EXPECT_NEAR(rubbed, expected(share), 1e-5);
  EXPECT_GT(rubbed, 0.39);
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

TEST(BrilliantovErratum, B40GainTermTakesTheJacobianOfTheCollision) {
  // The velocities that a collision takes to others fill ε^N (ε^T)² of their volume in three
  // dimensions, the flux of pairs changes by ε^N: the gain term has 1/((ε^N)² (ε^T)²), as printed,
  // for constant coefficients there alone. In a plane the power of ε^T is 1.
  std::mt19937_64 random(11);
  const HardPair before = oblique_pair(random);
  const double e_n = 0.8, e_t = 0.4;
  const auto jacobian = [&](bool planar) {
    // Central differences of a linear map: exact but for rounding.
    const Vector3 n = before.n(), k = Vector3::UnitZ();
    const int size = planar ? 6 : 12;
    Eigen::MatrixXd columns(size, size);
    const auto collided = [&](int i, double h) {
      HardPair pair = before;
      for (BodyState* s : {&pair.sa, &pair.sb}) {
        if (!planar) break;
        s->velocity.z() = 0;
        s->angular_velocity = s->angular_velocity.z() * k;
      }
      if (planar) {  // on the side from which they approach
        const Vector3 side = 0.005 * n.cross(k).normalized();
        pair.sa.position =
            (pair.sa.velocity - pair.sb.velocity).dot(side) < 0 ? side : Vector3(-side);
      }
      const auto value = [&](int j) -> double& {
        BodyState& s = j < size / 2 ? pair.sa : pair.sb;
        const int c = j % (size / 2);
        if (planar) return c < 2 ? s.velocity[c] : s.angular_velocity[2];
        return c < 3 ? s.velocity[c] : s.angular_velocity[c - 3];
      };
      value(i) += h;
      pair.collide_with({e_n, 1e9, -e_t});
      Eigen::VectorXd out(size);
      for (int j = 0; j < size; ++j) out[j] = value(j);
      return out;
    };
    for (int i = 0; i < size; ++i) {
      const double h = i % (size / 2) < size / 4 + (planar ? 1 : 0) ? 1e-3 : 1e-1;
      columns.col(i) = (collided(i, h) - collided(i, -h)) / (2 * h);
    }
    return std::abs(columns.determinant());
  };
  EXPECT_NEAR(jacobian(false), e_n * e_t * e_t, 1e-9);
  EXPECT_NEAR(jacobian(true), e_n * e_t, 1e-9);
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

/// Ψ2 of a collision with Ψ1 against a wall, for a solid ball.
double psi_after(double psi, double e, double mu, double beta0) {
  const double mass = 1e-3, kappa = 2.0 / 7;
  const PlanarImpulse impulse = planar_impulse({e, mu, beta0}, e, mass, kappa, -1, psi);
  return psi + impulse.tangential / (kappa * mass);
}

TEST(Luding, Figure5SlidesBeyond222WithFrictionOneHalf) {
  // −tan γ0 = (7/2) μ (1 + e)/(1 + β0): 2.22 for μ = 0.5, e = 0.9, β0 = 0.5. Printed is 1.33, that
  // of μ = 0.3; at the offset 0.8 d Ψ1 = 4/3 the pair still sticks.
  EXPECT_NEAR(psi_after(4.0 / 3, 0.9, 0.5, 0.5), -0.5 * 4 / 3, 1e-15);
  EXPECT_NEAR(psi_after(2.2, 0.9, 0.5, 0.5), -0.5 * 2.2, 1e-15);
  EXPECT_GT(psi_after(2.23, 0.9, 0.5, 0.5), -0.5 * 2.23 + 1e-3);
  EXPECT_GT(psi_after(1.35, 0.9, 0.3, 0.5), -0.5 * 1.35 + 1e-3);
}

TEST(Luding, Figure4SlidesAtItsUppermostCollisionWithBetaZeroToo) {
  // Ψ1 = 3.5 > 3.325 = −tan γ0.
  EXPECT_NEAR(psi_after(3.0, 0.9, 0.5, 0), 0, 1e-15);
  EXPECT_NEAR(psi_after(3.5, 0.9, 0.5, 0), 3.5 - 3.325, 1e-15);
}

}  // namespace
}  // namespace slipcheck
