#include "physics/contact/coupled_friction.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace slipcheck {

// The disc has the radius 1 and turns about the point at the distance k = slip/rim speed from its
// centre; an element at the distance s from that point moves at the speed s Ω. Per μ N, with
// ∫ p dA = 1,
//
//   Φ(k) = ∫ p s dA,  power = Ω Φ(k),  force = ∂power/∂slip = Φ',  torque = Φ − k Φ'.
//
// ∇² s = 1/s in the plane, so (k Φ')'/k = ∫ (p/s) dA: the potential of a charged disc, known in
// closed form both inside and outside of it. Below, x = 1/k where the point lies outside.

namespace {

using std::numbers::pi;

/// Complete elliptic integrals of modulus k in [0, 1) by the arithmetic-geometric mean:
/// K = π/(2 a_∞) and E = K (1 − k²/2 − k⁴ U) with U = Σ_{n>=1} 2^(n−1) (c_n/k²)². Nothing cancels
/// for small k.
struct EllipticIntegrals {
  double K, U;

  explicit EllipticIntegrals(double k) {
    double a = 1;
    double b = std::sqrt((1 - k) * (1 + k));
    double d = 1 / (2 * (1 + b));  // c_n/k², from c_1 = (1 − b)/2 = k²/(2 (1 + b))
    double weight = 1;
    double sum = d * d;
    while (true) {
      const double mean = 0.5 * (a + b);
      // a_n − a_∞ is c_{n+1} = c_n²/(4 a_{n+1}), here below the rounding error.
      const double c = k * k * d;
      if (c < 1e-8 * mean) {
        K = 0.5 * pi / mean;
        U = sum;
        return;
      }
      b = std::sqrt(a * b);
      a = mean;
      d *= c / (2 * (a + b));
      weight *= 2;
      sum += weight * d * d;
    }
  }
};

/// p = 1/π. Inside, ∫ (p/s) dA = (4/π) E(k); outside the real part of the same, so that
///   inside  force = 4/(3π k) G(k),  torque = 4/(9π) [(4 − 2k²) E − (1 − k²) K],
///   outside force = 4/(3π x²) G(x), torque = 4/(9π x³) [(4x² − 2) E + (1 − x²)(2 − 3x²) K],
/// with G(k) = (1 + k²) E − (1 − k²) K. E is expressed through K and U, which leaves no differences
/// of nearly equal numbers.
CoupledFriction uniform(double slip, double rim) {
  if (slip == rim) return {8 / (3 * pi), 8 / (9 * pi)};
  const bool inside = slip < rim;
  const double k = inside ? slip / rim : rim / slip;  // x outside
  const EllipticIntegrals elliptic(k);
  const double K = elliptic.K, U = elliptic.U;
  const double k2 = k * k;
  const double g = K * (1.5 - 0.5 * k2 - (1 + k2) * k2 * U);  // G/k²
  if (inside) {
    const double E = K * (1 - 0.5 * k2 - k2 * k2 * U);
    return {4 / (3 * pi) * k * g, 4 / (9 * pi) * ((4 - 2 * k2) * E - (1 - k2) * K)};
  }
  return {4 / (3 * pi) * g, 4 / (9 * pi) * K * k * (1 + (2 - 4 * k2) * U)};
}

/// Outside, s = k √(1 − 2 r x cos θ + r² x²) has the mean k Σ c_n² (r x)^(2n) over θ,
/// c_n = (−1/2)_n/n!; with the moments of the pressure, ⟨r^(2n)⟩ = Π_{j<=n} j/(j + 3/2), the
/// coefficients c_n² ⟨r^(2n)⟩ of Φ/k in x^(2n).
constexpr std::size_t kTerms = 13;
constexpr std::array<double, kTerms> kHertzian = [] {
  std::array<double, kTerms> coefficients{1};
  double c = 1, moment = 1;
  for (std::size_t n = 1; n < kTerms; ++n) {
    const auto j = static_cast<double>(n);
    c *= (j - 1.5) / j;
    moment *= j / (j + 1.5);
    coefficients[n] = c * c * moment;
  }
  return coefficients;
}();

/// Above it the closed form loses at most a factor 60 to cancellation; below it the series' first
/// neglected term is below 1e-16 of the sum.
constexpr double kSeriesBelow = 0.35;

/// p = 3/(2π) √(1 − r²), whose potential is (3π/8)(2 − k²) inside and (3/4)((2 − k²) asin x +
/// √(k² − 1)) outside.
CoupledFriction hertzian(double slip, double rim) {
  if (slip <= rim) {
    const double k = slip / rim, k2 = k * k;
    return {3 * pi / 8 * k * (1 - k2 / 4), 3 * pi / 16 * (1 - k2 + 3 * k2 * k2 / 8)};
  }
  const double x = rim / slip, x2 = x * x;
  if (x < kSeriesBelow) {
    double force = 0, torque = 0;
    for (std::size_t n = kTerms - 1; n > 0; --n) {
      const auto twice_n = static_cast<double>(2 * n);
      force = force * x2 + (1 - twice_n) * kHertzian[n];
      torque = torque * x2 + twice_n * kHertzian[n];
    }
    return {1 + force * x2, torque * x};
  }
  // asin and the root of the same rounded x: their steep rise at x = 1 cancels.
  const double k = 1 / x, k2 = k * k;
  const double angle = std::asin(x), root = std::sqrt((1 - x) * (1 + x));
  return {0.75 * (k * (1 - k2 / 4) * angle + root * (0.5 + k2 / 4)),
          0.75 * ((0.5 - 0.5 * k2 + 0.1875 * k2 * k2) * angle + root * k * (0.375 - 0.1875 * k2))};
}

}  // namespace

CoupledFriction coupled_friction(DiscPressure pressure, double slip, double rim_speed) {
  assert(slip >= 0 && rim_speed >= 0 && slip + rim_speed > 0);
  CoupledFriction result =
      pressure == DiscPressure::uniform ? uniform(slip, rim_speed) : hertzian(slip, rim_speed);
  result.force = std::min(result.force, 1.0);
  return result;
}

}  // namespace slipcheck
