#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "reference/near_pairs.h"

namespace slipcheck {

/// By looking at all.
inline std::vector<NearPair> all_near(const std::vector<NearSphere>& spheres, double skin,
                                      const Vector2& periodic) {
  std::vector<NearPair> found;
  for (std::uint32_t i = 0; i < spheres.size(); ++i)
    for (std::uint32_t j = i + 1; j < spheres.size(); ++j) {
      Vector3 apart = spheres[i].position - spheres[j].position;
      for (int k = 0; k < 2; ++k)
        if (periodic[k] > 0) apart[k] -= periodic[k] * std::round(apart[k] / periodic[k]);
      if (apart.norm() <= spheres[i].radius + spheres[j].radius + skin) found.push_back({i, j});
    }
  return found;
}

}  // namespace slipcheck
