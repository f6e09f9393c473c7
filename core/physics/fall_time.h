#pragma once

#include <cmath>

#include "physics/numbers.h"

namespace slipcheck {

/// When a body at a height h [m], >= 0, that rises with v [m/s] comes down to 0 [s]:
///   h + v t − ½ g t² = 0,
/// in the form without cancellation. Infinity where it never does, and at rest at 0.
inline double fall_time(double h, double v, double g) {
  const double root = std::sqrt(v * v + 2 * g * h);
  if (v > 0) return g > 0 ? (v + root) / g : kNever;
  return root - v > 0 ? 2 * h / (root - v) : kNever;
}

}  // namespace slipcheck
