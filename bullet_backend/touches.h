#pragma once

#include <vector>

#include "physics/frame.h"

class btCollisionDispatcher;

namespace slipcheck::bullet {

/// The pairs that exchanged a normal impulse in Bullet's last step, in Bullet's units, sorted by
/// pair. Walls and lid of a box are left out.
void find_touches(btCollisionDispatcher& dispatcher, std::vector<Touch>& touches);

}  // namespace slipcheck::bullet
