#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "harness/run/engine_grid.h"
#include "harness/run/scene_run.h"
#include "scenario/scenario.h"
#include "studies/stability/outcome.h"

namespace slipcheck {

/// An engine under one profile at one rate in a case.
struct StabilityRun {
  EngineRecord record;                 ///< of its ensemble, as far as it came
  Outcome outcome = Outcome::refused;  ///< the worst of the phases
  std::string why;                     ///< of the first phase that came out so
  OutcomeCounts phases{};
  double worst_error = kNotObserved;  ///< in tolerances; NaN where none could be taken
  std::string worst_observable;
  double energy_gain = kNotObserved;  ///< largest, over the scene's energy [-]
  double creep = kNotObserved;        ///< largest, over the radius [-]
  double depth = kNotObserved;  ///< deepest overlap beyond the reference's, over the smaller radius
};

/// What the reference made of a case.
struct ReferenceOutcome {
  bool accurate = false;  ///< else refused or failed, as `why` says
  bool refused = false;   ///< before it ran
  std::string why;
  double worst_uncertainty = kNotObserved;  ///< in tolerances; NaN without tolerances
  double cpu_seconds = 0;
};

/// The reference is accurate where every tolerance is at least this many times the uncertainty of
/// its observable.
inline constexpr double kReferenceMargin = 10;

/// What the reference made of a scene on a substrate that it has run.
ReferenceOutcome reference_outcome(const PreparedScene& scene);

/// A stiff or extreme scene with all outcomes.
struct StabilityCase {
  Scenario scenario;
  ReferenceOutcome reference;
  std::vector<StabilityRun> runs;
};

/// What every case is run in.
struct StabilityGrid {
  EngineGrid engines;
  std::vector<double> rates;  ///< [Hz]; empty: those of the scene's compare.engines, or else 240
  OutcomeCriteria criteria;
};

/// One ensemble to be run and classed.
struct OutcomeTask {
  const PreparedScene* scene = nullptr;  ///< on a substrate
  EngineRecord record;  ///< says engine, precision, profile, settings and rate; or has a reason
};

/// Runs these ensembles and classes their outcomes, in the order of the tasks. What the reference
/// shows of a scene is found once for all tasks with it.
std::vector<StabilityRun> run_outcomes(std::span<const OutcomeTask> tasks,
                                       const OutcomeCriteria& criteria, const RunOptions& options);

/// Runs every case in the reference and in every engine of the grid, each ensemble in a worker of
/// its own kind; whatever one does, the others go on. Throws BadScenario for scenes in a box.
std::vector<StabilityCase> run_stability(std::vector<Scenario> cases, const StabilityGrid& grid,
                                         const RunOptions& options);

}  // namespace slipcheck
