#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/remote_engine.h"
#include "harness/phase_watch.h"
#include "harness/record.h"

namespace slipcheck {

/// What an ensemble of one engine's runs needs to know.
struct EnsembleTask {
  const ReferenceSolver* solver = nullptr;
  const ReferenceResult* reference = nullptr;
  const Scenario* scenario = nullptr;
  std::size_t phases = 32;      ///< >= 1
  PhaseWatch* watch = nullptr;  ///< sees every frame too
};

/// Runs every phase of one engine at the rate of `record` and fills in its observables, errors and
/// costs. A state that is not finite, or that has left all bounds, makes the record `unstable`.
/// Throws what RemoteEngine throws.
void run_ensemble(RemoteEngine& engine, const EnsembleTask& task, EngineRecord& record);

}  // namespace slipcheck
