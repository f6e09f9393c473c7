#pragma once

#include "engine/remote_engine.h"
#include "harness/compare/record.h"
#include "harness/observe/box_observer.h"
#include "reference/box_solver.h"

namespace slipcheck {

/// How a scenario wants its box to be looked at.
BoxSampling box_sampling(const Scenario& scenario);

/// Solves a scene in a box. The values are averages over the samples; their uncertainty is that of
/// the average over so long a run, half the interval that holds the true mean with 95 %
/// (BlockedMean). A series that is too short for an error makes it infinite.
ReferenceResult run_box_reference(const BoxSolver& solver, const Scenario& scenario);

/// What an ensemble of one engine's runs in a box needs to know.
struct BoxEnsembleTask {
  const BoxSolver* solver = nullptr;
  const ReferenceResult* reference = nullptr;
  const Scenario* scenario = nullptr;
  std::size_t phases = 32;  ///< >= 1
};

/// Runs one engine's ensemble on a scene in a box and fills in `record`. The runs differ in where
/// in the floor's period the first step falls: each starts from the reference's state a part of a
/// step later. Throws what RemoteEngine throws.
void run_box_ensemble(RemoteEngine& engine, const BoxEnsembleTask& task, EngineRecord& record);

}  // namespace slipcheck
