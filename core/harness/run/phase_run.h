#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "harness/observe/phase_watch.h"
#include "harness/run/engine_run.h"

namespace slipcheck {

/// A state of an engine that no comparison can be made with.
struct Unstable {
  std::string reason;
};

/// Follows one run of an engine and decides when it has ended.
class PhaseRun {
 public:
  virtual ~PhaseRun() = default;

  /// The end of one more step, or an instant inside it. Throws Unstable.
  void take(const Frame& frame);

  bool ended() const { return ended_; }
  /// Whether somebody still looks after the end.
  bool wants_more() const { return watch_ && watch_->wants_more(); }
  /// Whether it came to the end that the scenario asks for, not to the limit.
  bool reached() const { return reached_; }
  /// What was observed, by name.
  virtual std::map<std::string, double> values() const = 0;

 protected:
  /// `fastest`: of what the bodies bring with them, without falling [m/s].
  PhaseRun(const EnsembleTask& task, double step, double start, double fastest);

  const ReferenceSolver& solver() const { return solver_; }
  const Scene& scene() const { return scene_; }
  const RunEnd& end() const { return end_; }
  /// Notes whether the end that is asked for has come, and says so.
  bool come_to_end(bool reached) { return reached_ = reached; }

 private:
  /// Observes the frame at `time` [s]; whether the run has ended.
  virtual bool look(double time, const Frame& frame) = 0;

  const ReferenceSolver& solver_;
  const Scene& scene_;
  RunEnd end_;
  double fastest_, step_, start_;
  PhaseWatch* watch_;
  std::size_t steps_ = 0;
  bool ended_ = false, reached_ = false;
};

/// A run in steps of `step` [s] whose bodies are in `states` at `start` [s].
std::unique_ptr<PhaseRun> make_phase_run(const EnsembleTask& task, double step, double start,
                                         const std::vector<BodyState>& states);

}  // namespace slipcheck
