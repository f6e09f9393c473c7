#pragma once

#include <map>
#include <string>

#include "harness/observe/observables.h"
#include "harness/run/reference_run.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// One run's observables held against the scene's tolerances.
struct PhaseComparison {
  bool within = true;                 ///< every observable with a tolerance is
  double worst_error = kNotObserved;  ///< in tolerances; NaN where none could be taken
  std::string worst_observable;
  std::string why;  ///< why not within
};

/// `shown`: the run's observables by their full names (named_values()), what it does not show is
/// missing or NaN. Errors as in Deviation.
PhaseComparison compare_phase(const Scenario& scenario, const ReferenceResult& reference,
                              const std::map<std::string, double>& shown);

}  // namespace slipcheck
