#include <gtest/gtest.h>

#include <random>

#include "gases.h"
#include "physics/contact/collision.h"
#include "physics/granular_gas.h"
#include "reference/gas/sonine.h"

namespace slipcheck {
namespace {

/// The means of what a collision changes of both energies, over pairs of Maxwellians and directions
/// weighted with the flux, by the hard rule of collide().
struct Averages {
  double translation = 0, rotation = 0;
  double translation_error = 0, rotation_error = 0;
};

Averages average(int dimensions, const GasLaw& law, const Sphere& sphere, double T, double T_rot,
                 std::size_t pairs) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const auto vector = [&](double variance, bool spin) {
    const double s = std::sqrt(variance);
    if (dimensions == 3) return Vector3(s * normal(random), s * normal(random), s * normal(random));
    if (spin) return Vector3(0, 0, s * normal(random));
    return Vector3(s * normal(random), s * normal(random), 0);
  };
  const auto energy = [&](const BodyState& a) {
    return std::pair{0.5 * sphere.mass * a.velocity.squaredNorm(),
                     0.5 * sphere.moment_of_inertia() * a.angular_velocity.squaredNorm()};
  };
  double weights = 0;
  double t = 0, tt = 0, r = 0, rr = 0;
  for (std::size_t k = 0; k < pairs; ++k) {
    BodyState a, b;
    for (BodyState* each : {&a, &b}) {
      each->velocity = vector(T / sphere.mass, false);
      each->angular_velocity = vector(T_rot / sphere.moment_of_inertia(), true);
    }
    a.position = 2 * sphere.radius * vector(1, false).normalized();
    const double flux = -(a.velocity - b.velocity).dot(a.position.normalized());
    if (flux <= 0) continue;
    const auto [ta, ra] = energy(a);
    const auto [tb, rb] = energy(b);
    const SubstrateContact none;
    collide(law.hard, {}, {sphere, none, a, false}, {sphere, none, b, false});
    const double dt = energy(a).first + energy(b).first - ta - tb;
    const double dr = energy(a).second + energy(b).second - ra - rb;
    weights += flux;
    t += flux * dt, tt += flux * flux * dt * dt;
    r += flux * dr, rr += flux * flux * dr * dr;
  }
  return {t / weights, r / weights, std::sqrt(tt) / weights, std::sqrt(rr) / weights};
}

TEST(GasTheory, MeanFieldIsTheAverageOverMaxwellians) {
  const Sphere sphere = test::small_gas(3, 16).sphere;
  GasLaw bridges = test::rough(1, 0.2, 0.5);
  bridges.hard.restitution = PowerLawRestitution{};
  const double T = 3e-7;
  for (const int D : {2, 3})
    for (const GasLaw& law :
         {test::smooth(0.7), test::rough(0.8, 1e6, 0.3), test::rough(0.9, 0.2, 0.4), bridges})
      for (const double ratio : {0.3, 2.0}) {
        const Averages seen = average(D, law, sphere, T, ratio * T, 200'000);
        const GasCooling cooling =
            mean_field_cooling(law, sphere, D, {T, law.rough() ? ratio * T : 0});
        // Two particles, each with D T/2 and D_rot T_rot/2.
        EXPECT_NEAR(cooling.translation * D, seen.translation, 4 * seen.translation_error);
        EXPECT_NEAR(cooling.rotation * D * (D - 1) / 2, seen.rotation,
                    4 * seen.rotation_error + 1e-20);
        EXPECT_LT(seen.translation_error, 0.02 * std::abs(seen.translation));
      }
}

TEST(GasTheory, HuthmannAndZippeliusIsTheMeanFieldWithoutCoulombFriction) {
  const Sphere sphere = test::small_gas(3, 16).sphere;
  for (const int D : {2, 3})
    for (const double e : {0.5, 1.0})
      for (const double beta : {-0.9, 0.0, 1.0})
        for (const double T_rot : {0.0, 0.5e-7, 4e-7}) {
          const GasCooling quadrature =
              mean_field_cooling(test::rough(e, 1e300, beta), sphere, D, {1e-7, T_rot});
          const GasCooling closed = huthmann_zippelius(D, e, beta, 0.4, 1e-7, T_rot);
          // Simpson's rule where the density begins like x, 1e-5.
          EXPECT_NEAR(quadrature.translation, closed.translation, 2e-5 * 1e-7);
          EXPECT_NEAR(quadrature.rotation, closed.rotation, 2e-5 * 4e-7);
        }
}

TEST(GasTheory, MeanFieldCourseIsHaffsLaw) {
  GasSetup setup = test::small_gas(3, 16);
  const std::vector<double> times{0.1, 1, 10, 1000};
  const std::vector<GasTemperatures> course = mean_field_course(test::smooth(0.8), setup, times);
  const double T0 = 1e-6 / 3;
  const double rate = haff_cooling(3, 0.8) * collisions_on_the_way(3, setup.filled, 2e-3) *
                      mean_relative_speed(3, T0 / 1e-6);
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double part = 1 + 0.5 * rate * times[k];
    EXPECT_NEAR(course[k].translation * part * part / T0, 1, 5e-5);  // Simpson, as above
  }
}

TEST(GasTheory, CumulantsOfTheCoolingState) {
  for (const int D : {2, 3}) {
    EXPECT_NEAR(van_noije_ernst(D, std::sqrt(0.5)), 0, 1e-15);
    EXPECT_NEAR(montanero_santos(D, std::sqrt(0.5)), 0, 1e-15);
    for (const double e : {0.5, 0.9, 0.99}) {
      const SonineCoefficients both = sonine_cooling_state(D, e);
      // What the two leave out is in proportion to a_3, which is smaller than a_2 here.
      EXPECT_NEAR(both.a2, van_noije_ernst(D, e), std::abs(both.a3));
      EXPECT_NEAR(both.a2, montanero_santos(D, e), std::abs(both.a3));
      EXPECT_LT(std::abs(both.a3), std::abs(both.a2));
    }
  }
  // Van Noije and Ernst's own denominators, 81 − 17 e + 30 e² (1 − e) and 57 − 25 e + ….
  EXPECT_DOUBLE_EQ(van_noije_ernst(3, 0.5), 4 / (81 - 8.5 + 3.75));
  EXPECT_DOUBLE_EQ(van_noije_ernst(2, 0.5), 4 / (57 - 12.5 + 3.75));
}

TEST(GasTheory, BothEquationsOfTheCoolingStateHold) {
  // μ_4 and μ_6 by an average over random pairs, weighted with the polynomials.
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0, std::sqrt(0.5));
  const double e = 0.6;
  for (const int dimensions : {2, 3}) {
    const SonineCoefficients both = sonine_cooling_state(dimensions, e);
    const double D = dimensions;
    constexpr std::size_t kBlocks = 40, kPairs = 20'000;
    std::vector<double> off4, off6;
    for (std::size_t block = 0; block < kBlocks; ++block) {
      double mu2 = 0, mu4 = 0, mu6 = 0, linear2 = 0;
      for (std::size_t pair = 0; pair < kPairs; ++pair) {
        std::array<double, 3> a{}, b{};
        for (int c = 0; c < dimensions; ++c) {
          a[static_cast<std::size_t>(c)] = normal(random);
          b[static_cast<std::size_t>(c)] = normal(random);
        }
        const auto square = [](const std::array<double, 3>& v) {
          return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        };
        const auto powers = [](double x, double y) {
          return std::array{x + y, x * x + y * y, x * x * x + y * y * y};
        };
        const auto x = powers(square(a), square(b));
        const double u = a[0] - b[0];  // the line of centres is as good as any
        a[0] -= 0.5 * (1 + e) * u;
        b[0] += 0.5 * (1 + e) * u;
        const auto y = powers(square(a), square(b));
        const double S2 = 0.5 * x[1] - (D + 2) / 2 * x[0] + D * (D + 2) / 4;
        const double S3 = -x[2] / 6 + (D + 4) / 4 * x[1] - (D + 2) * (D + 4) / 8 * x[0] +
                          D * (D + 2) * (D + 4) / 24;
        const double weight = std::abs(u) * (1 + both.a2 * S2 + both.a3 * S3);
        mu2 += weight * (x[0] - y[0]);
        linear2 += std::abs(u) * (x[0] - y[0]);
        mu4 += weight * (x[1] - y[1]);
        mu6 += weight * (x[2] - y[2]);
      }
      // The products of a_2 and a_3 are left out of μ_2 ⟨c^n⟩.
      off4.push_back((mu4 - (D + 2) * (mu2 + both.a2 * linear2)) / linear2);
      off6.push_back((mu6 - 0.75 * (D + 2) * (D + 4) * (mu2 + (3 * both.a2 - both.a3) * linear2)) /
                     linear2);
    }
    for (const std::vector<double>& off : {off4, off6}) {
      double mean = 0, sum = 0;
      for (const double each : off) mean += each / kBlocks;
      for (const double each : off) sum += (each - mean) * (each - mean);
      EXPECT_NEAR(mean, 0, 4 * std::sqrt(sum / (kBlocks * (kBlocks - 1.0))));
    }
  }
}

