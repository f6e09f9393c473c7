#include "harness/run/scene_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include "engine/engine_registry.h"
#include "engine/worker_pool.h"
#include "harness/compare/comparison.h"
#include "harness/observe/motion_recorder.h"
#include "harness/run/engine_run.h"
#include "harness/run/reference_motion.h"
#include "harness/run/requested_runs.h"
#include "scenario/scaled_lengths.h"

namespace slipcheck {
namespace {

EngineRecord::Status status_of(JobResult::Status status) {
  switch (status) {
    case JobResult::Status::ok:
      return EngineRecord::Status::ok;
    case JobResult::Status::timed_out:
      return EngineRecord::Status::timed_out;
    case JobResult::Status::skipped:
    case JobResult::Status::failed:  // a fault of ours is no result of an engine
      return EngineRecord::Status::skipped;
    case JobResult::Status::crashed:
      break;
  }
  return EngineRecord::Status::crashed;
}

bool is_recorded(const PreparedScene& scene) {
  return !scene.contact->hard.box && scene.scenario.bodies.size() <= kMostRecordedBodies;
}

/// The scene at another scale, as engines are given it; null at its own. Throws Unsupported where
/// there is none.
std::shared_ptr<const ContactScene> scene_at(const Scenario& scenario, double scale) {
  if (scale == 1) return nullptr;
  auto scaled = solved_scene(scaled_lengths(scenario, scale));
  if (!scaled) throw Unsupported(fmt::format("the scene has no similar one at scale {:g}", scale));
  return scaled;
}

/// A task as its workers see it: the phases of one ensemble are shared where nobody looks at all of
/// them and there are more workers than tasks.
class EngineWork {
 public:
  EngineWork(const EngineTask& task, const RunOptions& options, std::size_t workers)
      : task_(&task),
        options_(&options),
        scaled_(scene_at(task.scene->scenario, task.record->scale)),
        ensemble_{.solver = &task.scene->solver,
                  .reference = &task.scene->reference,
                  .scenario = &task.scene->scenario,
                  .scaled = scaled_.get(),
                  .phases = options.phases,
                  .time_limit = options.time_limit,
                  .watch = task.watch},
        records_motion_(options.record_motion && !task.watch && is_recorded(*task.scene)),
        shares_(phase_shares(options.phases * task.record->headings,
                             task.watch || records_motion_ ? 1 : workers)) {}

  std::size_t parts() const { return shares_.size(); }
  EngineRecord& record() const { return *task_->record; }

  void run(RemoteEngine& engine, std::size_t part) {
    engine.limit_run(options_->time_limit);
    if (records_motion_) recorder_.emplace(ensemble_.solver->scene().hard);
    EnsembleTask ensemble = ensemble_;
    if (recorder_) ensemble.watch = &*recorder_;
    run_phases(engine, ensemble, record(), shares_[part]);
  }

  /// All parts have come to an end, one way or another.
  void finish() {
    ended_ = finish_ensemble(ensemble_, shares_, record());
    if (!recorder_) return;
    record().motions = record().status == EngineRecord::Status::ok
                           ? recorder_->picked(phase_errors(
                                 *ensemble_.scenario, *ensemble_.reference, record().observables))
                           : recorder_->last_seen();
    const std::size_t phases = phase_count(ensemble_, record().rate);
    for (RecordedMotion& motion : record().motions) {
      motion.heading = motion.phase / phases;
      motion.phase %= phases;
    }
  }

  /// Of a part that did not come to its end.
  void note_failure(const JobResult& result) {
    if (result.status == JobResult::Status::ok) return;
    record().status = status_of(result.status);
    record().errors.clear();
    record().reason = result.status == JobResult::Status::failed
                          ? "it could not be compared: " + result.reason
                          : result.reason;
    if (ended_ == 0) return;
    const std::size_t phases = phase_count(ensemble_, record().rate);
    record().reason += fmt::format(" (in phase {} of {}", ended_ % phases + 1, phases);
    if (record().headings > 1)
      record().reason += fmt::format(", heading {} of {}", ended_ / phases + 1, record().headings);
    record().reason += ")";
  }

