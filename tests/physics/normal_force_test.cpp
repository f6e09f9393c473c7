#include "physics/contact/normal_force.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "physics/contact/elastic_pair.h"
#include "physics/contact/tabulated_restitution.h"

namespace slipcheck {
namespace {

const std::vector<NormalForce> kLaws = {LinearForce{3e5, 2}, HertzForce{5e8},
                                        PowerForce{4e7, 30, 1.3, 0.7}, ViscoelasticForce{5e8, 1e-6},
                                        CompactViscoelasticForce{5e8, 1e-6}};

TEST(NormalForce, ElasticPartIsTheForceAtRestAndTheSlopeOfTheEnergy) {
  for (const NormalForce& law : kLaws) {
    const double x = 2e-6, h = 1e-9;
    std::visit(
        [&](const auto& force) {
          EXPECT_DOUBLE_EQ(force(x, 0), force.elastic(x));
          // Central difference: relative error (h/x)²/24 of the third derivative, below 1e-7.
          const double slope = (force.energy(x + h) - force.energy(x - h)) / (2 * h);
          EXPECT_NEAR(slope / force.elastic(x), 1, 1e-6);
          EXPECT_EQ(force.energy(0), 0);
        },
        law);
  }
}

TEST(NormalForce, IsOddInTheOverlapAtRest) {
  for (const NormalForce& law : kLaws)
    EXPECT_DOUBLE_EQ(normal_force(law, -2e-6, 0), -normal_force(law, 2e-6, 0));
}

TEST(NormalForce, ApproachResistsMoreThanRetreat) {
  for (const NormalForce& law : kLaws) {
    if (std::holds_alternative<HertzForce>(law)) continue;
    EXPECT_GT(normal_force(law, 2e-6, 0.1), normal_force(law, 2e-6, 0));
    EXPECT_LT(normal_force(law, 2e-6, -0.1), normal_force(law, 2e-6, 0));
  }
}

TEST(NormalForce, KB1HoldsTheOtherLaws) {
  for (const double rate : {-0.3, 0.0, 0.2}) {
    const double x = 3e-6;
    EXPECT_DOUBLE_EQ((PowerForce{3e5, 2, 1, 0}(x, rate)), (LinearForce{3e5, 2}(x, rate)));
    EXPECT_NEAR((PowerForce{5e8, 0, 1.5, 0.5}(x, rate)) / (HertzForce{5e8}(x, rate)), 1, 1e-14);
    EXPECT_NEAR((PowerForce{5e8, 1.5 * 1e-6 * 5e8, 1.5, 0.5}(x, rate)) /
                    (ViscoelasticForce{5e8, 1e-6}(x, rate)),
                1, 1e-14);
  }
}

TEST(NormalForce, B24IsB25ToFirstOrderInA) {
  // (ξ + a)^{3/2} = ξ^{3/2} + (3/2) √ξ a + (3/8) a²/√ξ: the difference falls by 4 when a is halved.
  const double x = 2e-6, rate = 0.1;
  const auto difference = [&](double A) {
    return CompactViscoelasticForce{5e8, A}(x, rate) - ViscoelasticForce{5e8, A}(x, rate);
  };
  EXPECT_NEAR(difference(2e-8) / difference(1e-8), 4, 2e-3);
  EXPECT_NEAR(difference(1e-8) / (5e8 * 0.375 * 1e-18 / std::sqrt(x)), 1, 1e-3);
}

TEST(ElasticPair, B8SolidSpheresGiveTwoSevenths) {
  const Sphere a{0.01, 0.1}, b{0.02, 0.7};
  EXPECT_NEAR(tangential_mass_ratio(a, a), 2.0 / 7, 1e-15);
  EXPECT_NEAR(tangential_mass_ratio(a, b), 2.0 / 7, 1e-15);
}

TEST(ElasticPair, B8IsTheMassThatATangentialForceMoves) {
  // A force at the contact accelerates each surface by 1/m + R²/I.
  const Sphere a{0.01, 0.1, 2.0 / 3}, b{0.02, 0.7, 1};
  const auto mobility = [](const Sphere& s) {
    return 1 / s.mass + s.radius * s.radius / s.moment_of_inertia();
  };
  EXPECT_NEAR(tangential_mass_ratio(a, b) * effective_mass(a, b) * (mobility(a) + mobility(b)), 1,
              1e-15);
}

TEST(ElasticPair, EffectiveMassAndRadius) {
  const Sphere a{0.01, 0.1}, b{0.03, 0.3};
  EXPECT_DOUBLE_EQ(effective_mass(a, b), 0.075);
  EXPECT_DOUBLE_EQ(effective_radius(a, b), 0.0075);
  const Sphere heavy{1e20, 1e30};  // a wall, without overflow of the product
  EXPECT_NEAR(effective_mass(a, heavy) / 0.1, 1, 1e-15);
}

TEST(ElasticPair, HertzModulusOfLikeAndUnlikeMaterials) {
  const ElasticMaterial steel{2.06e11, 0.28}, rigid{1e300, 0};
  const double r = 1e-3;
  EXPECT_NEAR(
      hertz_modulus(steel, steel, r) / (2 * 2.06e11 * std::sqrt(r) / (3 * (1 - 0.28 * 0.28))), 1,
      1e-14);
  // Against a rigid body E* is Y/(1 − ν²), twice that of a like pair.
  EXPECT_NEAR(hertz_modulus(steel, rigid, r) / hertz_modulus(steel, steel, r), 2, 1e-14);
}

/// Energies per area of a half-space that a pressure cos(kx) deforms, without shear on its surface,
/// of first order in the moduli: of shear e_ij e_ij with e the deviator of the strain, and of
/// compression (tr ε)². Any pressure is a sum of such waves, which do not mix: what they have in
/// common, every contact has.
struct HalfSpaceField {
  double shear = 0, compression = 0;

