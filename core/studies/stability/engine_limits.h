#pragma once

#include <span>
#include <vector>

#include "studies/stability/limit_trials.h"
#include "studies/stability/limits.h"

namespace slipcheck {

/// The limits of these methods, all searches in step, so that the trials of one round run together.
std::vector<Limit> engine_limits(std::span<const EngineRecord> methods, const LimitGrid& grid,
                                 VariedScenes& scenes, EnsembleTrials& trials);

}  // namespace slipcheck
