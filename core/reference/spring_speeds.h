#pragma once

namespace slipcheck {

/// How fast a body moves at most by the springs of what carries it alone, as its friction or its
/// weight comes and goes.
struct SpringSpeeds {
  double slip = 0;  ///< while it sticks: μ_s m g/√(κ m k_t) [m/s]
  double rise = 0;  ///< while it is carried: √(g ξ) at the overlap ξ under its weight [m/s]
};

}  // namespace slipcheck
