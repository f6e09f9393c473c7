#pragma once

#include <optional>
#include <span>

#include "scene/scene.h"

namespace slipcheck::bullet {

/// The horizontal direction, of length 1, of the vertical plane that holds the centres of all
/// bodies in these states, their velocities, the tilt and the substrate's motion, with all spins
/// normal to it: by symmetry nothing leaves it. Nothing where there is no such plane, to within
/// rounding. Along y where several do.
std::optional<Vector2> line_of_motion(const Scene& scene, std::span<const BodyState> states);

}  // namespace slipcheck::bullet
