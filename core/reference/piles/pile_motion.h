#pragma once

#include <cstdint>
#include <span>

#include "reference/near_pairs.h"
#include "reference/piles/pile_loop.h"

namespace slipcheck {

/// How fast bodies are at most, as squares [m²/s²].
struct PileSpeed {
  double still = 0;   ///< against what stands still
  double adrift = 0;  ///< against the drift
  double gain = 0;    ///< by the step
};

/// Moves bodies, by their places, and their spheres by a step; the next one begins without forces.
/// Returns how fast they are then. drift: what velocities are measured against [m/s].
PileSpeed move_bodies(PileWorld& world, std::span<const std::uint32_t> places,
                      std::span<NearSphere> spheres, const Vector3& drift);

}  // namespace slipcheck
