#include "reference/path_collision.h"

#include <algorithm>
#include <cmath>

#include "physics/numbers.h"
#include "physics/polynomial_roots.h"

namespace slipcheck {
namespace {

/// The least of c t + ½ b t² for t in [0, horizon].
double least_on(double c, double b, double horizon) {
  if (b > 0) {
    const double t = std::clamp(-c / b, 0.0, horizon);
    return t * (c + 0.5 * b * t);
  }
  if (b == 0 && c >= 0) return 0;
  return std::isfinite(horizon) ? std::min(0.0, horizon * (c + 0.5 * b * horizon)) : -kNever;
}

}  // namespace

double time_to_touch(const Vector3& x, const Vector3& v, const Vector3& a, double contact,
                     double horizon) {
  const double distance = x.norm();
  const double approach = x.dot(v), pull = x.dot(a);
  // The distance is at least its part along x, which settles most pairs.
  constexpr double kRounding = 1e-9;
  if (distance + least_on(approach, pull, horizon) / distance > (1 + kRounding) * contact)
    return kNever;
  // The difference of squares as a product keeps its digits where the gap is small.
  const double gap = (distance - contact) * (distance + contact);
  if (a == Vector3::Zero()) {
    if (approach >= 0) return kNever;
    if (gap <= 0) return 0;
    const double square = approach * approach - v.squaredNorm() * gap;
    if (square < 0) return kNever;
    const double t = gap / (std::sqrt(square) - approach);
    return t <= horizon ? t : kNever;
  }
  // |x + v t + ½ a t²|² − contact²
  const Quartic f = {gap, 2 * approach, v.squaredNorm() + pull, v.dot(a), 0.25 * a.squaredNorm()};
  return first_falling_root(f, horizon);
}

}  // namespace slipcheck
