#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/worker_pool.h"
#include "harness/observe/motion_recorder.h"
#include "harness/run/engine_run.h"
#include "harness/run/scene_run.h"

namespace slipcheck {

/// What a job that did not come to its end makes of a run.
EngineRecord::Status status_of(JobResult::Status status);

/// Whether motion in this scene can be recorded.
bool is_recorded(const PreparedScene& scene);

/// A task as its workers see it: the phases of one ensemble are shared where nobody looks at all of
/// them and there are more workers than tasks. Task, options and scene outlive it.
class EngineWork {
 public:
  /// `workers` >= 1 share the ensemble. Throws where there is no similar scene at the scale.
  EngineWork(const EngineTask& task, const RunOptions& options, std::size_t workers);

  std::size_t parts() const { return shares_.size(); }
  EngineRecord& record() const { return *task_.record; }

  void run(RemoteEngine& engine, std::size_t part);

  /// All parts have come to an end, one way or another: fills in the record.
  void settle(std::span<const JobResult> results);

 private:
  void finish();
  void note_failure(const JobResult& result);

  EngineTask task_;
  const RunOptions* options_;
  std::shared_ptr<const ContactScene> scaled_;
  std::size_t ended_ = 0;  ///< runs
  EnsembleTask ensemble_;
  bool records_motion_;
  std::size_t samples_ = 0;  ///< of the whole, where nothing else is looked at
  std::vector<PhaseShare> shares_;
  std::optional<MotionRecorder> recorder_;
};

}  // namespace slipcheck
