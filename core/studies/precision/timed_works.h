#pragma once

#include <atomic>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/engine_registry.h"
#include "engine/remote_engine.h"
#include "harness/run/prepared_scene.h"
#include "studies/precision/work_cost.h"

namespace slipcheck {

/// Workers that are there for timing alone, one for each command, all in the thread that uses
/// them. One that failed is replaced when it is asked for again.
class TimingWorkers {
 public:
  TimingWorkers(const WorkerLimits& limits, const std::atomic<bool>* stop)
      : limits_(limits), stop_(stop) {}

  /// Throws what RemoteEngine throws, and std::runtime_error where it is not installed.
  RemoteEngine& worker(const std::string& engine, const std::string& precision);

 private:
  WorkerLimits limits_;
  const std::atomic<bool>* stop_;
  std::vector<EngineExecutable> installed_ = find_engines();
  std::map<WorkerCommand, std::unique_ptr<RemoteEngine>> workers_;
};

/// A stretch of a scene's run that is representative and short: what is timed of it.
struct TimedStretch {
  std::vector<BodyState> states;
  double start = 0;       ///< [s]
  std::size_t steps = 0;  ///< > 0
};

/// Of the run up to `end` [s] in steps of `step` [s]: all of it, or the `most` steps around the
/// first contact [s], half of them before it. A step costs the same over a run but for the
/// collision, and this way every run that is timed has it.
TimedStretch timed_stretch(const ReferenceSolver& solver, double first_contact, double end,
                           double step, std::size_t most);

/// What is to be timed of these curves: every point that has errors, of engines and of the
/// reference's own solvers. Curves, scene and workers must outlive it.
std::vector<TimedWork> timed_works(const PreparedScene& scene, std::vector<MethodCurve>& curves,
                                   TimingWorkers& workers);

}  // namespace slipcheck
