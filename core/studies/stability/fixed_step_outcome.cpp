#include "studies/stability/fixed_step_outcome.h"

#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "base/stop_scope.h"
#include "harness/compare/comparison.h"
#include "harness/observe/observer.h"
#include "harness/run/engine_state.h"
#include "harness/run/phases.h"
#include "reference/initial_contacts.h"
#include "reference/steps/step_solver.h"
#include "studies/stability/outcome_watch.h"
#include "studies/stability/phase_comparison.h"

namespace slipcheck {
namespace {

/// A run that no comparison can be made with.
struct Lost {
  std::string why;
};

/// Hands the frames of one run to the watch and to an observer.
class FixedStepRun final : public FrameSink {
 public:
  FixedStepRun(const ReferencePath& path, double start, OutcomeWatch& watch)
      : path_(path), start_(start), watch_(watch), observer_(observer_of(path)) {}

  void take(double time, const Frame& frame) override {
    const double now = start_ + time;
    if (began_)
      watch_.take(now, frame);
    else
      watch_.begin(now, frame.bodies);
    began_ = true;
    std::string fault = fault_of_state(frame, now, path_.fastest(now));
    if (!fault.empty()) throw Lost{std::move(fault)};
    observer_.take(now, frame);
  }

  Observables observables(double end) const { return observer_.finish(end); }

 private:
  /// As of the reference: contacts last over many frames and bodies stick exactly, so that nothing
  /// is to be allowed for that an engine's step leaves.
  static Observer observer_of(const ReferencePath& path) {
    return {path.scene().hard, 0, speed_scale(path.scene()), true};
  }

  const ReferencePath& path_;
  double start_;
  OutcomeWatch& watch_;
  Observer observer_;
  bool began_ = false;
};

}  // namespace

FixedStepOutcome fixed_step_outcome(const ReferencePath& path, double step, std::size_t phases,
                                    const OutcomeCriteria& criteria) {
  const PreparedScene& scene = path.prepared();
  const ReferenceSolver& solver = scene.solver;
  OutcomeWatch watch(path, criteria, step, true);
  std::vector<std::map<std::string, double>> seen;
  FixedStepOutcome result;
  std::string lost;
  try {
    for (const double start : phase_starts(scene.reference.first_contact, step, phases)) {
      FixedStepRun run(path, start, watch);
      StepSolver steps(path.scene(), solver.states_at(start), {step});
      const double end = path.end() - start;
      try {
        const SolvedRun done = steps.run(until_time(end), &run);
        if (done.failed) {
          result.why = done.reason;
          return result;
        }
        seen.push_back(
            named_values(run.observables(start + done.end_time), body_names(scene.scenario)));
      } catch (const Lost& run_lost) {
        lost = run_lost.why;
      }
    }
  } catch (const Interrupted&) {
    throw;
  } catch (const std::runtime_error& refused) {
    // Unsupported, or the reference cannot say where a phase begins.
    result.why = refused.what();
    return result;
  }
  if (lost.empty()) {
    result.errors = deviations(scene.scenario, scene.reference, ensemble_values(seen));
    result.outcome = Outcome::accurate;
    for (const auto& shown : seen) {
      PhaseComparison comparison = compare_phase(scene.scenario, scene.reference, shown);
      if (comparison.within) continue;
      result.outcome = Outcome::degraded;
      result.why = std::move(comparison.why);
      break;
    }
  } else {
    result.why = lost;
    result.outcome = Outcome::exploded;
  }
  for (const WatchedPhase& phase : watch.phases())
    if (phase.outcome.outcome > result.outcome) {
      result.outcome = phase.outcome.outcome;
      result.why = phase.outcome.why;
    }
  return result;
}

}  // namespace slipcheck
