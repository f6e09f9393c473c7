#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "physics/frame.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// When a run ends, and what of it is shown.
struct RunEnd {
  Run::Until until = Run::Until::rolling;
  double time = 0;   ///< [s], for Until::time
  double limit = 0;  ///< [s]: the run has failed if it comes to this first
  /// Of a solver in a box or a plane: between the states that it shows [s], > 0, and nothing else;
  /// 0: in a box the first and the last alone. Others show what their events need.
  double sample_interval = 0;

  /// No run goes on beyond this [s]: nothing later needs to be looked for.
  double last() const { return until == Run::Until::time ? time : limit; }
};

inline RunEnd until_time(double time, double sample_interval = 0) {
  return {Run::Until::time, time, time, sample_interval};
}

/// Kinetic and potential energy against what was dissipated and what moved from outside did.
struct EnergyBalance {
  double energy = 0;      ///< kinetic, of gravity, and elastic, now [J]
  double initial = 0;     ///< the same at the start [J]
  double dissipated = 0;  ///< by all contacts since then [J]
  double work = 0;        ///< done on the bodies by the substrate's or the walls' motion [J]
  double scale = 0;       ///< of the energies that took part [J]
  /// (energy − initial − work + dissipated)/scale.
  /// 0 where no energy took part; NaN where one is NaN.
  double error() const { return scale == 0 ? 0 : (energy - initial - work + dissipated) / scale; }
};

/// A run in numbers, whichever solver made it.
struct SolvedRun {
  double end_time = 0;                   ///< [s]
  bool reached = false;                  ///< what RunEnd::until asks for
  bool failed = false;                   ///< the integrator gave up
  bool lasting = false;                  ///< contacts last that are taken as instants
  std::string reason;                    ///< why not reached
  std::size_t events = 0;                ///< collisions, landings and changes of mode
  std::size_t collisions = 0;            ///< of two bodies
  std::size_t collapses = 0;             ///< of these, the ones that the rule for collapse changed
  std::size_t contacts = 0;              ///< with walls, floor and lid of a box
  std::size_t steps = 0;                 ///< of the integrator; 0 where phases are exact
  std::optional<EnergyBalance> balance;  ///< where the solver keeps one
  /// In a plane: of the sum over all bodies, relative to that of |m v| passed on [-]; NaN where it
  /// is not kept.
  double momentum_error = std::numeric_limits<double>::quiet_NaN();

  /// Tells why a run that is to come to rolling or rest is still going on at its limit.
  void stop_at_limit(Run::Until until) {
    reached = until == Run::Until::time;
    if (until == Run::Until::rolling)
      reason = "a body still slides or flies, or collides again, at the limit";
    else if (until == Run::Until::rest)
      reason = "a body still moves at the limit";
  }
};

/// Takes the bodies of one scene from their states on through time.
class Solver {
 public:
  virtual ~Solver() = default;

  /// Runs on from now and shows `sink`, where given, what happens. What the solver cannot go on
  /// with is in the result, no exception; but Unsupported for an end that it does not know, and
  /// Interrupted.
  virtual SolvedRun run(const RunEnd& end, FrameSink* sink) = 0;
  /// All bodies' states now.
  virtual std::vector<BodyState> states() const = 0;
  virtual double now() const = 0;  ///< [s]
  /// What its loop was made for, in a few words each: "phases on a level, still plane", ...
  virtual std::vector<std::string> features() const = 0;
};

/// One that looks ahead: when bodies will meet. What it tells ends where it looks.
class LookingSolver : public Solver {
 public:
  /// The time [s] at which the first two bodies touch or one lands, or infinity where that does not
  /// happen before `limit` [s]; the start, where two overlap.
  virtual double first_contact(double limit) = 0;
  /// The same for two bodies alone that meet at `slowest` [m/s] or faster.
  virtual double next_collision(double limit, double slowest) = 0;
};

}  // namespace slipcheck
