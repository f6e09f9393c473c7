#pragma once

#include <string>

#include "physics/frame.h"

namespace slipcheck {

/// Why no comparison can be made with the state that an engine shows at `time` [s]: it is not
/// finite, or a body moves a thousand times faster than `fastest` [m/s], what the scene can make
/// it. Empty for a good one.
std::string fault_of_state(const Frame& frame, double time, double fastest);

}  // namespace slipcheck
