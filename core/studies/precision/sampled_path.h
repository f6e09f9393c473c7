#pragma once

#include <span>
#include <vector>

#include "harness/run/reference_run.h"
#include "studies/precision/trajectory.h"

namespace slipcheck {

/// The reference's path that trajectories are held against.
struct TravelledPath {
  std::vector<double> times;     ///< rising [s]
  std::vector<Centres> centres;  ///< at these times; fewer where the reference gave up
  double length = 0;             ///< longest path of a body, straight between these times [m]
};

/// At 512 times up to the end of the reference's run. The length misses at most the way of one such
/// interval where a body turns back, and elsewhere far less.
TravelledPath travelled_path(const ReferenceSolver& solver, const ReferenceResult& reference);

/// The largest distance of a centre [m]; NaN where there are fewer instants than expected.
double largest_distance(std::span<const Centres> found, std::span<const Centres> expected);

/// The states at given times of a run that is shown by its steps: between them a body moves by the
/// cubic with its velocities at both ends, whose error (h⁴ of a smooth force) is far below that of
/// the step itself.
class SampledPath final : public FrameSink {
 public:
  /// times [s] rising, >= 0, must outlive this; `next`, where given, is told everything first.
  SampledPath(std::span<const double> times, FrameSink* next) : times_(times), next_(next) {}

  void take(double time, const Frame& frame) override;
  /// `next` has seen enough.
  void stop_telling() { next_ = nullptr; }

  std::vector<Centres> centres;

 private:
  Centres between(double wanted, double time, const std::vector<BodyState>& now) const;

  std::span<const double> times_;
  FrameSink* next_;
  double before_ = 0;
  std::vector<BodyState> last_;
};

}  // namespace slipcheck
