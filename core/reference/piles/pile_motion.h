#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/flatten.h"
#include "reference/near_pairs.h"
#include "reference/piles/pile_loop.h"

namespace slipcheck {

/// How fast bodies are at most, as squares [m²/s²].
struct PileSpeed {
  double still = 0;   ///< against what stands still
  double adrift = 0;  ///< against the drift
  double gain = 0;    ///< by the step
};

/// Moves bodies, by their places, and their spheres by a step. Returns how fast they are then.
/// drift: what velocities are measured against [m/s].
SLIPCHECK_FLATTEN inline PileSpeed move_bodies(PileWorld& world,
                                               std::span<const std::uint32_t> places,
                                               std::span<NearSphere> spheres,
                                               const Vector3& drift) {
  constexpr std::size_t kAhead = 16;
  const double h = world.step, kick = world.started ? h : 0.5 * h;
  const double drag = 0.5 * h * world.drag, keep = (1 - drag) / (1 + drag);
  PileSpeed fastest;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::uint32_t place = places[k];
    PileBody& b = world.bodies[place];
    prefetch(world.bodies[places[std::min(k + kAhead, places.size() - 1)]]);
    const Vector3 gain = b.force / b.mass + b.load * world.gravity, turn = b.torque / b.inertia;
    b.change = h * gain;
    b.turn_change = h * turn;
    b.velocity += kick * gain;
    b.angular_velocity += kick * turn;
    if (drag > 0) [[unlikely]] {
      b.velocity *= keep;
      b.angular_velocity *= keep;
    }
    // Summed with what rounding took before: else a slow body stands while its springs stretch.
    const Vector3 way = h * b.velocity + b.rounded, next = b.position + way;
    b.rounded = way - (next - b.position);
    b.position = next;
    spheres[place].position = next;
    b.turned += h * b.angular_velocity;
    b.force.setZero();
    b.torque.setZero();
    fastest.still = std::max(fastest.still, b.velocity.squaredNorm());
    fastest.adrift = std::max(fastest.adrift, (b.velocity - drift).squaredNorm());
    fastest.gain = std::max(fastest.gain, b.change.squaredNorm());
  }
  return fastest;
}

}  // namespace slipcheck
