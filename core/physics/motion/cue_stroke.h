#pragma once

#include "physics/sphere.h"
#include "physics/vector.h"

namespace slipcheck {

/// A cue that strikes a ball: an impulse along the line of the cue, which meets the ball's surface
/// where the tip is. What follows from the ball's and the cue's rigidity alone:
///
/// With the heading h in the plane and the elevation θ the cue moves along
///   d = h cos θ − k̂ sin θ;   s = h × k̂ points to its right,   w = s × d upwards across it.
/// The tip is at r = a s + b w − √(R² − a² − b²) d from the centre, and an impulse J gives
///   Δv = (J/m) d,   ΔΩ = r × J d/I = (J/I) (a w − b s).
/// A cue of mass M that comes at V and parts with the restitution e along d gives
///   J = (1 + e) V/(1/M + 1/m + (a² + b²)/I):
/// for e = 1 Alciatore's TP A.30, and Leckie and Greenspan's, whose b and c are the tip's vertical
/// and horizontal distance from the centre: the b here is their b cos θ − c sin θ.
///
/// Left out are the squirt, as a cue has no mass that moves sideways, the substrate's part while
/// the tip touches, and the slip of the tip: it holds up to largest_offset().
struct CueStroke {
  Vector2 heading = Vector2::UnitX();  ///< h, a unit vector
  double elevation = 0;                ///< θ [rad], in [0, π/2)
  double right = 0, up = 0;            ///< a, b [m], a² + b² < R²

  Vector3 direction() const;  ///< d
  /// Of a cue at `speed` V [m/s] with `mass` M [kg] and `restitution` e [-], in [0, 1] [N s].
  double impulse(const Sphere& ball, double speed, double mass, double restitution) const;
  /// What an impulse J [N s] adds to the ball's motion.
  void strike(const Sphere& ball, double impulse, BodyState& state) const;
};

/// √(a² + b²)/R up to which a tip with this friction on the ball [-], >= 0, does not slip: the
/// impulse's angle to the surface's normal has the sine √(a² + b²)/R and at most the tangent μ,
///   μ/√(1 + μ²), 0.514 for a chalked tip with μ = 0.6.
double largest_offset(double tip_friction);

}  // namespace slipcheck
