#pragma once

#include <limits>

namespace slipcheck {

/// The time of what does not happen [s].
inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// The rounding of one operation, relative to its result: 2^-52.
inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

}  // namespace slipcheck
