#pragma once

#include <cstddef>
#include <vector>

#include "scene/contact_scene.h"

namespace slipcheck {

/// The shortest collision [s] of two of the scene's bodies along the line of centres, at the
/// scene's speed; infinite where none have a contact that lasts, or nothing moves.
double shortest_collision(const ContactScene& scene);

/// The same of a body and a surface.
double shortest_at_surfaces(const ContactScene& scene);

/// By row of `scene.pairs`, its two lightest bodies, or as many as there are: those that oscillate
/// and collide fastest.
std::vector<std::vector<std::size_t>> lightest_two(const Scene& scene);

}  // namespace slipcheck