 private:
  const EngineTask* task_;
  const RunOptions* options_;
  std::shared_ptr<const ContactScene> scaled_;
  std::size_t ended_ = 0;  ///< runs
  EnsembleTask ensemble_;
  bool records_motion_;
  std::vector<PhaseShare> shares_;
  std::optional<MotionRecorder> recorder_;
};

/// Deviations of a run that came to its end; a fault in them is no result of the engine.
void finish(EngineWork& work) {
  try {
    work.finish();
  } catch (const std::exception& fault) {
    work.note_failure({JobResult::Status::failed, fault.what(), std::current_exception()});
  }
}

void record_motion_of(PreparedScene& scene, double time_limit) {
  if (!is_recorded(scene) || scene.reference.observables.empty()) return;  // none: it has failed
  try {
    const StopScope limit(time_limit);
    scene.reference.motion = reference_motion(scene.solver, scene.reference.run.end_time);
  } catch (const std::exception& fault) {
    scene.reference.warnings.push_back(std::string("its motion was not recorded: ") + fault.what());
  }
}

}  // namespace

void run_engines(std::span<const EngineTask> tasks, const RunOptions& options) {
  const std::vector<EngineExecutable> installed = find_engines();
  const WorkerPool pool(options.workers, options.limits);
  const std::size_t workers =
      (pool.threads() + tasks.size() - 1) / std::max<std::size_t>(tasks.size(), 1);
  std::deque<EngineWork> works;
  std::vector<EngineJob> jobs;
  for (const EngineTask& task : tasks) {
    EngineRecord& record = *task.record;
    const auto executable = find_engine(record.engine, record.precision, installed);
    if (!executable) {
      record.reason = not_installed_text(record.engine, record.precision);
      continue;
    }
    try {
      works.emplace_back(task, options, workers);
    } catch (const std::exception& fault) {
      record.reason = fault.what();
      continue;
    }
    EngineWork& work = works.back();
    for (std::size_t part = 0; part < work.parts(); ++part)
      jobs.push_back(
          {executable->command, [&work, part](RemoteEngine& engine) { work.run(engine, part); }});
  }

  const std::vector<JobResult> results = pool.run_all(jobs, options.progress, options.stop);
  auto result = results.begin();
  for (EngineWork& work : works) {
    const auto end = result + static_cast<std::ptrdiff_t>(work.parts());
    finish(work);
    const auto failed = std::find_if(
        result, end, [](const JobResult& each) { return each.status != JobResult::Status::ok; });
    // What an unstable phase before it says stands.
    if (failed != end && work.record().status != EngineRecord::Status::unstable)
      work.note_failure(*failed);
    result = end;
  }
}

std::vector<SceneRecord> run_scenes(std::vector<Scenario> scenarios, const RunOptions& options) {
  const StopScope scope(options.stop);
  std::vector<std::vector<EngineRecord>> runs =
      requested_runs(scenarios, options.limits, options.stop, options.settings, options.general);
  std::vector<PreparedScene> prepared = prepare_scenes(
      std::move(scenarios), options.general, options.workers, options.time_limit, options.threads);
  std::vector<EngineTask> tasks;
  for (std::size_t s = 0; s < prepared.size(); ++s)
    for (EngineRecord& record : runs[s])
      if (record.reason.empty()) tasks.push_back({&prepared[s], &record});
  run_engines(tasks, options);
  if (options.record_motion)
    for (PreparedScene& scene : prepared) record_motion_of(scene, options.time_limit);

  std::vector<SceneRecord> scenes;
  for (std::size_t s = 0; s < prepared.size(); ++s)
    scenes.push_back({std::move(prepared[s].scenario),
                      std::make_shared<const ContactScene>(prepared[s].solver.scene()),
                      std::move(prepared[s].reference), std::move(runs[s])});
  return scenes;
}

}  // namespace slipcheck
