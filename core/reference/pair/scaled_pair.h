#pragma once

#include <cstddef>

namespace slipcheck {

/// What of the laws of a batch is chosen outside the loop. Hertz' force is the viscoelastic one
/// without its damping.
enum class BatchNormal { linear, hertz, viscoelastic, compact };
enum class BatchTangential { none, viscous, printed, passive };

/// What all collisions of a batch have in common, in the units of scaled_impact.h.
struct BatchLaw {
  BatchNormal normal = BatchNormal::linear;
  BatchTangential tangential = BatchTangential::none;
  bool by_force = false;  ///< ContactEnd::zero_force
  double friction = 0;    ///< ν_s/κ or μ/κ [-]
  double step = 0;        ///< h [T]
  std::size_t limit = 0;  ///< steps after which the spheres count as staying together
};

/// One collision of the batch. Slip velocities are in g^N.
struct ScaledPair {
  double damping = 0;  ///< D of scaled_impact.h
  double slip = 0;     ///< g^T/g^N
  /// viscous: h c/(κ m_eff), how much of a slip one step takes; asperity: h L/ζ0, how many of them
  /// break in one step at a slip of g^N.
  double surface = 0;
};

/// How it ended.
struct ScaledPairEnd {
  double rate = 0;   ///< dx/dt, −ε^N
  double slip = 0;   ///< ε^T g^T/g^N
  double steps = 0;  ///< h; infinite if the spheres stay
};

}  // namespace slipcheck
