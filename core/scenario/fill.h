#pragma once

#include <vector>

#include "scenario/reading.h"
#include "scenario/written_scene.h"

namespace slipcheck {

/// Bodies at random places without overlap: each is put at random again and again until it is free
/// of all before it and of `others` (random sequential addition). The same seed gives the same
/// bodies on every machine. Masses and spins are left to the caller. Notes a fault where they do
/// not fit.
std::vector<Body> expand(const Fill& fill, const WrittenScene& scene,
                         const std::vector<Body>& others, Reading& reading);

}  // namespace slipcheck