TEST(GasTheory, BothEquationsOfTheCoolingStateHoldExactlyInTwoDimensions) {
  // The same without chance. c_1, c_2 = R ± r/2 with R of variance 1/4 and r of 1: the trapezoidal
  // rule over Gaussians, at steps of two thirds of σ to 9 σ, errs by e^(−2π² 9/4) = 5e-20; r_x > 0,
  // the flux, is e^y, over which the rule converges as fast.
  constexpr double D = 2;
  for (const double e : {0.1, 0.6, 0.95}) {
    const SonineCoefficients both = sonine_cooling_state(2, e);
    double mu2 = 0, mu4 = 0, mu6 = 0, linear2 = 0;
    const auto powers = [](double x, double y) {
      return std::array{x + y, x * x + y * y, x * x * x + y * y * y};
    };
    const auto add = [&](double Rx, double Ry, double rx, double ry, double weight) {
      const auto squares = [&](double component) {
        const double s = Rx * Rx + Ry * Ry + 0.25 * (component * component + ry * ry);
        const double p = Rx * component + Ry * ry;
        return powers(s + p, s - p);
      };
      const auto x = squares(rx), y = squares(-e * rx);
      const double S2 = 0.5 * x[1] - 2 * x[0] + 2;
      const double S3 = -x[2] / 6 + 1.5 * x[1] - 3 * x[0] + 2;
      const double weighted = weight * (1 + both.a2 * S2 + both.a3 * S3);
      mu2 += weighted * (x[0] - y[0]);
      linear2 += weight * (x[0] - y[0]);
      mu4 += weighted * (x[1] - y[1]);
      mu6 += weighted * (x[2] - y[2]);
    };
    constexpr int kMost = 13;
    const auto gauss = [](double k) { return std::exp(-0.5 * k * k * 4 / 9); };
    for (int i = -kMost; i <= kMost; ++i)
      for (int j = -kMost; j <= kMost; ++j)
        for (int k = -kMost; k <= kMost; ++k)
          for (int n = -140; n <= 25; ++n) {
            const double rx = std::exp(0.1 * n);
            const double weight =
                gauss(i) * gauss(j) * gauss(k) * rx * rx * std::exp(-0.5 * rx * rx);
            add(i / 3.0, j / 3.0, rx, k * 2 / 3.0, weight);
          }
    EXPECT_NEAR((mu4 - (D + 2) * (mu2 + both.a2 * linear2)) / linear2, 0, 1e-9) << e;
    EXPECT_NEAR(
        (mu6 - 0.75 * (D + 2) * (D + 4) * (mu2 + (3 * both.a2 - both.a3) * linear2)) / linear2, 0,
        1e-9)
        << e;
  }
}

TEST(GasTheory, ContactCorrelations) {
  EXPECT_DOUBLE_EQ(contact_correlation(2, 0), 1);
  EXPECT_DOUBLE_EQ(contact_correlation(3, 0), 1);
  // The virial coefficients: 1 + (25/16) φ + … and 1 + (5/2) φ + ….
  EXPECT_NEAR((contact_correlation(2, 1e-6) - 1) / 1e-6, 25.0 / 16, 1e-5);
  EXPECT_NEAR((contact_correlation(3, 1e-6) - 1) / 1e-6, 2.5, 1e-5);
}

}  // namespace
}  // namespace slipcheck
