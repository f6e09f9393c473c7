#pragma once

#include "scenario/scenario.h"

namespace slipcheck {

// The same scene with something changed. Expectations of engines are dropped: they are of the scene
// as it was.

/// The second body's mass times q, > 0, its radius as before. The scene has two bodies or more.
Scenario with_mass_ratio(Scenario scenario, double q);

/// The first two bodies approach each other at `speed` [m/s], > 0: all velocities and spins and
/// the distances between centres change in proportion, gaps between surfaces likewise, so that
/// the two meet at the time at which they did. Bodies on a level, still substrate, along a line.
Scenario with_speed(Scenario scenario, double speed);

/// The restitution of all contacts of two bodies that are hard with a constant one, in [0, 1], or
/// linear, in (0, 1].
Scenario with_restitution(Scenario scenario, double restitution);

/// The stiffness [N/m], > 0, of all linear contacts, in place of a collision time; restitution or
/// damping rate stay.
Scenario with_stiffness(Scenario scenario, double stiffness);

}  // namespace slipcheck
