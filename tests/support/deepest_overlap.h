#pragma once

#include <cmath>
#include <vector>

#include "extremes.h"
#include "physics/numbers.h"
#include "scene/scene.h"

namespace slipcheck::test {

/// The deepest overlap of two bodies over the sum of their radii, over the nearest images; negative
/// where all are apart.
inline double deepest_overlap(const Scene& scene, const std::vector<BodyState>& states) {
  double deepest = -kNever;
  for (std::size_t i = 0; i < states.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      Vector3 dx = states[i].position - states[j].position;
      for (int axis : {0, 1})
        if (const double L = scene.periodic[axis]; L > 0)
          dx[axis] -= L * std::nearbyint(dx[axis] / L);
      deepest =
          largest_of(deepest, 1 - dx.norm() / (scene.bodies[i].radius + scene.bodies[j].radius));
    }
  return deepest;
}

}  // namespace slipcheck::test
