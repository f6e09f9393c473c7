#pragma once

#include <cmath>
#include <limits>

namespace slipcheck {

/// The first t in [0, end] at which g(t) <= 0, or infinity; g and its slope by
/// `g(t, slope) -> value`, and |g''| <= curvature.
///
/// Each step goes to where the parabola that bounds g from below is zero: no root is passed, and
/// the steps converge quadratically. A g that only touches zero may count as a root.
template <class Function>
double first_zero(const Function& g, double curvature, double end) {
  double t = 0;
  for (int n = 0; n < 500; ++n) {
    double slope = 0;
    const double value = g(t, slope);
    if (value <= 0) return t;
    const double root = std::sqrt(slope * slope + 2 * curvature * value);
    const double step = slope < 0 ? 2 * value / (root - slope)
                                  : (curvature > 0 ? (slope + root) / curvature
                                                   : std::numeric_limits<double>::infinity());
    if (t + step > end) return std::numeric_limits<double>::infinity();
    if (t + step == t) return t;
    t += step;
  }
  return t;
}

}  // namespace slipcheck
