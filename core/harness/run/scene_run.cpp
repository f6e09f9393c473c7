#include "harness/run/scene_run.h"

#include <algorithm>
#include <deque>
#include <memory>
#include <utility>

#include "engine/engine_registry.h"
#include "engine/worker_pool.h"
#include "harness/run/engine_work.h"
#include "harness/run/reference_motion.h"
#include "harness/run/requested_runs.h"

namespace slipcheck {
namespace {

void record_motion_of(PreparedScene& scene, double time_limit) {
  if (!is_recorded(scene) || scene.reference.observables.empty()) return;  // none: it has failed
  try {
    const StopScope limit(time_limit);
    scene.reference.motion = reference_motion(scene.solver, scene.reference.run.end_time);
  } catch (const std::exception& fault) {
    scene.reference.warnings.push_back(std::string("its motion was not recorded: ") + fault.what());
  }
}

/// What was solved, which the solver is not asked for again.
std::shared_ptr<const ContactScene> solved_of(PreparedScene& scene) {
  if (&scene.solver.scene() == scene.contact.get()) return std::move(scene.contact);
  return std::make_shared<const ContactScene>(scene.solver.scene());
}

}  // namespace

void run_engines(std::span<const EngineTask> tasks, const RunOptions& options) {
  const std::vector<EngineExecutable> installed = find_engines();
  const auto pool =
      options.pool ? options.pool : std::make_shared<WorkerPool>(options.workers, options.limits);
  const std::size_t workers =
      (pool->threads() + tasks.size() - 1) / std::max<std::size_t>(tasks.size(), 1);
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

  const std::vector<JobResult> results = pool->run_all(jobs, options.progress, options.stop);
  std::span<const JobResult> left = results;
  for (EngineWork& work : works) {
    work.settle(left.first(work.parts()));
    left = left.subspan(work.parts());
  }
}

std::vector<SceneRecord> run_scenes(std::vector<Scenario> scenarios, const RunOptions& options) {
  const StopScope scope(options.stop);
  std::vector<std::vector<EngineRecord>> runs = requested_runs(
      scenarios, options.limits, options.stop, options.settings, options.general, options.whole);
  std::vector<EngineTask> tasks;
  std::vector<std::size_t> scene_of;  // each task's
  for (std::size_t s = 0; s < scenarios.size(); ++s)
    for (EngineRecord& record : runs[s]) {
      if (!record.reason.empty()) continue;
      scene_of.push_back(s);
      EngineTask& task = tasks.emplace_back();
      task.record = &record;
      if (options.whole && options.keep_run)
        task.checkpoints = std::make_shared<Checkpoints>(options.keep_run(scenarios[s], record));
    }
  std::vector<PreparedScene> prepared =
      prepare_scenes(std::move(scenarios), options.general, options.workers, options.time_limit,
                     options.threads, options.extras.empty() ? nullptr : &options.extras);
  for (std::size_t k = 0; k < tasks.size(); ++k) tasks[k].scene = &prepared[scene_of[k]];
  run_engines(tasks, options);
  if (options.record_motion && !options.whole)
    for (PreparedScene& scene : prepared) record_motion_of(scene, options.time_limit);

  std::vector<SceneRecord> scenes;
  for (std::size_t s = 0; s < prepared.size(); ++s) {
    PreparedScene& scene = prepared[s];
    std::shared_ptr<const ContactScene> solved = solved_of(scene);
    scenes.push_back({std::move(scene.scenario), std::move(solved), std::move(scene.reference),
                      std::move(runs[s])});
  }
  return scenes;
}

}  // namespace slipcheck
