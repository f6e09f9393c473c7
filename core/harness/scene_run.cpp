#include "harness/scene_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "engine/engine_registry.h"
#include "engine/worker_pool.h"
#include "harness/box_run.h"
#include "harness/comparison.h"
#include "harness/engine_run.h"
#include "harness/motion_recorder.h"
#include "harness/reference_motion.h"
#include "harness/requested_runs.h"

namespace slipcheck {
namespace {

EngineRecord::Status status_of(JobResult::Status status) {
  switch (status) {
    case JobResult::Status::ok:
      return EngineRecord::Status::ok;
    case JobResult::Status::timed_out:
      return EngineRecord::Status::timed_out;
    case JobResult::Status::skipped:
      return EngineRecord::Status::skipped;
    case JobResult::Status::crashed:
    case JobResult::Status::failed:
      break;
  }
  return EngineRecord::Status::crashed;
}

void run_task(const ReferenceSolver& solver, RemoteEngine& engine, const EngineTask& task,
              const RunOptions& options) {
  const PreparedScene& scene = *task.scene;
  EngineRecord& record = *task.record;
  const HardScene& hard = solver.scene().hard;
  EnsembleTask ensemble{&solver, &scene.reference, &scene.scenario, options.phases, task.watch};
  if (!options.record_motion || task.watch || hard.bodies.size() > kMostRecordedBodies) {
    run_ensemble(engine, ensemble, record);
    return;
  }
  MotionRecorder recorder(hard);
  ensemble.watch = &recorder;
  try {
    run_ensemble(engine, ensemble, record);
  } catch (const WorkerFailure&) {
    record.motions = recorder.last_seen();
    throw;
  }
  record.motions =
      record.status == EngineRecord::Status::ok
          ? recorder.picked(phase_errors(scene.scenario, scene.reference, record.observables))
          : recorder.last_seen();
}
void run_task(const BoxSolver& solver, RemoteEngine& engine, const EngineTask& task,
              const RunOptions& options) {
  run_box_ensemble(engine, {&solver, &task.scene->reference, &task.scene->scenario, options.phases},
                   *task.record);
}

void record_motion_of(PreparedScene& scene) {
  const auto* solver = std::get_if<ReferenceSolver>(&scene.solver);
  if (!solver || scene.scenario.bodies.size() > kMostRecordedBodies) return;
  scene.reference.motion = reference_motion(*solver, scene.reference.run.end_time);
}

}  // namespace

void run_engines(std::span<const EngineTask> tasks, const RunOptions& options) {
  const std::vector<EngineExecutable> installed = find_engines();
  std::vector<EngineJob> jobs;
  std::vector<EngineRecord*> records;  // of each job
  for (const EngineTask& task : tasks) {
    EngineRecord& record = *task.record;
    const auto executable = std::ranges::find_if(installed, [&](const EngineExecutable& each) {
      return each.engine == record.engine && each.precision == record.precision;
    });
    if (executable == installed.end()) {
      record.reason =
          fmt::format("slipcheck-engine-{}-{} is not installed", record.engine, record.precision);
      continue;
    }
    jobs.push_back({executable->path, [&task, &options](RemoteEngine& engine) {
                      engine.limit_run(options.time_limit);
                      std::visit(
                          [&](const auto& solver) { run_task(solver, engine, task, options); },
                          task.scene->solver);
                    }});
    records.push_back(&record);
  }

  const WorkerPool pool(options.workers, options.limits);
  const std::vector<JobResult> results = pool.run_all(jobs, options.progress, options.stop);
  for (std::size_t k = 0; k < results.size(); ++k) {
    // The record says more than the pool where the job itself came to an end.
    if (results[k].status == JobResult::Status::ok) continue;
    // A fault of ours is no result of an engine.
    if (results[k].status == JobResult::Status::failed) std::rethrow_exception(results[k].error);
    records[k]->status = status_of(results[k].status);
    records[k]->reason = results[k].reason;
    if (records[k]->phases > 0)
      records[k]->reason +=
          fmt::format(" (in phase {} of {})", records[k]->phases + 1, options.phases);
  }
}

std::vector<SceneRecord> run_scenes(std::vector<Scenario> scenarios, const RunOptions& options) {
  std::vector<std::vector<EngineRecord>> runs =
      requested_runs(scenarios, options.limits, options.stop, options.settings);
  std::vector<PreparedScene> prepared = prepare_scenes(std::move(scenarios));
  std::vector<EngineTask> tasks;
  for (std::size_t s = 0; s < prepared.size(); ++s)
    for (EngineRecord& record : runs[s])
      if (record.reason.empty()) tasks.push_back({&prepared[s], &record});
  run_engines(tasks, options);
  if (options.record_motion) std::ranges::for_each(prepared, record_motion_of);

  std::vector<SceneRecord> scenes;
  for (std::size_t s = 0; s < prepared.size(); ++s)
    scenes.push_back(
        {std::move(prepared[s].scenario), std::move(prepared[s].reference), std::move(runs[s])});
  return scenes;
}

}  // namespace slipcheck
