#pragma once

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "harness/run/reference_run.h"
#include "reference/reference_solver.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// A scene with its solver and its reference, which engines are then held against as often as
/// wanted.
struct PreparedScene {
  Scenario scenario;
  std::unique_ptr<ContactScene> contact;  ///< the solver looks at it
  ReferenceSolver solver;
  ReferenceResult reference;
};

/// Solves these scenes, as many at once as there are threads (0: one for each core); how many
/// changes no bit. Throws Unsupported where no solver knows a model, or a scene is to
/// be looked at as a whole and cannot (no_whole_reason()), before any is run. general: as
/// of ReferenceSettings. time_limit: of wall time for each scene's reference, all its runs [s].
/// in_scene: threads that share one scene, as of ReferenceSettings.
///
/// A reference that throws, is interrupted or runs out of time has failed, with the reason in its
/// run; it shows nothing, and the other scenes go on.
///
/// extras: null, or by the scenes' names what else is wanted, as of run_reference().
std::vector<PreparedScene> prepare_scenes(
    std::vector<Scenario> scenarios, bool general = false, std::size_t threads = 1,
    double time_limit = std::numeric_limits<double>::infinity(), std::size_t in_scene = 1,
    const std::map<std::string, ReferenceExtras>* extras = nullptr);

}  // namespace slipcheck
