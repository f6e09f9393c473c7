#pragma once

#include <cmath>
#include <utility>

namespace slipcheck {

/// Where a function that is nearly straight between a and b is zero, by the secant rule, to 1e-9 of
/// b − a or after twenty steps.
template <class Function>
double secant_zero(const Function& f, double a, double b) {
  const double enough = 1e-9 * std::abs(b - a);
  double at_a = f(a), at_b = f(b);
  for (int n = 0; n < 20 && std::abs(b - a) > enough && at_b != at_a; ++n) {
    const double next = b - at_b * (b - a) / (at_b - at_a);
    a = std::exchange(b, next);
    at_a = std::exchange(at_b, f(next));
  }
  return b;
}

}  // namespace slipcheck
