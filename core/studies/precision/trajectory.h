#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "harness/observe/phase_watch.h"
#include "reference/reference_solver.h"
#include "studies/precision/precision.h"

namespace slipcheck {

/// All bodies' centres at one instant [m].
using Centres = std::vector<Vector3>;

/// Where the reference has the centres at some ends of steps, the same ones in all runs of an
/// ensemble.
struct TrajectorySamples {
  std::vector<std::size_t> steps;             ///< since a run's start, rising, > 0
  std::vector<std::vector<Centres>> centres;  ///< [phase][sample][body]
  std::string reason;                         ///< why there are none
};

/// At most 32 ends of steps [s], evenly spread over the reference's run up to `end` [s] for runs
/// that begin at these times [s] in [0, step). A run with fewer steps has all of them, one at
/// least.
TrajectorySamples trajectory_samples(const ReferenceSolver& solver, double end, double step,
                                     std::span<const double> starts);

/// Evenly spread times of a run up to `end` [s], `count` of them, the last one `end`.
std::vector<double> sample_times(double end, std::size_t count);

/// The centres of these states.
Centres centres_of(std::span<const BodyState> states);

/// The longest path of a body [m] that stands at centres[k] at rising times and goes straight on
/// between them.
double longest_path(std::span<const Centres> centres);

/// The largest distance of a centre from where it should be [m], NaN if any is not finite.
double largest_distance(std::span<const BodyState> states, const Centres& expected);

/// Errors of runs whose centres were off by these largest distances [m]: over the path's length
/// [m], >= 0, absolute if that is 0. Runs that are not finite (NaN) give a reason and do not count.
PhaseErrors trajectory_errors(std::span<const double> distances, double path_length);

/// Compares an engine's runs with the samples while they go on, past the scene's own end up to the
/// last sample.
class TrajectoryWatch final : public PhaseWatch {
 public:
  /// `samples` must outlive this.
  explicit TrajectoryWatch(const TrajectorySamples& samples) : samples_(&samples) {}

  void begin(double time, std::span<const BodyState> states) override;
  void take(double time, const Frame& frame) override;
  bool wants_more() const override { return next_ < samples_->steps.size(); }

  /// The largest distance of a centre in each run so far [m], NaN where the run was not finite.
  const std::vector<double>& distances() const { return distances_; }

 private:
  const TrajectorySamples* samples_;
  std::size_t step_ = 0, next_ = 0;
  std::vector<double> distances_;
};

}  // namespace slipcheck
