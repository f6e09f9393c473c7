#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

#include "studies/precision/precision.h"

namespace slipcheck {

/// One method at one setting, to be timed.
struct TimedWork {
  WorkPrecision* point = nullptr;  ///< takes the cost, or the reason why there is none
  double steps = 0;                ///< that are timed at once, > 0
  double steps_per_second = 0;     ///< of simulated time [1/s], > 0
  /// The CPU time of these steps [s], the least of a few runs. Throws what becomes the reason.
  std::function<double()> once;
};

/// Times all works in turn, and that `repeats` times, >= 1, on one core: a slow spell of the
/// machine hits all alike, and the least of the repeats is what remains of each. A work that throws
/// keeps its reason and is not tried again; nothing else is lost. Once `stop` is set, works have
/// the repeats that they got.
void time_in_turn(std::vector<TimedWork>& works, std::size_t repeats,
                  const std::atomic<bool>* stop = nullptr);

/// The CPU time of a run in this thread [s], the least of as many as fill a millisecond.
double least_cpu_seconds(const std::function<void()>& run);

}  // namespace slipcheck
