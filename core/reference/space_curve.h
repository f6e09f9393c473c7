#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/vector.h"

namespace slipcheck {

/// The image of a place in the first period of a plane that repeats itself; 0: it does not.
inline Vector3 in_period(const Vector3& position, const Vector2& periodic) {
  Vector3 folded = position;
  for (int k = 0; k < 2; ++k)
    if (periodic[k] > 0) folded[k] -= periodic[k] * std::floor(position[k] / periodic[k]);
  return folded;
}

/// The lowest 21 bits, with two places between each two of them.
inline std::uint64_t spread_bits(std::uint64_t bits) {
  bits &= 0x1fffff;
  bits = (bits | bits << 32) & 0x1f00000000ffff;
  bits = (bits | bits << 16) & 0x1f0000ff0000ff;
  bits = (bits | bits << 8) & 0x100f00f00f00f00f;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
  return (bits | bits << 2) & 0x1249249249249249;
}

/// Where bodies come on a curve through cells of space, G. M. Morton's: sorted by it, those that
/// are near each other are stored near each other. positions: finite, at least one; width: of the
/// cells [m], > 0; they are wider where there would be more than 2^21 in a direction.
template <class Bodies>
std::vector<std::uint64_t> on_space_curve(const Bodies& bodies, const Vector2& periodic,
                                          double width) {
  Vector3 low = in_period(bodies[0].position, periodic), high = low;
  for (const auto& body : bodies) {
    const Vector3 at = in_period(body.position, periodic);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  constexpr double kCells = 1 << 21;
  width = std::max(width, (high - low).maxCoeff() / (kCells - 1));
  std::vector<std::uint64_t> keys;
  keys.reserve(bodies.size());
  for (const auto& body : bodies) {
    const Vector3 cell = (in_period(body.position, periodic) - low) / width;
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k) key |= spread_bits(static_cast<std::uint64_t>(cell[k])) << (2 - k);
    keys.push_back(key);
  }
  return keys;
}

}  // namespace slipcheck
