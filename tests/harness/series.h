#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace slipcheck::test {

/// Normal deviates, the same on every platform (Box and Muller).
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : random_(seed) {}
  double operator()() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  double uniform() { return (static_cast<double>(random_() >> 11) + 0.5) * 0x1p-53; }
  std::mt19937_64 random_;
};

/// A stationary AR(1) series of mean 0 and variance 1: x_k+1 = ρ x_k + √(1 − ρ²) times a normal
/// deviate, so that two samples k apart have the correlation ρ^k.
inline std::vector<double> correlated(std::size_t n, double rho, std::uint64_t seed) {
  Normal normal(seed);
  std::vector<double> x(n);
  double now = normal();
  for (double& value : x) {
    value = now;
    now = rho * now + std::sqrt(1 - rho * rho) * normal();
  }
  return x;
}

/// The variance of the mean of such a series: (1/n²) Σ_ij ρ^|i−j| summed in closed form.
inline double variance_of_mean(std::size_t n, double rho) {
  const auto count = static_cast<double>(n);
  return ((1 + rho) / (1 - rho) -
          2 * rho * (1 - std::pow(rho, count)) / (count * (1 - rho) * (1 - rho))) /
         count;
}

}  // namespace slipcheck::test
