#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/by_name.h"
#include "harness/observe/assembly_observer.h"
#include "harness/observe/box_observer.h"
#include "harness/observe/motion.h"
#include "harness/observe/natural_scales.h"
#include "harness/run/reference_keeper.h"
#include "reference/reference_solver.h"
#include "scenario/scenario.h"
#include "scene/scene.h"

namespace slipcheck {

/// What else is wanted of a reference, where its solver keeps_state(); a warning says where it
/// cannot be had.
struct ReferenceExtras {
  std::optional<Checkpoints> checkpoints = {};  ///< how it is kept on its way
  /// Of what many bodies show as a whole (AssemblyObserver), >= 2; 0: none.
  std::size_t samples = 0;
  /// Nothing but the samples: one run, no observables of bodies and pairs.
  bool whole = false;
  bool left_out = false;                 ///< engines run alone
  AssemblyObserver::States states = {};  ///< takes each sample's states
  /// Called when the run has the bodies: as of ReferenceSolver::run().
  std::function<void()> started = {};
  /// Writes or reads what `states` goes on with.
  std::function<void(StateArchive&)> exchange_states = {};
};

struct UncertainValue {
  double value = 0;
  double uncertainty = 0;  ///< >= 0, in the value's unit
};

/// How the averages over a box came about.
struct BoxReference {
  std::size_t samples = 0;    ///< that they are taken over
  std::size_t discarded = 0;  ///< periods before the first of them
  bool steady = false;        ///< H, K and R show no trend over them
  BoxSeries series;           ///< all samples after `run.discard`
};

/// What the reference says of a scene.
struct ReferenceResult {
  std::string solver = "event";  ///< or "contact"
  double cpu_seconds = 0;        ///< of the one run that the values come from
  ByName<UncertainValue> observables;
  ByName<double> closed_form;  ///< where one applies
  SolvedRun run;
  double first_contact = 0;         ///< time of the first collision or landing [s], maybe infinite
  NaturalScales scales;             ///< of the scene; none of one in a box
  std::optional<BoxReference> box;  ///< of a scene in a box
  std::optional<RecordedMotion> motion;  ///< where it is recorded
  std::optional<Assembly> assembly;      ///< where it was asked for
  bool left_out = false;                 ///< engines ran alone, nothing here is known
  std::vector<std::string> warnings;
};

/// Solves a scene. Where phases are exact the uncertainty is the spread over runs under all three
/// rounding modes, in which also the cut-offs for vanishing rebounds differ by half; where they are
/// integrated it is the difference to a run at ten times the tolerance with other cut-offs. It is
/// never less than two units in the last place. What depends on rounding (a rack of balls struck at
/// once) shows.
ReferenceResult run_reference(const ReferenceSolver& solver, const RunEnd& end,
                              const std::vector<std::string>& body_names,
                              const ReferenceExtras& extras = {});

/// Why a scene cannot be looked at as a whole alone, "" where it can: two of its bodies have a hard
/// contact, of which their states tell no force, or the reference, unless it is left out, has no
/// steps to show them at.
std::string no_whole_reason(const ReferenceSolver& solver, const ReferenceExtras& extras);
/// The same of a scene that can, of which the samples alone are wanted, or where it is left out
/// nothing.
ReferenceResult run_reference_whole(const ReferenceSolver& solver, const RunEnd& end,
                                    const ReferenceExtras& extras);

/// What computed a NaN has no result: the run has failed, its reason names what is NaN, and nothing
/// else of it is shown. Does nothing where `names` is empty.
void fail_because_of_nan(const std::vector<std::string>& names, ReferenceResult& result);

RunEnd run_end(const Scenario& scenario);
/// Names of the bodies, and after them those of the surfaces.
std::vector<std::string> body_names(const Scenario& scenario);

}  // namespace slipcheck
