#include "physics/contact/coupled_friction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace slipcheck {
namespace {

using std::numbers::pi;

constexpr std::array kPressures = {DiscPressure::uniform, DiscPressure::hertzian};

/// Torque of pure drilling: the mean of r under the pressure.
double pure_drilling(DiscPressure pressure) {
  return pressure == DiscPressure::uniform ? 2.0 / 3 : 3 * pi / 16;
}

/// ∫ f over [a, b] by the double exponential rule, which does not mind roots at the ends.
double quadrature(const std::function<double(double)>& f, double a, double b) {
  const double h = 0.05;
  double sum = 0;
  for (int n = -70; n <= 70; ++n) {
    const double t = h * n;
    const double z = std::tanh(0.5 * pi * std::sinh(t));
    const double weight = 0.5 * pi * std::cosh(t) / std::pow(std::cosh(0.5 * pi * std::sinh(t)), 2);
    sum += weight * f(0.5 * (a + b) + 0.5 * (b - a) * z);
  }
  return 0.5 * (b - a) * h * sum;
}

/// The integral over the disc itself. Seen from the point about which the disc turns, at the
/// distance k from its centre, in the direction α from the line to it: the chord's middle lies at
/// k cos α, the chord reaches h to both sides, the pressure depends on r² = 1 − h² + δ² at δ from
/// the middle, and the element rubs along (cos α, sin α).
CoupledFriction by_brute_force(DiscPressure pressure, double slip, double rim) {
  const double k = slip / rim;
  const auto density = [&](double one_minus_r2) {
    if (pressure == DiscPressure::uniform) return 1 / pi;
    return 1.5 / pi * std::sqrt(std::max(0.0, one_minus_r2));
  };
  CoupledFriction sum{0, 0};
  const auto add = [&](double from, double to) {
    const auto over_chord = [&](double alpha, const std::function<double(double)>& lever) {
      const double middle = k * std::cos(alpha);
      const double h = std::sqrt(std::max(0.0, 1 - std::pow(k * std::sin(alpha), 2)));
      return quadrature(
          [&](double d) { return density((h - d) * (h + d)) * (middle + d) * lever(d); },
          std::max(-h, -middle), h);
    };
    sum.force += 2 * quadrature(
                         [&](double alpha) {
                           return std::cos(alpha) * over_chord(alpha, [](double) { return 1.0; });
                         },
                         from, to);
    sum.torque +=
        2 * quadrature([&](double alpha) { return over_chord(alpha, [](double d) { return d; }); },
                       from, to);
  };
  if (k < 1) {
    add(0, pi / 2);
    add(pi / 2, pi);
  } else {
    add(0, std::asin(1 / k));
  }
  return sum;
}

TEST(CoupledFriction, IsTheIntegralOverTheDisc) {
  for (DiscPressure pressure : kPressures) {
    for (double k : {0.01, 0.1, 0.29, 0.31, 0.5, 0.7, 0.9, 0.99, 0.9999, 1.0001, 1.01, 1.1, 1.5,
                     2.0, 2.8, 2.9, 4.0, 10.0, 30.0}) {
      const CoupledFriction exact = by_brute_force(pressure, 0.02 * k, 0.02);
      const CoupledFriction friction = coupled_friction(pressure, 0.02 * k, 0.02);
      // The quadrature's own error sets the tolerance: rounding, and for the force at small k, the
      // torque at large k, cancellation over the disc by a factor 1/k, k.
      EXPECT_NEAR(friction.force / exact.force, 1, 1e-12) << k;
      EXPECT_NEAR(friction.torque / exact.torque, 1, 1e-12) << k;
    }
  }
}

TEST(CoupledFriction, LimitsOfPureSlidingAndPureDrilling) {
  for (DiscPressure pressure : kPressures) {
    const CoupledFriction sliding = coupled_friction(pressure, 0.3, 0);
    EXPECT_EQ(sliding.force, 1);
    EXPECT_EQ(sliding.torque, 0);
    const CoupledFriction drilling = coupled_friction(pressure, 0, 0.3);
    EXPECT_EQ(drilling.force, 0);
    EXPECT_NEAR(drilling.torque / pure_drilling(pressure), 1, 1e-15);
  }
}

TEST(CoupledFriction, SmallSlipMeetsAForceInProportion) {
  // Φ'' at the centre is half of the mean of 1/r: 1 uniform, 3π/8 Hertzian. Next order k².
  for (double k : {1e-4, 1e-8, 1e-100}) {
    EXPECT_NEAR(coupled_friction(DiscPressure::uniform, k, 1).force / k, 1, k * k + 1e-15);
    EXPECT_NEAR(coupled_friction(DiscPressure::hertzian, k, 1).force / k, 3 * pi / 8,
                k * k + 1e-15);
  }
  // ∫ k Φ'' dk: the torque falls by half of that slope times k².
  EXPECT_NEAR((2.0 / 3 - coupled_friction(DiscPressure::uniform, 1e-3, 1).torque) / 1e-6, 0.5,
              1e-6);
  EXPECT_NEAR((3 * pi / 16 - coupled_friction(DiscPressure::hertzian, 1e-3, 1).torque) / 1e-6,
              3 * pi / 16, 1e-6);
}

TEST(CoupledFriction, SlowSpinMeetsATorqueInProportion) {
  // Far away s ≈ k + ... + r² sin²θ/(2 k): the torque is ⟨r²⟩ x/2, the force 1 − ⟨r²⟩ x²/4, with
  // ⟨r²⟩ = 1/2 uniform, 2/5 Hertzian. Next order x² of the same.
  for (double x : {1e-4, 1e-8, 1e-100, 1e-200}) {
    EXPECT_NEAR(coupled_friction(DiscPressure::uniform, 1, x).torque / x, 0.25, x * x + 1e-16);
    EXPECT_NEAR(coupled_friction(DiscPressure::hertzian, 1, x).torque / x, 0.2, x * x + 1e-16);
  }
  EXPECT_NEAR((1 - coupled_friction(DiscPressure::uniform, 1, 1e-3).force) / 1e-6, 0.125, 1e-6);
  EXPECT_NEAR((1 - coupled_friction(DiscPressure::hertzian, 1, 1e-3).force) / 1e-6, 0.1, 1e-6);
}

TEST(CoupledFriction, BothBranchesMeetWhereTheRimStandsStill) {
  // Uniform 8/(3π), 8/(9π); Hertzian 9π/32, 9π/128.
  const auto expected = [](DiscPressure pressure) {
    return pressure == DiscPressure::uniform ? CoupledFriction{8 / (3 * pi), 8 / (9 * pi)}
                                             : CoupledFriction{9 * pi / 32, 9 * pi / 128};
  };
  for (DiscPressure pressure : kPressures) {
    for (double slip : {std::nextafter(1.0, 0), 1.0, std::nextafter(1.0, 2), 1 + 1e-14}) {
      const CoupledFriction friction = coupled_friction(pressure, slip, 1);
      EXPECT_NEAR(friction.force, expected(pressure).force, 2e-14);
      EXPECT_NEAR(friction.torque, expected(pressure).torque, 2e-14);
    }
  }
}

TEST(CoupledFriction, DependsOnTheRatioAlone) {
  for (DiscPressure pressure : kPressures) {
    for (double unit : {1e-150, 1e-9, 1e150}) {
      const CoupledFriction a = coupled_friction(pressure, 0.75, 1);
      const CoupledFriction b = coupled_friction(pressure, 0.75 * unit, unit);
      EXPECT_NEAR(a.force, b.force, 1e-15);
      EXPECT_NEAR(a.torque, b.torque, 1e-15);
    }
  }
}

TEST(CoupledFriction, ForceAndTorqueAreTheDerivativesOfThePower) {
  const auto power = [](DiscPressure pressure, double slip, double rim) {
    const CoupledFriction f = coupled_friction(pressure, slip, rim);
    return f.force * slip + f.torque * rim;
  };
  const double h = 1e-5;
  for (DiscPressure pressure : kPressures) {
    for (double slip : {0.05, 0.3, 0.8, 0.999, 1.001, 1.3, 2.5, 2.86, 3.5, 20.0}) {
      const CoupledFriction f = coupled_friction(pressure, slip, 1);
      // Central differences: h²/6 of a third derivative, which rises as ln|1 − k| at the rim for
      // uniform pressure's second and as 1/|1 − k| for its third; and rounding, ε power/h.
      const double error = 1e-10 * (1 + 0.2 / std::abs(1 - slip)) + 2.2e-11 * (1 + slip);
      EXPECT_NEAR((power(pressure, slip + h, 1) - power(pressure, slip - h, 1)) / (2 * h), f.force,
                  error)
          << slip;
      EXPECT_NEAR((power(pressure, slip, 1 + h) - power(pressure, slip, 1 - h)) / (2 * h), f.torque,
                  error)
          << slip;
      // Hence the mixed derivatives agree: the limit surface is convex and friction is maximal.
      const auto slope = [&](double u, double w, auto part) {
        const CoupledFriction b = coupled_friction(pressure, slip + h * u, 1 + h * w);
        const CoupledFriction a = coupled_friction(pressure, slip - h * u, 1 - h * w);
        return (b.*part - a.*part) / (2 * h);
      };
      const double of_force = slope(0, 1, &CoupledFriction::force);
      const double of_torque = slope(1, 0, &CoupledFriction::torque);
      EXPECT_NEAR(of_force, of_torque, 1e-9 + 1e-10 / std::pow(1 - slip, 2)) << slip;
      EXPECT_LT(of_force, 0);
    }
  }
}

TEST(CoupledFriction, NeverDissipatesLessThanSlidingOrDrillingAlone) {
  for (DiscPressure pressure : kPressures) {
    double force = 0, torque = 1;
    for (int n = -400; n <= 400; ++n) {
      const double k = std::pow(10, 0.02 * n);
      const CoupledFriction f = coupled_friction(pressure, k, 1);
      const double power = f.force * k + f.torque;
      // |mean velocity| <= mean |velocity|, and the mean distance is least from the centre.
      EXPECT_GE(power, k * (1 - 1e-15)) << k;
      EXPECT_GE(power, pure_drilling(pressure) * (1 - 1e-15)) << k;
      // With more slip the force rises and the torque falls, without an end before the limits.
      EXPECT_GE(f.force, force * (1 - 1e-15)) << k;
      EXPECT_LE(f.torque, torque * (1 + 1e-15)) << k;
      EXPECT_LE(f.force, 1);
      force = f.force;
      torque = f.torque;
    }
  }
}

TEST(CoupledFriction, BranchesAndSeriesJoinWithoutAStep) {
  // A jump would stop an integrator of high order. Where the series takes over (rim/slip = 0.35)
  // neighbours differ by rounding alone.
  const double slip = 1 / 0.35;
  const CoupledFriction below = coupled_friction(DiscPressure::hertzian, slip * (1 - 1e-15), 1);
  const CoupledFriction above = coupled_friction(DiscPressure::hertzian, slip * (1 + 1e-15), 1);
  EXPECT_NEAR(below.force, above.force, 2e-14);
  EXPECT_NEAR(below.torque / above.torque, 1, 1e-13);
}

TEST(CoupledFriction, PadeFormsOfZhuravlevAndKireenkovAreRightAtBothEndsOnly) {
  // F = u/(u + (8/3π) a ω), M = (3π/16) a ω/(a ω + (15π/16) u): exact limits and first slopes at
  // u = 0, exact limits at ω = 0, where F = 1 − O(ω) has a slope that the integral has not.
  const auto force = [](double u, double w) { return u / (u + 8 / (3 * pi) * w); };
  const auto torque = [](double u, double w) { return 3 * pi / 16 * w / (w + 15 * pi / 16 * u); };
  const auto exact = [](double u, double w) {
    return coupled_friction(DiscPressure::hertzian, u, w);
  };
  EXPECT_NEAR(force(1e-6, 1) / exact(1e-6, 1).force, 1, 2e-6);
  EXPECT_NEAR(torque(1, 1e-6) / exact(1, 1e-6).torque, 1, 2e-6);
  EXPECT_NEAR(torque(1e-9, 1), exact(1e-9, 1).torque, 1e-8);
  EXPECT_NEAR(force(1e9, 1), 1, 1e-8);
  // In between both are too small; at u = a ω by 1 − (1 + 8/3π)⁻¹/(9π/32) = 39 % and by a third.
  EXPECT_NEAR(force(1, 1) / exact(1, 1).force, 1 / (1 + 8 / (3 * pi)) / (9 * pi / 32), 1e-14);
  EXPECT_NEAR(torque(1, 1) / exact(1, 1).torque, 3 * pi / 16 / (1 + 15 * pi / 16) / (9 * pi / 128),
              1e-14);
  for (double k = 0.01; k < 100; k *= 1.1) {
    EXPECT_LT(force(k, 1), exact(k, 1).force);
    EXPECT_LT(torque(k, 1), exact(k, 1).torque);
    EXPECT_NEAR(force(k, 1), exact(k, 1).force, 0.35);
    EXPECT_NEAR(torque(k, 1), exact(k, 1).torque, 0.26);
  }
}

}  // namespace
}  // namespace slipcheck
