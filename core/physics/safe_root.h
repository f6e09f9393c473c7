#pragma once

#include <cmath>

#include "physics/numbers.h"

namespace slipcheck {

/// How far g stays above zero for sure, from where it is `value` > 0 with this slope, if
/// |g''| <= curvature: to where the parabola that bounds it from below,
///   value + slope τ − ½ curvature τ²,
/// is zero; infinity where it never is. Such steps pass no root and converge quadratically.
inline double step_to_bound(double value, double slope, double curvature) {
  const double root = std::sqrt(slope * slope + 2 * curvature * value);
  if (slope < 0) return 2 * value / (root - slope);
  return curvature > 0 ? (slope + root) / curvature : kNever;
}

/// The first t in [0, end] at which g(t) <= 0, or infinity; g and its slope by
/// `g(t, slope) -> value`, and |g''| <= curvature. A g that only touches zero may count as a root.
template <class Function>
double first_zero(const Function& g, double curvature, double end) {
  double t = 0;
  for (int n = 0; n < 500; ++n) {
    double slope = 0;
    const double value = g(t, slope);
    if (value <= 0) return t;
    const double step = step_to_bound(value, slope, curvature);
    if (t + step > end) return kNever;
    if (t + step == t) return t;
    t += step;
  }
  return t;
}

/// Where a condition becomes true in (low, high], to rounding.
template <class Condition>
double first_true(double low, double high, const Condition& holds) {
  for (;;) {
    const double mid = 0.5 * (low + high);
    if (mid <= low || mid >= high) return high;
    (holds(mid) ? high : low) = mid;
  }
}

}  // namespace slipcheck
