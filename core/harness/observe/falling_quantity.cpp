#include "harness/observe/falling_quantity.h"

#include <algorithm>
#include <cmath>

namespace slipcheck {

double FallingQuantity::time_to_zero(double before, double after, double dt) const {
  const double expected = before - rate_ * dt;
  if (rate_ <= 0 || expected <= 0) return time_to_zero(before, dt);
  // It counts as zero but goes on falling as before: its zero lies a little further on.
  return std::abs(after - expected) <= std::min(0.1 * rate_ * dt, 0.5 * expected) ? before / rate_
                                                                                  : dt;
}

double FallingQuantity::time_to_zero(double before, double dt) const {
  return before < rate_ * dt ? before / rate_ : dt;
}

}  // namespace slipcheck
