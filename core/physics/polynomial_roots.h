#pragma once

#include <array>

namespace slipcheck {

/// c[0] + c[1] t + … + c[4] t⁴; leading coefficients may be zero.
using Quartic = std::array<double, 5>;

/// The smallest t in [0, limit] at which f(t) <= 0 while f falls, or infinity.
///
/// With f the squared gap of two spheres this is the time of their collision: a pair that touches
/// and separates does not collide, a pair that touches and approaches collides at once. `limit` may
/// be infinite. The roots of f'' bound the intervals on which f' is monotonic, its roots those on
/// which f is, and each such interval holds at most one root, found by bracketed Newton steps: no
/// root is missed or found twice, however close roots lie, up to the rounding error of f itself.
double first_falling_root(const Quartic& f, double limit);

}  // namespace slipcheck
