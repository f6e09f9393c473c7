#pragma once

#include <atomic>
#include <vector>

#include "engine/worker_process.h"
#include "harness/compare/record.h"

namespace slipcheck {

/// The runs that these scenes ask for in compare, each engine at each of its rates and scales, with
/// the settings that their profiles choose, and these `settings` over them. `general`: engines that
/// have the setting `leaves_out` are to leave out nothing. `whole`: as of RunOptions, so that any
/// number of bodies may go to an engine. One of a grid whose profile its engine
/// has not is skipped with that reason; a profile that no engine of the grid has is a fault.
///
/// A path of a profile is taken from the scene's own folder. Throws BadScenario with all that is
/// wrong: engines and profiles that are unknown, files that cannot be read, profiles that are
/// faulty or choose what the engine does not take, settings that one of the engines does not take.
/// Asks engines what they take; `stop` as of RemoteEngine.
std::vector<std::vector<EngineRecord>> requested_runs(const std::vector<Scenario>& scenarios,
                                                      const WorkerLimits& limits = {},
                                                      const std::atomic<bool>* stop = nullptr,
                                                      const Settings& settings = {},
                                                      bool general = false, bool whole = false);

/// Notes in how many headings a record's phases are run, with a warning where the scene has
/// directions of its own.
void choose_headings(const Scenario& scenario, EngineRecord& record);

}  // namespace slipcheck
