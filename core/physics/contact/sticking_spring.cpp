#include "physics/contact/sticking_spring.h"

#include <algorithm>
#include <cmath>

namespace slipcheck {

StickingSpring sticking_spring(double beta, double duration) {
  constexpr double kDamped = 0.5;
  if (beta <= -1) return {};
  double a = kDamped;
  // e^(−a φ') > β with a φ' <= π a
  if (beta > 0) a = std::min(a, -0.5 * std::log(beta) / M_PI);
  const auto left = [a](double phase) {
    return std::exp(-a * phase) * (std::cos(phase) - a * std::sin(phase));
  };
  double low = 0, high = M_PI - 2 * std::atan(a);
  for (int n = 0; n < 60; ++n) {
    const double mid = 0.5 * (low + high);
    (left(mid) > -beta ? low : high) = mid;
  }
  const double growth = std::hypot(1, a);  // 1/√(1 − ζ²)
  return {high * growth / duration, a / growth};
}

}  // namespace slipcheck
