#pragma once

#include <string>
#include <vector>

#include "harness/run/prepared_scene.h"
#include "harness/run/scene_run.h"
#include "studies/tuning/tuning_evaluator.h"

namespace slipcheck {

/// Every scene at every rate, for tuning; the first `training` scenes are trained on, the others
/// are held out.
std::vector<TuningTask> tuning_tasks(const std::vector<PreparedScene>& scenes, std::size_t training,
                                     const std::vector<double>& rates);

/// Runs tasks in an engine's worker processes. `options` without its phases; the scenes outlive the
/// function, and options.stop interrupts it.
TuningRuns engine_tuning_runs(const std::vector<PreparedScene>& scenes, const std::string& engine,
                              const std::string& precision, const TuningObservables& observables,
                              RunOptions options);

/// Names in `observables` that no scene's reference has, and scenes of which nothing counts: what
/// is to be said about them, "" if nothing.
std::string nothing_to_tune(const std::vector<PreparedScene>& scenes,
                            const TuningObservables& observables);

}  // namespace slipcheck
