#include "reference/gas/sonine.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace slipcheck {
namespace {

constexpr std::size_t kPoints = 7;  // exact up to the power 13

struct Rule {
  std::array<double, kPoints> x, weight;  // of a mean: the weights add up to 1
};

/// Golub and Welsch's eigenvalue problem by Newton's method on the orthogonal polynomials of the
/// recurrence p_{n+1} = (x − a_n) p_n − b_n p_{n−1}, roots found one after the other with those
/// before divided out; the weights are 1/Σ p_n²/(b_1 … b_n).
template <class A, class B>
Rule gauss_rule(A a, B b, double start) {
  Rule rule{};
  for (std::size_t k = 0; k < kPoints; ++k) {
    double x = start;
    for (int turn = 0; turn < 200; ++turn) {
      double p = 1, before = 0, d = 0, d_before = 0;
      for (std::size_t n = 0; n < kPoints; ++n) {
        const double next = (x - a(n)) * p - b(n) * before;
        const double d_next = p + (x - a(n)) * d - b(n) * d_before;
        before = p, p = next;
        d_before = d, d = d_next;
      }
      double slope = d / p;
      if (p == 0) break;
      for (std::size_t j = 0; j < k; ++j) slope -= 1 / (x - rule.x[j]);
      const double step = 1 / slope;
      x -= step;
      if (std::abs(step) < 1e-15 * (1 + std::abs(x))) break;
    }
    rule.x[k] = x;
    double p = 1, before = 0, norm = 1, sum = 0;
    for (std::size_t n = 0; n < kPoints; ++n) {
      sum += p * p / norm;
      const double next = (x - a(n)) * p - b(n) * before;
      before = p, p = next;
      norm *= b(n + 1);
    }
    rule.weight[k] = 1 / sum;
    start = x + 1e-3;  // beyond it, towards the next
  }
  return rule;
}

/// Of a normal component of variance 1.
const Rule& hermite() {
  static const Rule rule = gauss_rule([](std::size_t) { return 0.0; },
                                      [](std::size_t n) { return static_cast<double>(n); }, -8);
  return rule;
}
/// Of t ≥ 0 with exp(−t): r_x²/2 under the flux.
const Rule& laguerre() {
  static const Rule rule =
      gauss_rule([](std::size_t n) { return 2.0 * static_cast<double>(n) + 1; },
                 [](std::size_t n) { return static_cast<double>(n * n); }, -1);
  return rule;
}

/// Coefficients of 1, a_2 and a_3.
using Linear = std::array<double, 3>;

struct Collided {
  Linear mu2{}, mu4{}, mu6{};
};

/// The collision of c1, c2 = R ± r/2 along x: r_x → −e r_x.
void add_collision(Collided& mu, double weight, int dimensions, double e, const double* R,
                   const double* r) {
  const double D = dimensions;
  double square = 0, product = 0;
  for (int c = 0; c < dimensions; ++c) {
    square += R[c] * R[c] + 0.25 * r[c] * r[c];
    product += R[c] * r[c];
  }
  const double square_after = square - 0.25 * (1 - e * e) * r[0] * r[0];
  const double product_after = product - (1 + e) * R[0] * r[0];
  const auto powers = [](double s, double p) {
    const double x = s + p, y = s - p;
    return std::array<double, 3>{x + y, x * x + y * y, x * x * x + y * y * y};
  };
  const auto [x1, x2, x3] = powers(square, product);
  const auto [y1, y2, y3] = powers(square_after, product_after);
  const double S2 = 0.5 * x2 - (D + 2) / 2 * x1 + D * (D + 2) / 4;
  const double S3 =
      -x3 / 6 + (D + 4) / 4 * x2 - (D + 2) * (D + 4) / 8 * x1 + D * (D + 2) * (D + 4) / 24;
  const Linear by{weight, weight * S2, weight * S3};
  for (std::size_t k = 0; k < 3; ++k) {
    mu.mu2[k] += by[k] * (x1 - y1);
    mu.mu4[k] += by[k] * (x2 - y2);
    mu.mu6[k] += by[k] * (x3 - y3);
  }
}

/// Over the components of R (variance 1/4) and r (variance 1) that are left.
void add_components(Collided& mu, double weight, int dimensions, double e, double* at,
                    int component) {
  if (component == 2 * dimensions) {
    add_collision(mu, weight, dimensions, e, at, at + dimensions);
    return;
  }
  const bool flux = component == dimensions;
  const Rule& rule = flux ? laguerre() : hermite();
  const double scale = component < dimensions ? 0.5 : 1;
  for (std::size_t k = 0; k < kPoints; ++k) {
    at[component] = flux ? std::sqrt(2 * rule.x[k]) : scale * rule.x[k];
    add_components(mu, weight * rule.weight[k], dimensions, e, at, component + 1);
  }
}

}  // namespace

SonineCoefficients sonine_cooling_state(int dimensions, double e) {
  Collided mu;
  std::array<double, 6> at{};
  add_components(mu, 1, dimensions, e, at.data(), 0);
  // To first order in both, with q = ⟨c^n⟩ n/D of a Maxwellian:
  //   μ4 = q4 (μ2 (1 + a2)),  μ6 = q6 μ2 (1 + 3 a2 − a3).
  const double D = dimensions, q4 = D + 2, q6 = 0.75 * (D + 2) * (D + 4);
  const auto& [A0, A2, A3] = mu.mu2;
  const double b2 = mu.mu4[1] - q4 * (A2 + A0), b3 = mu.mu4[2] - q4 * A3, b = q4 * A0 - mu.mu4[0];
  const double c2 = mu.mu6[1] - q6 * (A2 + 3 * A0), c3 = mu.mu6[2] - q6 * (A3 - A0);
  const double c = q6 * A0 - mu.mu6[0];
  const double determinant = b2 * c3 - b3 * c2;
  return {(b * c3 - c * b3) / determinant, (b2 * c - c2 * b) / determinant};
}

}  // namespace slipcheck
