#pragma once

#include <vector>

#include "physics/frame.h"

class btCollisionDispatcher;

namespace slipcheck::bullet {

/// The pairs that exchanged a normal impulse in Bullet's last step, in Bullet's units, sorted by
/// pair. Walls and lid of a box are left out, which have the numbers of surfaces where there is
/// none.
void find_touches(btCollisionDispatcher& dispatcher, bool in_box, std::vector<Touch>& touches);

}  // namespace slipcheck::bullet
