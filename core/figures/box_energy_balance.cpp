#include "figures/box_energy_balance.h"

#include <algorithm>
#include <cmath>

namespace slipcheck {
namespace {

/// The mean gain of rotational energy in a collision over m T, where R²⟨ω²⟩ = w T and T is the mean
/// square of one component of the velocity.
double mean_gain(const RoughGas& gas, double w) {
  constexpr int kPoints = 200;
  constexpr double kFarthest = 6;  // standard deviations
  const double q = gas.shape_factor;
  const double stick = 0.5 * q / (1 + q) * (1 + gas.tangential_restitution);
  const double slide = 0.5 * gas.friction * (1 + gas.restitution);
  const double deviation = std::sqrt(2 + 2 * w);  // of u_t
  const double share = w / (1 + w);               // the mean of S at a given u_t is −share u_t
  double gain = 0, weights = 0;
  for (int a = 0; a < kPoints; ++a) {
    const double z = kFarthest * (a + 0.5) / kPoints;
    const double u_t = deviation * z;
    const double weight = std::exp(-0.5 * z * z);
    for (int b = 0; b < kPoints; ++b) {
      // Equally probable intervals of u_n.
      const double u_n = 2 * std::sqrt(-std::log((b + 0.5) / kPoints));
      const double p = std::min(stick * u_t, slide * u_n);
      gain += weight * p * (p / q - share * u_t);
      weights += weight;
    }
  }
  return gain / weights;
}

}  // namespace

double RoughGas::ratio_15() const {
  return (2 / shape_factor + 1 / friction) / (1 + tangential_restitution);
}

double RoughGas::ratio_of_chaos() const {
  // The gain is positive for spheres at rest and falls with w: bisection of ln w.
  double low = std::log(1e-8), high = std::log(1e4);
  for (int n = 0; n < 40; ++n) {
    const double middle = 0.5 * (low + high);
    (mean_gain(*this, std::exp(middle)) > 0 ? low : high) = middle;
  }
  // K = m T for two components, R = ½ q m w T.
  return 2 / (shape_factor * std::exp(low));
}

double RoughGas::ratio_of_sticking_chaos() const {
  const double q = shape_factor, beta = tangential_restitution;
  return 2 / q * (1 + 2 * q - beta) / (1 + beta);
}

}  // namespace slipcheck
