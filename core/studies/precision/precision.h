#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "harness/observe/observables.h"
#include "harness/run/engine_grid.h"
#include "harness/run/reference_run.h"
#include "harness/run/scene_run.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// How far the runs of an ensemble are off in one quantity: statistics of the absolute deviations
/// over the phases, relative or absolute as in Deviation. NaN with a reason where undefined.
struct PhaseErrors {
  double worst = kNotObserved, median = kNotObserved;
  double rms = kNotObserved;  ///< root of the mean square
  bool absolute = false;
  std::optional<double> tolerance;  ///< the scene's
  std::string reason;
};

/// The trajectory among the quantities: in a run the largest distance of a body's centre from where
/// the reference has it at that time, over the length of the longest path of a body there (absolute
/// [m] where nothing moves).
inline constexpr const char* kTrajectory = "trajectory";

/// CPU time with nothing looked at in between.
struct WorkCost {
  double per_step = 0;              ///< [s], the least of the repeats
  double per_simulated_second = 0;  ///< [-], likewise
  double spread = 0;                ///< of the repeats: (median − least)/least [-]
  std::size_t repeats = 0;
};

/// A method at one setting of its knob: a point of a work-precision diagram.
struct WorkPrecision {
  double knob = 0;  ///< as MethodCurve::Kind says; 0 where there is none
  RunStatus status = RunStatus::skipped;
  std::string reason;  ///< why not ok, or why there is no cost
  std::size_t phases = 0;
  std::map<std::string, PhaseErrors> errors;  ///< by observable, "i.sliding_time", and kTrajectory
  std::optional<WorkCost> cost;
  /// The quantities in which no other point of the scene is cheaper and no worse: engines among
  /// themselves, and the reference's solvers, which would leave them nothing.
  std::set<std::string> pareto;
};

/// How a quantity's worst error falls along a curve.
struct Convergence {
  enum class Kind {
    exact,              ///< at every point at most what rounding leaves or what does not matter
    converges,          ///< falls with the order, to rounding or to the end of the curve
    does_not_converge,  ///< stops falling, or grows
    unknown,            ///< too few points tell
  };
  Kind kind = Kind::unknown;
  double order = kNotObserved;        ///< p of error ∝ h^p (of a tolerance: ∝ tolerance^p)
  double order_error = kNotObserved;  ///< its standard error
  double coarsest = kNotObserved;     ///< worst error at the first point that has one
  double finest = kNotObserved;       ///< and at the last
  double largest = kNotObserved;      ///< of all worst errors
};
template <>
inline constexpr std::array kNamesOf<Convergence::Kind> = {"exact", "converges",
                                                           "does_not_converge", "unknown"};

/// A method over its knob.
struct MethodCurve {
  enum class Kind {
    engine,      ///< knob: rate [Hz]
    contact,     ///< the reference's integrator; knob: relative tolerance [-]
    fixed_step,  ///< the reference's steps of fixed length; knob: step [s]
    event,       ///< the reference's events: a point
  };
  Kind kind = Kind::engine;
  std::string engine, version, precision, profile;  ///< of an engine
  std::optional<double> iterations;   ///< of its solver, where they are not the profile's own
  Settings settings;                  ///< that the profile chooses, and the iterations
  std::vector<WorkPrecision> points;  ///< from coarse to fine
  std::map<std::string, Convergence> convergence;  ///< by quantity
};
template <>
inline constexpr std::array kNamesOf<MethodCurve::Kind> = {"engine", "contact", "fixed_step",
                                                           "event"};

/// "bullet double tuned, 50 iterations", "contact".
std::string label_of(const MethodCurve& curve);
/// In words: "order 1.00 ± 0.02", "does not converge".
std::string words_of(const Convergence& convergence);

/// A scene with all methods.
struct PrecisionScene {
  Scenario scenario;
  ReferenceResult reference;
  double simulated = 0;    ///< end of the reference's run [s]
  double path_length = 0;  ///< that the trajectory's error is relative to [m]; 0: absolute
  std::vector<MethodCurve> curves;
};

/// What is tried on every scene.
struct PrecisionGrid {
  EngineGrid engines;
  std::vector<double> rates = {60, 240, 1000, 4000, 16000};  ///< [Hz], > 0, rising
  /// Of the engine's solver, beside the profile's own; engines without the setting
  /// `solver_iterations` have their own only.
  std::vector<double> iterations = {2, 50};
  /// At higher rates [Hz] the profile's own alone: steps there cost most, nine tenths of the grid
  /// with all its rates, and what iterations change shows where steps are long.
  double iterations_up_to = 1000;
  std::vector<double> tolerances = {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
  /// Steps in the shortest contact of the scene; of fixed_step.
  std::vector<double> steps_per_contact = {5, 10, 20, 50, 100, 200, 500, 1000};
  std::size_t repeats = 5;  ///< of each timing, >= 1
};

/// Runs all methods on these scenes. Errors come from ensembles at work in parallel; times from
/// runs of their own afterwards, one at a time on one core, the methods in turn and that `repeats`
/// times.
///
/// Before anything runs, throws BadScenario for scenes in a box and for what run_scenes throws for,
/// Unsupported where no solver knows a model. Interrupted runs have status `skipped`.
std::vector<PrecisionScene> run_precision(std::vector<Scenario> scenarios,
                                          const PrecisionGrid& grid, const RunOptions& options);

}  // namespace slipcheck
