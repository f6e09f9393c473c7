#pragma once

#include <string>
#include <vector>

#include "harness/compare/record.h"

namespace slipcheck {

/// A row for each scene, run and observable that the reference or the engine shows, or that a
/// tolerance asks for; all values SI. A run that is not ok has one row with its status and reason,
/// a scene without engines rows of the reference alone.
std::string results_csv(const std::vector<SceneRecord>& scenes);

/// A row for each phase of each run, of the observables that have a tolerance.
std::string phases_csv(const std::vector<SceneRecord>& scenes);

}  // namespace slipcheck
