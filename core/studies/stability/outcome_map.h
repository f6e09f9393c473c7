#pragma once

#include <optional>

#include "studies/stability/limit_trials.h"
#include "studies/stability/limits.h"

namespace slipcheck {

/// Two balls meet, in steps at 240 Hz, over the speed, 1 mm/s to 10 m/s, and the restitution.
/// Nothing where interrupted.
std::optional<OutcomeMap> speed_restitution_map(const EngineRecord& method, const LimitGrid& grid,
                                                VariedScenes& scenes, EnsembleTrials& trials);

/// Likewise over the step, 0.3 ms to 0.1 s, and the speed. Engines take a soft contact for a hard
/// one of its restitution, so that a map over stiffness would tell nothing of them.
std::optional<OutcomeMap> step_speed_map(const EngineRecord& method, const LimitGrid& grid,
                                         VariedScenes& scenes, EnsembleTrials& trials);

/// The reference's fixed-step solver on the soft pair over the step and the stiffness, with the
/// line of step_limit(); the restitution alone counts. Throws Interrupted.
OutcomeMap step_stiffness_map(const LimitGrid& grid, const RunOptions& options);

}  // namespace slipcheck
