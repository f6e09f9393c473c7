#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/run/prepared_scene.h"
#include "studies/precision/precision.h"
#include "studies/precision/sampled_path.h"

namespace slipcheck {

/// Errors of the reference's own solvers on a scene on a substrate, without costs.
///
/// event: one point. Where the truth is exact it is that run itself, and its error is the
/// uncertainty; where contacts last it takes them as hard.
/// contact: CVODE over the tolerances; hard contacts stay instants.
/// fixed_step: steps of a fixed length, in an ensemble over the part of a step at which the first
/// contact falls; steps are shortened for that, by less than one in the way there.
std::vector<MethodCurve> reference_curves(const PreparedScene& scene, const TravelledPath& path,
                                          const PrecisionGrid& grid);

/// The scene's end, not waited for much longer than the reference took to it: a coarse run may
/// never come to rest.
RunEnd patient_end(const PreparedScene& scene);

/// The errors that an ensemble's record has, of a vector as a whole; of its components where they
/// have a tolerance.
std::map<std::string, PhaseErrors> phase_errors(const std::map<std::string, Deviation>& deviations);

}  // namespace slipcheck
