#pragma once

#include "scene/contact_scene.h"

namespace slipcheck {

/// The shortest collision [s] of two of the scene's bodies along the line of centres, at the
/// scene's speed; infinite where none have a contact that lasts, or nothing moves.
double shortest_collision(const ContactScene& scene);

}  // namespace slipcheck
