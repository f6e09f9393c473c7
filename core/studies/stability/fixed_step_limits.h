#pragma once

#include <vector>

#include "studies/stability/limits.h"

namespace slipcheck {

/// The limits of the reference's fixed-step solver: of a linear contact that stays closed, for
/// several damping ratios, beside the derived step_limit(); and of a collision in the soft pair, by
/// restitution and duration and by restitution alone.
std::vector<Limit> fixed_step_limits(const LimitGrid& grid, const RunOptions& options);

}  // namespace slipcheck