  HalfSpaceField(double young, double nu) {
    const double e1 = young / (1 + nu);
    // Airy's function (1 + z) e^−z cos x, k = 1: σ_xx = (z − 1) e^−z cos x, σ_zz = −(1 + z) e^−z
    // cos x, σ_xz = −z e^−z sin x, σ_yy = ν (σ_xx + σ_zz). Means over x, Simpson's rule over z.
    constexpr int kPanels = 4000;
    const double h = 40.0 / kPanels;
    for (int n = 0; n <= kPanels; ++n) {
      const double z = n * h, fall = std::exp(-z);
      const double weight = h / 3 * (n == 0 || n == kPanels ? 1 : n % 2 == 1 ? 4 : 2);
      const double xx = (z - 1) * fall, zz = -(1 + z) * fall, xz = -z * fall, yy = nu * (xx + zz);
      const double mean = (xx + yy + zz) / 3;
      const double squares = (xx - mean) * (xx - mean) + (yy - mean) * (yy - mean) +
                             (zz - mean) * (zz - mean) + 2 * xz * xz;
      const double dilatation = 3 * mean * (1 - 2 * nu) / young;
      shear += weight * 0.5 * squares / (e1 * e1);
      compression += weight * 0.5 * dilatation * dilatation;
    }
  }
};

TEST(ElasticPair, B23DissipationTimeIsThatOfTheFieldInTheMaterial) {
  // A is the power lost over that of the elastic force: both in a field that changes at a rate.
  for (const double nu : {-0.5, 0.0, 0.2, 0.3, 0.45, 0.4999}) {
    const double young = 1e10, e1 = young / (1 + nu), e2 = young / (3 * (1 - 2 * nu));
    const HalfSpaceField field(young, nu);
    const double elastic = e1 * field.shear + e2 * field.compression;
    // Simpson's rule over e^−2z z²: 1e-10.
    EXPECT_NEAR(dissipation_time(1e5, 0, young, nu) / (1e5 * field.shear / elastic), 1, 1e-8);
    EXPECT_NEAR(dissipation_time(0, 1e5, young, nu) / (1e5 * field.compression / elastic), 1, 1e-8);
    // By the stiffness S ∝ E1 (E1 + 6 E2)/(2 E1 + 3 E2) instead of a field; central differences.
    const auto stiffness = [](double a, double b) { return a * (a + 6 * b) / (2 * a + 3 * b); };
    const double h = 1e-5 * e1;
    const double by_shear = (stiffness(e1 + h, e2) - stiffness(e1 - h, e2)) / (2 * h);
    EXPECT_NEAR(by_shear / stiffness(e1, e2) / (field.shear / elastic), 1, 1e-8);
    // One relaxation time of both is A itself.
    EXPECT_NEAR(dissipation_time(3e-5 * e1, 3e-5 * e2, young, nu) / 3e-5, 1, 1e-14);
  }
  EXPECT_EQ(dissipation_time(0, 0, 1e9, 0.25), 0);
  // Where nothing is compressed the shear is left; printed, A vanishes there and with η1 = 3 η2.
  EXPECT_NEAR(dissipation_time(1e5, 7e5, 1e10, 0.5) / (1e5 / (1e10 / 1.5)), 1, 1e-14);
  EXPECT_GT(dissipation_time(3e5, 1e5, 1e10, 0.3), 2.9e-5);
}

TEST(ElasticPair, B23PairTakesTheMeanByCompliance) {
  // Two layers under one pressure p, each p = w_i/c_i + A_i ẇ_i/c_i, here with p rising evenly from
  // 0: w_i = c_i (p − A_i ṗ) once the start is forgotten. Their sum has the A of the pair.
  const ElasticMaterial soft{1e9, 0.3, 4e-5}, stiff{4e9, 0.2, 1e-5};
  const double t = 1, rise = 1;
  double w = 0;
  for (const ElasticMaterial& each : {soft, stiff})
    w += each.compliance() * (rise * t - each.dissipation_time * rise);
  const double c = soft.compliance() + stiff.compliance();
  EXPECT_NEAR(effective_dissipation_time(soft, stiff), t - w / (c * rise), 1e-15);
  const ElasticMaterial rigid{1e300, 0, 5};
  EXPECT_NEAR(effective_dissipation_time(soft, rigid), 4e-5, 1e-18);
  EXPECT_DOUBLE_EQ(effective_dissipation_time(soft, soft), 4e-5);
}

TEST(ElasticPair, A13ConstantIs29432) {
  // m = 1, g = 1, k_H = 1. The paper cuts off what follows: 2.943275…
  EXPECT_NEAR(hertz_duration(1, 1.25, 1), 2.9432, 1e-4);
}

TEST(ElasticPair, KB1SteelCollisionTimesWithTheMissingFactor) {
  // K App. B: steel spheres of R = 2 mm at 10 and 100 cm/s; 2^(2/5) longer in print (physics
  // notes).
  const ElasticMaterial steel{2.06e11, 0.28};
  const double m = 7850 * 4 / 3.0 * M_PI * 8e-9;
  const Sphere ball{2e-3, m};
  const double mass = effective_mass(ball, ball);
  const double rho = hertz_modulus(steel, steel, effective_radius(ball, ball));
  EXPECT_NEAR(hertz_duration(mass, rho, 0.1), 1.93e-5, 5e-8);
  EXPECT_NEAR(hertz_duration(mass, rho, 1), 1.22e-5, 5e-8);
  EXPECT_NEAR(hertz_duration(mass, rho, 0.1) * std::pow(2, 0.4), 2.55e-5, 5e-8);
}

TEST(ElasticPair, ViscoelasticConstantAndSound) {
  const double y = 1e10, nu = 0.3, r = 5e-3, m = 2e-3;
  const ElasticMaterial ice{y, nu};
  EXPECT_NEAR(viscoelastic_constant(m, hertz_modulus(ice, ice, r)) /
                  (std::pow(1.5, 1.5) * y * std::sqrt(r) / (m * (1 - nu * nu))),
              1, 1e-14);
  // Steel of the textbooks: 3.2 km/s across, of 5.1 km/s in a rod.
  EXPECT_NEAR(transversal_sound_speed(2e11, 0.29, 7850), 3142, 1);
  EXPECT_NEAR(transversal_sound_speed(4e9, 0, 1000), 2000 / std::sqrt(2), 1e-9);
}

TEST(TabulatedRestitution, MeetsItsPointsAndSlopes) {
  const TabulatedRestitution table{std::log(0.01), 0.5, {2, 1, -0.5}, {-1, -2, -4}};
  const auto odds = [&](double g) { return std::log(table(g) / (1 - table(g))); };
  for (int i = 0; i < 3; ++i) {
    const double g = 0.01 * std::exp(0.5 * i), h = 1e-5;
    EXPECT_NEAR(odds(g), table.log_odds[static_cast<std::size_t>(i)], 1e-12);
    // Second derivative of the cubics below 100: the difference is off by 100 h.
    EXPECT_NEAR((odds(g * std::exp(h)) - odds(g * std::exp(-h))) / (2 * h),
                table.slope[static_cast<std::size_t>(i)], 2e-3);
  }
}

TEST(TabulatedRestitution, GoesOnAsAPower) {
  // Odds 10 and 0.1 at 1 and e m/s.
  const TabulatedRestitution table{0, 1, {std::log(10.0), -std::log(10.0)}, {-2, -3}};
  EXPECT_NEAR((1 - table(1e-4)) / (1 - table(1e-2)), std::pow(1e-2, 2 / 1.1), 1e-10);
  EXPECT_NEAR(table(1e4) / table(1e2), std::pow(1e2, -3 / 1.1), 1e-10);
  EXPECT_EQ(table(0), 1);
  EXPECT_GE(table(1e300), 0);
}

/// Against the difference of F_N along the way ξ(t) = ξ + ξ̇ t + ξ̈ t²/2.
TEST(NormalForce, TellsTheSignOfItsGrowth) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  const std::vector<NormalForce> laws = {LinearForce{2, 0.3},
                                         HertzForce{2},
                                         PowerForce{2, 0.3, 1.5, 0.5},
                                         PowerForce{2, 0, 1.2, 0.5},
                                         PowerForce{2, 0.3, 1, 1.3},
                                         ViscoelasticForce{2, 0.2},
                                         CompactViscoelasticForce{2, 0.2}};
  for (const NormalForce& law : laws)
    for (int n = 0; n < 100; ++n) {
      const double overlap = 1 + 0.5 * any(random), rate = any(random), turn = any(random);
      const auto at = [&](double t) {
        return normal_force(law, overlap + rate * t + 0.5 * turn * t * t, rate + turn * t);
      };
      constexpr double kStep = 1e-5;  // its square is the difference's error
      const double growth = (at(kStep) - at(-kStep)) / (2 * kStep);
      if (std::abs(growth) < 1e-8) continue;
      EXPECT_EQ(force_growth(law, overlap, rate, turn) > 0, growth > 0);
    }
}

}  // namespace
}  // namespace slipcheck
