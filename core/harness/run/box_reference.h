#pragma once

#include <map>
#include <string>

#include "harness/observe/box_observer.h"
#include "harness/run/reference_run.h"
#include "reference/reference_solver.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// How a scenario wants its box to be looked at.
BoxSampling box_sampling(const Scenario& scenario);

/// The averages by the names of their observables, but for those that have no sample.
std::map<std::string, BlockedMean> box_means(const BoxObservables& seen);

/// Solves a scene in a box. The values are averages over the samples; their uncertainty is that of
/// the average over so long a run, half the interval that holds the true mean with 95 %
/// (BlockedMean). A series that is too short for an error makes it infinite.
ReferenceResult run_box_reference(const ReferenceSolver& solver, const Scenario& scenario);

}  // namespace slipcheck
