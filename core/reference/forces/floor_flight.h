#pragma once

#include "physics/motion/shaken_floor.h"

namespace slipcheck {

/// When a parabola comes down on the shaken floor, counted from a time `start` [s]: the first t > 0
/// or = 0 at which the height gap(t) = y + v t − ½ g t² − A0 sin(ω (start + t)) is zero and falls,
/// or infinity where not until `horizon` [s]. y [m] is the height of the body's lowest point,
/// v [m/s] its speed upwards, g [m/s²] >= 0.
///
/// As |gap''| <= M = g + A0 ω², gap(t + τ) >= gap + gap' τ − ½ M τ²: a step to the first root of
/// that bound never passes a contact, and near one such steps converge like Newton's. The time
/// found lies before the contact by a rounding error at most, never after it and never in the past.
double floor_contact(const ShakenFloor& floor, double start, double y, double v, double g,
                     double horizon);

/// The same for a body under a lid at the height l + A0 sin(ω (start + t)): gap [m] is l minus the
/// height of the body's highest point.
double lid_contact(const ShakenFloor& lid, double start, double gap, double v, double g,
                   double horizon);

}  // namespace slipcheck
