#include "reference/events/path_collision.h"

#include <algorithm>
#include <cmath>

#include "physics/numbers.h"
#include "physics/polynomial_roots.h"
#include "physics/safe_root.h"

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

/// Bodies farther apart than so many times the sum of their radii are brought near first.
constexpr double kFar = 32;

/// A time until which |x + v t + ½ a t²| does not fall to `near` and at which it has come so far,
/// but for a small part; infinity where not in [0, horizon]. The distance never bends more than |a|
/// towards zero. It is that of places, so that no squares of it cancel.
double time_to_near(const Vector3& x, const Vector3& v, const Vector3& a, double near,
                    double horizon) {
  const double bend = a.norm();
  double t = 0;
  while (t <= horizon) {
    const Vector3 apart = x + t * (v + (0.5 * t) * a);
    const double distance = apart.norm();
    const double open = distance - near;
    if (open <= 1e-3 * near) return t;
    const double closing = -apart.dot(v + t * a) / distance;
    const double step = step_to_bound(open, -closing, bend);
    if (step == kNever) return kNever;
    if (t + step == t) return t;
    t += step;
  }
  return kNever;
}

/// time_to_touch() of bodies that are not far apart.
double touch_from_near(const Vector3& x, const Vector3& v, const Vector3& a, double contact,
                       double horizon) {
  const double distance = x.norm();
  const double approach = x.dot(v);
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
  const Quartic f = {gap, 2 * approach, v.squaredNorm() + x.dot(a), v.dot(a),
                     0.25 * a.squaredNorm()};
  return first_falling_root(f, horizon);
}

}  // namespace

double time_to_touch(const Vector3& x, const Vector3& v, const Vector3& a, double contact,
                     double horizon) {
  const double distance = x.norm();
  // The distance is at least its part along x, which settles most pairs.
  constexpr double kRounding = 1e-9;
  if (distance + least_on(x.dot(v), x.dot(a), horizon) / distance > (1 + kRounding) * contact)
    return kNever;
  if (distance <= kFar * contact) return touch_from_near(x, v, a, contact, horizon);
  const double t = time_to_near(x, v, a, kFar * contact, horizon);
  if (t == kNever) return kNever;
  return t + touch_from_near(x + t * (v + (0.5 * t) * a), v + t * a, a, contact, horizon - t);
}

}  // namespace slipcheck
