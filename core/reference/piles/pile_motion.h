#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "base/flatten.h"
#include "reference/near_pairs.h"
#include "reference/piles/pile_loop.h"
#include "reference/steps/step_solver.h"

namespace slipcheck {

/// Moves all bodies by a step, in shares for the threads of a team.
class PileMover {
 public:
  /// Returns the largest speed [m/s]. spheres: of the bodies, which are moved with them.
  double move(PileWorld& world, std::span<NearSphere> spheres) {
    const std::size_t n = world.bodies.size(), shares = (n + kShare - 1) / kShare;
    fastest_.assign(shares, 0);
    const auto move_share = [&](std::size_t k) {
      const std::size_t first = k * kShare, count = std::min(kShare, n - first);
      fastest_[k] = move_bodies(world, std::span(world.bodies).subspan(first, count),
                                spheres.subspan(first, count));
    };
    if (world.team && shares > 1)
      world.team->run(shares, move_share);
    else
      for (std::size_t k = 0; k < shares; ++k) move_share(k);
    return std::sqrt(*std::ranges::max_element(fastest_));
  }

 private:
  /// Bodies that one thread moves in a row.
  static constexpr std::size_t kShare = 1024;

  /// Returns the largest square of a speed [m²/s²].
  SLIPCHECK_FLATTEN static double move_bodies(const PileWorld& world, std::span<PileBody> bodies,
                                              std::span<NearSphere> spheres) {
    const double h = world.step, kick = world.started ? h : 0.5 * h;
    const double drag = 0.5 * h * world.drag, keep = (1 - drag) / (1 + drag);
    double fastest = 0;
    auto sphere = spheres.begin();
    for (PileBody& b : bodies) {
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
      (sphere++)->position = next;
      b.turned += h * b.angular_velocity;
      b.force.setZero();
      b.torque.setZero();
      fastest = std::max(fastest, b.velocity.squaredNorm());
    }
    return fastest;
  }

  std::vector<double> fastest_;
};

}  // namespace slipcheck
