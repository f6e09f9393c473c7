#pragma once

#include "studies/sweep/sweep_plan.h"

namespace slipcheck {

/// What a name of the sweep means; a scene's path is left to scene_path().
SweepParameter named_parameter(const SweepName& name);

/// Puts a value into the choice; false after noting what is wrong with it at the present path.
/// Not for a scene's.
bool choose(const SweepParameter& parameter, const YamlNode& value, Reading& reading,
            SweepChoice& choice);

}  // namespace slipcheck
