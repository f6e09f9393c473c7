#include "scene/impact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "../support/cpu_time.h"
#include "../support/extremes.h"
#include "../support/refusal.h"
#include "../support/runge_kutta.h"
#include "physics/contact/elastic_pair.h"
#include "physics/contact/linear_contact.h"
#include "scene/asperity_passivity.h"
#include "scene/restitution_curve.h"

namespace slipcheck {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const ContactEnd kEnds[] = {ContactEnd::zero_overlap, ContactEnd::zero_force};

/// A collision by Runge-Kutta with equal steps in σ, dt = 2 y dσ, where ξ = y²: then √ξ is no root
/// any more, dy/dσ = ξ̇ and dξ̇/dσ = −2 y F/m, and the order is 4 at both ends of a contact too. The
/// end is found by halving the last step.
Impact integrated(const NormalForce& law, double m, double v, ContactEnd end, int steps) {
  const double length = impact_scales(law, m, v).length;
  const double unit = std::sqrt(length) / v;
  Impact found;
  const auto slope = [&](double, const Vector3& s) {  // of y, ξ̇, t
    const double force = normal_force(law, std::copysign(s[0] * s[0], s[0]), s[1]);
    return Vector3(s[1], -2 * s[0] * force / m, 2 * s[0]);
  };
  const auto over = [&](const Vector3& s) {
    return s[0] < 0 ||
           (end == ContactEnd::zero_force && s[1] < 0 && normal_force(law, s[0] * s[0], s[1]) < 0);
  };
  const auto seen = [&](const Vector3& s) {
    if (s[0] * s[0] <= found.largest_overlap) return;
    found.largest_overlap = s[0] * s[0];
    found.largest_overlap_at = s[2];
  };
  const Vector3 last =
      test::integrate_until(over, slope, Vector3(0, v, 0), 4 * unit / steps, 1e-13 * unit, seen);
  found.restitution = -last[1] / v;
  found.duration = last[2];
  return found;
}

TEST(Impact, K2ClosedFormsUnderBothEndRules) {
  const double m = 1.3e-4, k = 2e6, v = 0.3;
  for (const ContactEnd end : kEnds) {
    for (const double ratio : {0.0, 0.01, 0.3, 1.0, 1.9, 1.99, 2.0, 3.0, 30.0}) {
      if (ratio >= 2 && end == ContactEnd::zero_overlap) continue;
      const LinearContact closed(m, k, ratio * std::sqrt(k / m), end);
      const Impact found = impact(LinearForce{k, closed.damping_rate() * m}, m, v, end);
      // The local errors of some 300 steps at 1e-12, 1000 of them where the damping is stiff.
      EXPECT_NEAR(found.restitution, closed.restitution(), 3e-11) << ratio;
      EXPECT_NEAR(found.duration / closed.collision_time(), 1, 3e-9) << ratio;
      EXPECT_NEAR(found.largest_overlap / closed.largest_overlap(v), 1, 1e-10) << ratio;
    }
  }
}

TEST(Impact, K2DampingSetFor09Gives090203UnderTheClamp) {
  const double m = 1.3e-4;
  const auto set = LinearContact::with_collision_time(m, 0.9, 2.55e-5, ContactEnd::zero_overlap);
  const LinearForce force{set.stiffness(), set.damping_rate() * m};
  const Impact attractive = impact(force, m, 0.1, ContactEnd::zero_overlap);
  EXPECT_NEAR(attractive.restitution, 0.9, 1e-10);
  EXPECT_NEAR(attractive.duration, 2.55e-5, 1e-14);
  EXPECT_NEAR(impact(force, m, 0.1, ContactEnd::zero_force).restitution, 0.90203, 5e-6);
}

TEST(Impact, OverCriticalDampingNeverParts) {
  for (const double ratio : {2.0, 2.5, 1000.0}) {
    const Impact found = impact(LinearForce{1, ratio}, 1, 1, ContactEnd::zero_overlap);
    EXPECT_EQ(found.restitution, 0);
    EXPECT_EQ(found.duration, kInfinity);
    EXPECT_NEAR(found.largest_overlap /
                    LinearContact(1, 1, ratio, ContactEnd::zero_overlap).largest_overlap(1),
                1, 1e-8);
  }
  for (const ContactEnd end : kEnds) {
    const Impact stuck = impact(ViscoelasticForce{1, 1e30}, 1, 1, end);
    EXPECT_EQ(stuck.restitution, 0);
    EXPECT_EQ(stuck.duration, kInfinity);
    // m v = ∫ F dt = ρ A ξ^{3/2}.
    EXPECT_NEAR(std::pow(stuck.largest_overlap, 1.5) * 1e30, 1, 1e-12);
    EXPECT_NEAR(impact(CompactViscoelasticForce{1, 9e6}, 1, 1, end).largest_overlap /
                    impact(CompactViscoelasticForce{1, 1.1e7}, 1, 1, end).largest_overlap,
                std::pow(1.1 / 0.9, 1.5), 0.02);
  }
  // ξ^1.5 with a dashpot: from a finite damping on; so too at the marginal γ = (α − 1)/2, from
  // D² = 4 (α − γ) on.
  EXPECT_EQ(impact(PowerForce{1, 5, 1.5, 0}, 1, 1, ContactEnd::zero_overlap).duration, kInfinity);
  EXPECT_EQ(impact(PowerForce{1, 2.3, 1.5, 0.25}, 1, 1, ContactEnd::zero_overlap).duration,
            kInfinity);
  EXPECT_LT(impact(PowerForce{1, 2.1, 1.5, 0.25}, 1, 1, ContactEnd::zero_overlap).duration,
            kInfinity);
  // Under the clamp all end.
  EXPECT_GT(impact(PowerForce{1, 5, 1.5, 0}, 1, 1, ContactEnd::zero_force).restitution, 0);
}

TEST(Impact, StrongDampingEndsSoon) {
  const test::CpuTime took;
  for (const ContactEnd end : kEnds) {
    for (const double A : {1.0, 1e2, 1e3}) {
      EXPECT_GT(impact(ViscoelasticForce{1, A}, 1, 1, end).restitution, 0);
      EXPECT_GT(impact(CompactViscoelasticForce{1, A}, 1, 1, end).restitution, 0);
    }
  }
  EXPECT_LT(took(), 10 * test::kSlower);
}

TEST(Impact, HertzIsElasticWithTheDurationOfA13) {
  for (const ContactEnd end : kEnds) {
    const double m = 2e-3, rho = 5e8, g = 0.2;
    const Impact found = impact(HertzForce{rho}, m, g, end);
    EXPECT_NEAR(found.restitution, 1, 1e-10);
    EXPECT_NEAR(found.duration / hertz_duration(m, rho, g), 1, 1e-10);
    EXPECT_NEAR(found.largest_overlap / hertz_largest_overlap(m, rho, g), 1, 1e-10);
    EXPECT_NEAR(found.largest_overlap_at / found.duration, 0.5, 1e-10);
  }
}

TEST(Impact, KB1ElasticScaling) {
  // m v²/2 = E x^(1+α)/(1+α), t = 2 (x/v) ∫ ds/√(1 − s^(1+α)) = 2 x/(v (1+α)) B(1/(1+α), 1/2).
  for (const double alpha : {1.0, 1.5, 2.0, 3.5}) {
    for (const double v : {1e-3, 10.0}) {
      const double m = 1e-3, E = 1e8, a = 1 / (1 + alpha);
      const Impact found = impact(PowerForce{E, 0, alpha, 0.5}, m, v, ContactEnd::zero_overlap);
      const double x = std::pow(m * v * v / (2 * a * E), a);
      const double beta = std::tgamma(a) * std::tgamma(0.5) / std::tgamma(a + 0.5);
      EXPECT_NEAR(found.largest_overlap / x, 1, 1e-10);
      EXPECT_NEAR(found.duration / (2 * x / v * a * beta), 1, 1e-10);
      EXPECT_NEAR(found.restitution, 1, 1e-10);
    }
  }
}

TEST(Impact, AgreesWithAnIndependentIntegration) {
  const std::vector<NormalForce> laws = {
      ViscoelasticForce{5e8, 1e-6},        ViscoelasticForce{5e8, 3e-5},
      CompactViscoelasticForce{5e8, 1e-6}, CompactViscoelasticForce{5e8, 3e-5},
      PowerForce{5e8, 2, 1.5, 0},          PowerForce{3e10, 1e4, 2, 0.5},
      PowerForce{3e10, 1e6, 2, 1}};
  for (const NormalForce& law : laws) {
    for (const ContactEnd end : kEnds) {
      const Impact found = impact(law, 2e-3, 0.5, end);
      const Impact expected = integrated(law, 2e-3, 0.5, end, 20000);
      // Powers below 1 of y at the ends bring the order of Runge-Kutta down to 2: 1e-8. The deepest
      // of its steps is half a step away from the turning point at most.
      EXPECT_NEAR(found.restitution, expected.restitution, 2e-8) << law.index();
      EXPECT_NEAR(found.duration / expected.duration, 1, 2e-8) << law.index();
      EXPECT_NEAR(found.largest_overlap / expected.largest_overlap, 1, 1e-7) << law.index();
      EXPECT_NEAR(found.largest_overlap_at / expected.largest_overlap_at, 1, 1e-3) << law.index();
    }
  }
}

TEST(Impact, SmallAndLargeScenesAreOne) {
  // The same D at 1e-9 m and microseconds, and at 10 m and seconds.
  const Impact small = impact(ViscoelasticForce{1e9, 1e-11}, 1e-18, 1e-3, ContactEnd::zero_overlap);
  const double T = impact_scales(ViscoelasticForce{1e9, 0}, 1e-18, 1e-3).time;
  const double T1 = impact_scales(ViscoelasticForce{1e3, 0}, 1e5, 10).time;
  const Impact large =
      impact(ViscoelasticForce{1e3, 1e-11 * T1 / T}, 1e5, 10, ContactEnd::zero_overlap);
  EXPECT_NEAR(small.restitution, large.restitution, 1e-10);
  EXPECT_NEAR(small.duration / T / (large.duration / T1), 1, 1e-10);
}

TEST(Impact, ToleranceSetsTheError) {
  const ViscoelasticForce law{5e8, 1e-5};
  const double fine = impact(law, 2e-3, 1, ContactEnd::zero_overlap, 1e-13).restitution;
  EXPECT_NEAR(impact(law, 2e-3, 1, ContactEnd::zero_overlap, 1e-6).restitution, fine, 1e-4);
  EXPECT_NEAR(impact(law, 2e-3, 1, ContactEnd::zero_overlap, 1e-9).restitution, fine, 1e-7);
  EXPECT_NEAR(impact(law, 2e-3, 1, ContactEnd::zero_overlap).restitution, fine, 1e-10);
}

// --- B (24) at small dissipation -----------------------------------------------------------------

/// C1 of 1 − ε = C1 β − …, β = A κ_v^{2/5} g^{1/5}. In scaled variables ẍ = −x^{3/2} − β √x ẋ; to
/// first order 1 − ε is the energy that the dashpot takes along the elastic path,
///   1 − ε = 2 β ∫_0^{x_m} √x √(1 − (4/5) x^{5/2}) dx = (4/5) (5/4)^{3/5} B(3/5, 3/2) β.
double first_coefficient() {
  return 0.8 * std::pow(1.25, 0.6) * std::tgamma(0.6) * std::tgamma(1.5) / std::tgamma(2.1);
}

/// An ice-like pair whose β is this at g = 1 m/s.
struct SmallDissipation {
  double m = 2e-3, rho = 5e8;
  double time(double beta) const { return beta / std::pow(viscoelastic_constant(m, rho), 0.4); }
  double loss(double beta, ContactEnd end) const {
    return 1 - impact(ViscoelasticForce{rho, time(beta)}, m, 1, end, 1e-13).restitution;
  }
};

TEST(Impact, B24SmallDissipationSeries) {
  EXPECT_NEAR(first_coefficient(), 1.15344, 1e-5);
  // The next term is 0.8 β² of the loss, and the integration's error some 1e-12.
  const SmallDissipation ice;
  for (const double beta : {1e-6, 1e-5})
    EXPECT_NEAR(ice.loss(beta, ContactEnd::zero_overlap) / beta, 1.15344, 1e-5);
}

TEST(Impact, B24SpeedDependenceIsAFifthPower) {
  const SmallDissipation ice;
  const ViscoelasticForce law{ice.rho, ice.time(1e-4)};
  const auto loss = [&](double g) {
    return 1 - impact(law, ice.m, g, ContactEnd::zero_overlap, 1e-13).restitution;
  };
  EXPECT_NEAR(loss(1e-3 * 32) / loss(1e-3), 2, 2e-4);
}

TEST(Impact, B24SecondCoefficientIsThreeFifthsOfTheFirstSquared) {
  // 1 − ε = C1 β − C2 β² + O(β^{5/2} …): (C1 β − loss)/β² tends to C2 = 0.79826 with a slope of
  // some 0.5 in β, which extrapolation from two β takes out.
  const SmallDissipation ice;
  const double c1 = first_coefficient();
  const auto second = [&](double beta) {
    return (c1 * beta - ice.loss(beta, ContactEnd::zero_overlap)) / (beta * beta);
  };
  EXPECT_NEAR(2 * second(0.01) - second(0.02), 0.6 * c1 * c1, 1e-3);
  EXPECT_NEAR(0.6 * c1 * c1, 0.79826, 2e-5);
}

TEST(Impact, B24EndRulesDifferFromTheFifthHalfOrderOn) {
  const SmallDissipation ice;
  const auto difference = [&](double beta) {
    return ice.loss(beta, ContactEnd::zero_overlap) - ice.loss(beta, ContactEnd::zero_force);
  };
  // 4^{5/2} = 32, with a correction of order √β.
  EXPECT_NEAR(difference(0.008) / difference(0.002), 32, 0.5);
}

// --- a law with a given restitution --------------------------------------------------------------

TEST(WithRestitution, IsReachedByEveryLawUnderBothRules) {
  const std::vector<NormalForce> laws = {
      LinearForce{3e5, 0},      PowerForce{4e8, 0, 1.5, 0.5}, PowerForce{4e8, 0, 1.5, 0},
      PowerForce{4e8, 0, 2, 2}, ViscoelasticForce{5e8, 0},    CompactViscoelasticForce{5e8, 0}};
  for (const NormalForce& law : laws) {
    for (const ContactEnd end : kEnds) {
      for (const double e : {1.0, 0.999, 0.9, 0.3, 0.01}) {
        const NormalForce set = with_restitution(law, 2e-3, e, 0.1, end);
        EXPECT_EQ(set.index(), law.index());
        // Both integrations are good to 1e-11 … 1e-10.
        EXPECT_NEAR(impact(set, 2e-3, 0.1, end).restitution, e, 1e-9) << law.index() << ' ' << e;
      }
    }
  }
}

std::string refusal(const NormalForce& law, double restitution, ContactEnd end) {
  return test::refusal_of<std::domain_error>(
      [&] { with_restitution(law, 2e-3, restitution, 0.1, end); });
}

TEST(WithRestitution, TellsTheReachableRange) {
  EXPECT_EQ(refusal(HertzForce{5e8}, 0.9, ContactEnd::zero_overlap),
            "restitution must be 1 at 0.1 m/s: hertz is elastic");
  EXPECT_EQ(refusal(HertzForce{5e8}, 1, ContactEnd::zero_overlap), "");
  EXPECT_EQ(refusal(ViscoelasticForce{5e8, 0}, 1e-6, ContactEnd::zero_force),
            "restitution must be in [9.736e-05, 1] at 0.1 m/s");
  EXPECT_EQ(refusal(ViscoelasticForce{5e8, 0}, 1.5, ContactEnd::zero_force),
            "restitution must be in (0, 1] at 0.1 m/s");
}

// --- tables over the speed -----------------------------------------------------------------------

double worst_error(const NormalForce& law, double m, ContactEnd end) {
  const ImpactScales at_one = impact_scales(law, m, 1);
  const RestitutionLaw table = RestitutionCurve(at_one.law, end).over_speed(at_one.dissipation);
  double worst = 0;
  for (double log_speed = -9; log_speed <= 5; log_speed += 0.2371) {
    const double v = std::pow(10, log_speed);
    worst = test::largest_of(
        worst, std::abs(restitution_at(table, v) - impact(law, m, v, end).restitution));
  }
  return worst;
}

TEST(RestitutionCurve, IsGoodTo1e6OverFourteenDecades) {
  for (const ContactEnd end : kEnds) {
    for (const double A : {1e-8, 1e-6, 1e-4}) {
      EXPECT_LT(worst_error(ViscoelasticForce{5e8, A}, 2e-3, end), 1e-6) << A;
      EXPECT_LT(worst_error(CompactViscoelasticForce{5e8, A}, 2e-3, end), 1e-6) << A;
    }
    EXPECT_LT(worst_error(PowerForce{5e5, 1e4, 1, 1}, 2e-3, end), 1e-6);
  }
  // e rises with the speed.
  EXPECT_LT(worst_error(PowerForce{5e8, 0.5, 1.5, 0}, 2e-3, ContactEnd::zero_force), 1e-6);
}

TEST(RestitutionCurve, IsANumberWhereTheSpeedDoesNotMatter) {
  RestitutionCurve linear({1, 0, false}, ContactEnd::zero_overlap);
  EXPECT_NEAR(std::get<double>(linear.over_speed(0.3)),
              LinearContact(1, 1, 0.3, ContactEnd::zero_overlap).restitution(), 1e-9);
  EXPECT_EQ(std::get<double>(RestitutionCurve({}, ContactEnd::zero_force).over_speed(0)), 1);
}

TEST(RestitutionCurve, HasLimitsAtSpeedsOfNothing) {
  RestitutionCurve falling({}, ContactEnd::zero_overlap);
  EXPECT_EQ(restitution_at(falling.over_speed(0.1), 0), 1);
  RestitutionCurve rising({1.5, 0, false}, ContactEnd::zero_overlap);
  EXPECT_LT(restitution_at(rising.over_speed(0.1), 0), 1e-6);
}

// --- the printed asperities ----------------------------------------------------------------------

/// ζ'(end)/ζ'(0) of an unbroken asperity over a collision, by Runge-Kutta in time; the end falls on
/// a step.
double slip_ratio(const ScaledLaw& law, ContactEnd end, double D, double lambda) {
  using State = Eigen::Vector4d;
  State y(0, 1, 0, 1);
  const auto force = [&](const State& s) {
    if (!(s[0] > 0)) return 0.0;
    if (law.compact) {
      const double pressed = s[0] + D * s[1];
      return pressed > 0 ? std::pow(pressed, law.alpha) : -std::pow(-pressed, law.alpha);
    }
    return std::pow(s[0], law.alpha) + D * std::pow(s[0], law.gamma) * s[1];
  };
  const auto slope = [&](double, const State& s) {
    return State(s[1], -force(s), s[3], -lambda * force(s) * s[2]);
  };
  do y = test::runge_kutta_step(slope, 0, y, 1e-4);
  while (y[0] > 0 && (end == ContactEnd::zero_overlap || y[1] > 0 || force(y) > 0));
  return y[3];
}

TEST(AsperityPassivity, BoundIsWhereTheSlipIsReversedInFull) {
  for (const double alpha : {1.0, 1.5, 2.5}) {
    const ScaledLaw law{alpha};
    for (const ContactEnd end : {ContactEnd::zero_overlap, ContactEnd::zero_force}) {
      const double bound = largest_passive_bend(law, end, 0);
      EXPECT_NEAR(slip_ratio(law, end, 0, bound), -1, 1e-6);
      for (const double share : {0.1, 0.5, 0.9})
        EXPECT_GT(slip_ratio(law, end, 0, share * bound), -1);
      EXPECT_LT(slip_ratio(law, end, 0, 1.1 * bound), -1);
    }
  }
}

/// Ice of B's Figs. 1 and 2 (b): R = 1 cm, ζ0 = 2e-4 R_eff = 1 µm, μ = √(ζ0/µm) = 1.
struct RoughIce {
  ElasticMaterial ice{1e10, 0.3};
  Sphere ball{0.01, 1000 * 4 / 3.0 * M_PI * 1e-6};
  double mass = effective_mass(ball, ball);
  double rho = hertz_modulus(ice, ice, effective_radius(ball, ball));
  double bend_per_length = 1.0 / (2.0 / 7 * 1e-6);

