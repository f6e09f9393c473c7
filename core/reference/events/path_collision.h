#pragma once

#include "physics/vector.h"

namespace slipcheck {

/// In what time [s] two spheres on parabolas touch while they approach: the first t in [0, horizon]
/// at which |x + v t + ½ a t²| falls to `contact` [m], the sum of their radii, with x, v and a the
/// first's relative to the second's; or infinity.
double time_to_touch(const Vector3& x, const Vector3& v, const Vector3& a, double contact,
                     double horizon);

}  // namespace slipcheck
