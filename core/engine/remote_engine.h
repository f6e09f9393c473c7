#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/engine.h"
#include "engine/protocol.h"
#include "engine/worker_process.h"

namespace slipcheck {

/// An engine in a worker process of its own. Every member function throws WorkerFailure when the
/// worker crashes, hangs, takes too much memory or breaks the protocol, and Interrupted when the
/// stop flag is set; afterwards the worker is gone and alive() is false.
class RemoteEngine {
 public:
  /// Starts the worker and asks who it is.
  explicit RemoteEngine(const WorkerCommand& command, const WorkerLimits& limits = {},
                        const std::atomic<bool>* stop = nullptr);

  const EngineInfo& info() const { return info_; }

  /// Engine::configure over there; throws Refused with the engine's reason, and the worker lives.
  /// So does a scene of which the engine does not know what it holds (EngineInfo::takes).
  Applied configure(const EngineScene& scene, const Settings& settings, double time_step);

  /// A fresh world with one state for each body of the configured scene at `time` [s], >= 0. The
  /// time limit of the run counts from here.
  void start(std::span<const BodyState> states, double time = 0);

  /// Takes `steps` steps and hands over the frame after each, and before it those inside the step
  /// where the engine shows such, in order and on this thread. A
  /// callback that throws leaves the worker alive, further on by up to a MiB of frames.
  /// Returns the CPU time that the engine took for its steps [s].
  double advance(std::size_t steps, const std::function<void(const Frame&)>& callback);

  /// Takes `steps` >= 1 steps of which nobody sees anything but the bodies at the end of the last,
  /// `states`. Returns the CPU time that the engine took for them [s].
  double skip(std::size_t steps, std::vector<BodyState>& states);

  /// The CPU time [s] that the first `steps` steps take from these states at `time` [s] on, in each
  /// of `repeats` runs, with nothing looked at in between; both >= 1. All of it is one exchange,
  /// for which the limit of a reply holds. A run of its own begins with start() afterwards.
  std::vector<double> time_steps(std::span<const BodyState> states, double time, std::size_t steps,
                                 std::size_t repeats);

  /// Wall-clock time that a run may take, from start() to the last frame [s], > 0; infinite unless
  /// set.
  void limit_run(double seconds) { run_limit_ = seconds; }

  bool alive() { return process_.alive(); }
  pid_t pid() const { return process_.pid(); }

 private:
  bool takes(const std::string& word) const;
  protocol::Frames ask_for_frames(const protocol::Request& request, std::size_t steps);
  template <class Expected>
  Expected ask(const protocol::Request& request);

  WorkerProcess process_;
  EngineInfo info_;
  std::size_t bodies_ = 0, surfaces_ = 0;
  double run_limit_;
  std::vector<Frame> spare_;  ///< whose storage the next frames take
  WorkerProcess::Clock::time_point deadline_ = WorkerProcess::Clock::time_point::max();
};

}  // namespace slipcheck
