#pragma once

#include <string>

#include "physics/frame.h"

namespace slipcheck {

/// A body this many times faster than the scene can make it has been blown off.
inline constexpr double kExploded = 1e3;

/// Why no comparison can be made with the state that an engine shows at `time` [s]: it is not
/// finite, or a body moves more than `times` times faster than `fastest` [m/s], what the scene can
/// make it. Empty for a good one.
std::string fault_of_state(const Frame& frame, double time, double fastest,
                           double times = kExploded);

}  // namespace slipcheck
