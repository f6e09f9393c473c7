#pragma once

#include "scene/scaled_impact.h"

namespace slipcheck {

/// One collision of two spheres along the line of centres without any other force, from ξ = 0 and
/// ξ̇ = speed: m_eff ξ̈ = −F_N. reduced_mass m_eff [kg] and speed [m/s] > 0; the relative tolerance
/// is in [1e-13, 1e-3]. Laws whose spheres never part give restitution 0 and an infinite duration.
Impact impact(const NormalForce& force, double reduced_mass, double speed, ContactEnd end,
              double tolerance = 1e-12);

/// The force with its dissipative coefficient (c, η, A) set so that a collision at that speed has
/// that restitution, in (0, 1]. Throws std::domain_error, which says the reachable range at that
/// speed, where there is none: for HertzForce all but 1.
NormalForce with_restitution(const NormalForce& force, double reduced_mass, double restitution,
                             double speed, ContactEnd end);

}  // namespace slipcheck
