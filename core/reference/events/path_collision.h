#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/numbers.h"
#include "physics/safe_root.h"
#include "physics/vector.h"

namespace slipcheck {

/// A centre on its way.
struct PathPoint {
  Vector3 position, velocity;  ///< [m], [m/s]
};

/// In what time [s] two spheres on parabolas touch while they approach: the first t in [0, horizon]
/// at which |x + v t + ½ a t²| falls to `contact` [m], the sum of their radii, with x, v and a the
/// first's relative to the second's; or infinity.
double time_to_touch(const Vector3& x, const Vector3& v, const Vector3& a, double contact,
                     double horizon);

/// The same on any paths, whose relative acceleration is at most `bound` [m/s²], by steps that
/// never pass a contact: `apart(t)` is the pair of x and v. After many steps the search leaves the
/// rest for later: what it returns then is no contact, but a time before which there is none.
template <class Apart>
double stepping_time_to_touch(const Apart& apart, double bound, double contact, double horizon) {
  constexpr int kManySteps = 64;
  constexpr double kNear = 1e-8;  // of `contact`: nearer, the search goes on
  const double least = 8 * kEpsilon * contact;
  double t = 0;
  for (int n = 0; t <= horizon; ++n) {
    const auto [x, v] = apart(t);
    const double distance = x.norm(), gap = distance - contact;
    const double opening = x.dot(v) / distance;
    if (gap <= least && opening < 0) return t;
    const double step = step_to_bound(std::max(gap, least), opening, bound);
    if (step == kNever) return kNever;
    if (n >= kManySteps && gap > kNear * contact) return t;
    if (t + step == t) return opening < 0 ? t : kNever;
    t += step;
  }
  return kNever;
}

}  // namespace slipcheck
