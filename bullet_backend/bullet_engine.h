#pragma once

#include <memory>

#include "engine/engine.h"

namespace slipcheck::bullet {

/// Bullet 3 in the precision that this was compiled for: "single" or "double". What it takes stands
/// in settings.h. At most one at a time in a process, because some of Bullet's settings and its
/// rules for combining two bodies' coefficients are global.
std::unique_ptr<Engine> make_bullet_engine();

}  // namespace slipcheck::bullet
