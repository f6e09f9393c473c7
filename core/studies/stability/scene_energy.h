#pragma once

#include <span>

#include "physics/sphere.h"
#include "scene/scene.h"

namespace slipcheck {

/// Energy of translation and rotation in the laboratory [J].
double kinetic_energy(const Scene& scene, std::span<const BodyState> states);

/// Energy of gravity [J], 0 where all bodies lie on the plane at their first places: m g (z − R),
/// and on a tilted plane −m a·(x − x_0), a the downhill acceleration.
double potential_energy(const Scene& scene, std::span<const BodyState> states);

/// Between what limits [J] the energy of a state that an engine shows lies.
struct EnergyRange {
  double low = 0, high = 0;
};

/// Kinetic energy and that of gravity of a state after a step of length `step` [s], >= 0, as far as
/// the state tells them.
///
/// Engines step positions and velocities one after the other, so that what they show of both may
/// belong to instants h/2 apart: in free flight x' = x + h v' makes E − (h/2) m g·v constant, with
/// v' = v + h g, and E itself ripple by that term though nothing is gained. Hence
/// ±(h/2) Σ m |g·v|. A body within `slack` [m], >= 0, of the height at which it lies on the plane
/// may be anywhere in there: what an engine leaves open between bodies that touch is no energy.
EnergyRange shown_energy(const Scene& scene, std::span<const BodyState> states, double step,
                         std::span<const double> slack);

}  // namespace slipcheck