  /// ε^T at this speed.
  double slip(const NormalForce& force, ContactEnd end, double speed) const {
    const ImpactScales scales = impact_scales(force, mass, speed);
    return slip_ratio(scales.law, end, scales.dissipation, bend_per_length * scales.length);
  }
  double passive_speed(const NormalForce& force, ContactEnd end) const {
    return PassiveSpeeds(end).of(impact_scales(force, mass, 1), bend_per_length);
  }
};

TEST(AsperityPassivity, DampingKeepsTheSlipsEnergyDown) {
  const RoughIce b;
  // Without damping from 3.5 mm/s on; with the A of Fig. 1 and an end where the force falls to zero
  // nowhere in 1 mm/s … 1 m/s, as the integration of each says.
  EXPECT_NEAR(b.passive_speed(HertzForce{b.rho}, ContactEnd::zero_force), 3.5e-3, 0.1e-3);
  const CompactViscoelasticForce damped{b.rho, 4.6e-5};
  EXPECT_GT(b.passive_speed(damped, ContactEnd::zero_force), 1);
  for (double speed = 1e-3; speed < 1; speed *= 1.3)
    EXPECT_LT(std::abs(b.slip(damped, ContactEnd::zero_force, speed)), 1) << speed;
}

TEST(AsperityPassivity, WeakDampingOnlyMovesTheBound) {
  const RoughIce b;
  for (const NormalForce& force : {NormalForce(CompactViscoelasticForce{b.rho, 1e-6}),
                                   NormalForce(ViscoelasticForce{b.rho, 1e-6})})
    for (const ContactEnd end : {ContactEnd::zero_force, ContactEnd::zero_overlap}) {
      const double bound = b.passive_speed(force, end);
      EXPECT_GT(bound, b.passive_speed(HertzForce{b.rho}, end));
      // Four digits of the dissipation.
      EXPECT_NEAR(std::abs(b.slip(force, end, bound)), 1, 1e-4);
      EXPECT_GT(std::abs(b.slip(force, end, 1.02 * bound)), 1);
      EXPECT_LT(std::abs(b.slip(force, end, 0.98 * bound)), 1);
    }
}

TEST(AsperityPassivity, TheBoundOfAnyPowerIsWhereTheSlipsEnergyIsKept) {
  // Powers other than Hertz's: the overlap grows with g^(2/(1+α)). The slip is integrated at the
  // bound, and at 2 % of the speed below and above it.
  const RoughIce b;
  for (const double alpha : {1.0, 2.0, 2.5})
    for (const double viscosity : {0.0, 1e-3}) {
      const double modulus = b.rho * std::pow(1e-5, 1.5 - alpha);
      const NormalForce force =
          PowerForce{modulus, viscosity * std::sqrt(b.mass * modulus), alpha, 0.5 * (alpha - 1)};
      const ContactEnd end = ContactEnd::zero_overlap;
      const double bound = b.passive_speed(force, end);
      ASSERT_TRUE(std::isfinite(bound) && bound > 0) << alpha;
      EXPECT_NEAR(std::abs(b.slip(force, end, bound)), 1, viscosity > 0 ? 1e-4 : 1e-6) << alpha;
      EXPECT_GT(std::abs(b.slip(force, end, 1.02 * bound)), 1) << alpha;
      EXPECT_LT(std::abs(b.slip(force, end, 0.98 * bound)), 1) << alpha;
    }
}

TEST(AsperityPassivity, TheBoundIsFoundWhereDampingGrowsWithTheSpeed) {
  // With γ = α/2 the damping D goes as g^(1/(1+α)); 3 % of it at the undamped law's bound.
  const RoughIce b;
  const ContactEnd end = ContactEnd::zero_overlap;
  for (const double alpha : {1.0, 2.0, 2.5}) {
    PowerForce force{b.rho * std::pow(1e-5, 1.5 - alpha), 0, alpha, 0.5 * alpha};
    const double undamped = b.passive_speed(force, end);
    force.viscosity = 1;
    force.viscosity = 0.03 / impact_scales(force, b.mass, undamped).dissipation;
    const double bound = b.passive_speed(force, end);
    ASSERT_TRUE(std::isfinite(bound)) << alpha;
    EXPECT_GT(bound, undamped) << alpha;
    EXPECT_NEAR(std::abs(b.slip(force, end, bound)), 1, 1e-4) << alpha;  // four digits of D
  }
}

TEST(AsperityPassivity, AnAttractionAtTheEndAddsEnergyAllTheSame) {
  const RoughIce b;
  const ViscoelasticForce damped{b.rho, 4.6e-5};
  const double bound = b.passive_speed(damped, ContactEnd::zero_overlap);
  EXPECT_LT(bound, 1);
  EXPECT_GT(std::abs(b.slip(damped, ContactEnd::zero_overlap, 1.01 * bound)), 1);
}

TEST(AsperityPassivity, IceIsOnTheTwoSidesThatWereMeasured) {
  // Measured: R = 1 cm, ζ0 = 2e-4 R_eff, g_N = 1 m/s. μ = 0.1 gains energy; the paper's own
  // μ = √ζ0 (in cm) does not from 1 mm/s to 1 m/s.
  const ElasticMaterial ice{1e10, 0.3};
  const Sphere ball{0.01, 917 * 4 / 3.0 * M_PI * 1e-6};
  const double r = effective_radius(ball, ball), m = effective_mass(ball, ball);
  const ImpactScales at_one = impact_scales(HertzForce{hertz_modulus(ice, ice, r)}, m, 1);
  const double size = 2e-4 * r, kappa = 2.0 / 7;
  PassiveSpeeds speeds(ContactEnd::zero_overlap);
  EXPECT_LT(speeds.of(at_one, 0.1 / (kappa * size)), 0.2);
  EXPECT_GT(speeds.of(at_one, std::sqrt(size * 100) / (kappa * size)), 1);
}

}  // namespace
}  // namespace slipcheck
