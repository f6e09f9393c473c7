#pragma once

#include <vector>

#include "scenario/reading.h"
#include "scenario/written_scene.h"

namespace slipcheck {

/// Bodies without overlap of each other or of `others`. At random each is put somewhere again and
/// again until it is free (random sequential addition, which ends at a share of 0.547 of the area,
/// Feder 1980); on a lattice each takes the next free site of the widest triangular one that has
/// enough. Velocities are random either way. The same seed gives the same bodies on every machine.
/// Masses and spins are left to the caller. Notes a fault where they do not fit.
std::vector<Body> expand(const Fill& fill, const WrittenScene& scene,
                         const std::vector<Body>& others, Reading& reading);

}  // namespace slipcheck
