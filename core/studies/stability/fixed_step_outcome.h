#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "harness/compare/record.h"
#include "studies/stability/outcome.h"
#include "studies/stability/reference_path.h"

namespace slipcheck {

/// How an ensemble of runs of the reference's fixed-step solver came out on a scene.
struct FixedStepOutcome {
  Outcome outcome = Outcome::refused;  ///< the worst of the phases
  std::string why;
  std::map<std::string, Deviation> errors;  ///< empty where a run was lost
};

/// Runs the scene of `path` in steps of `step` [s], > 0, from the starts that an engine's ensemble
/// of that many phases has, and classes it by the same criteria; soft contacts of a scene whose
/// substrate does not move. A scene that StepSolver does not take is refused.
FixedStepOutcome fixed_step_outcome(const ReferencePath& path, double step, std::size_t phases,
                                    const OutcomeCriteria& criteria);

}  // namespace slipcheck
