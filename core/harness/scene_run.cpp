#include "harness/scene_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <variant>

#include "engine/engine_registry.h"
#include "engine/worker_pool.h"
#include "harness/box_run.h"
#include "harness/engine_run.h"
#include "scenario/fault.h"

namespace slipcheck {
namespace {

std::string precision_name(EngineRequest::Precision precision) {
  return precision == EngineRequest::Precision::single_ ? "single" : "double";
}

/// Every engine that the project or this machine knows of.
std::vector<std::string> engine_names() {
  std::set<std::string> names(known_engines().begin(), known_engines().end());
  for (const EngineExecutable& found : find_engines()) names.insert(found.engine);
  return {names.begin(), names.end()};
}

void refuse_unknown_engines(const std::vector<Scenario>& scenarios) {
  const std::vector<std::string> known = engine_names();
  std::vector<Fault> faults;
  for (const Scenario& scenario : scenarios)
    for (std::size_t k = 0; k < scenario.compare.engines.size(); ++k) {
      const std::string& engine = scenario.compare.engines[k].engine;
      if (std::find(known.begin(), known.end(), engine) != known.end()) continue;
      const std::string key = fmt::format("compare.engines[{}].engine", k);
      const auto place = scenario.locations.find(key);
      faults.push_back(
          {scenario.file, place == scenario.locations.end() ? Location{} : place->second, key,
           fmt::format("must be one of the engines {}", fmt::join(known, ", ")), engine});
    }
  if (!faults.empty()) throw BadScenario(std::move(faults));
}

std::vector<EngineRecord> requested_runs(const Scenario& scenario) {
  std::vector<EngineRecord> records;
  for (const EngineRequest& request : scenario.compare.engines)
    for (double rate : request.rates) {
      EngineRecord& record = records.emplace_back();
      record.engine = request.engine;
      record.precision = precision_name(request.precision);
      record.profile = request.profile;
      record.rate = rate;
    }
  return records;
}

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

std::variant<ReferenceSolver, BoxSolver> solver_of(const Scenario& scenario,
                                                   const ContactScene& scene) {
  if (scene.hard.box) return BoxSolver(scene, scenario.compare.reference, scenario.run.most_events);
  return ReferenceSolver(scene, scenario.compare.reference, scenario.run.most_events);
}

ReferenceResult reference_of(const ReferenceSolver& solver, const Scenario& scenario) {
  return run_reference(solver, run_end(scenario), body_names(scenario));
}
ReferenceResult reference_of(const BoxSolver& solver, const Scenario& scenario) {
  return run_box_reference(solver, scenario);
}

void run_ensemble_of(const ReferenceSolver& solver, RemoteEngine& engine, const SceneRecord& scene,
                     const RunOptions& options, EngineRecord& record) {
  run_ensemble(engine, {&solver, &scene.reference, &scene.scenario, options.phases}, record);
}
void run_ensemble_of(const BoxSolver& solver, RemoteEngine& engine, const SceneRecord& scene,
                     const RunOptions& options, EngineRecord& record) {
  run_box_ensemble(engine, {&solver, &scene.reference, &scene.scenario, options.phases}, record);
}

}  // namespace

std::vector<SceneRecord> run_scenes(std::vector<Scenario> scenarios, const RunOptions& options) {
  refuse_unknown_engines(scenarios);
  std::vector<ContactScene> contact_scenes;
  contact_scenes.reserve(scenarios.size());
  for (const Scenario& scenario : scenarios) contact_scenes.push_back(make_contact_scene(scenario));
  std::vector<std::variant<ReferenceSolver, BoxSolver>> solvers;
  solvers.reserve(scenarios.size());
  for (std::size_t s = 0; s < scenarios.size(); ++s)
    solvers.push_back(solver_of(scenarios[s], contact_scenes[s]));

  std::vector<SceneRecord> scenes(scenarios.size());
  std::vector<EngineJob> jobs;
  std::vector<EngineRecord*> records;  // of each job
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    SceneRecord& scene = scenes[s];
    scene.scenario = std::move(scenarios[s]);
    scene.reference = std::visit(
        [&](const auto& solver) { return reference_of(solver, scene.scenario); }, solvers[s]);
    scene.runs = requested_runs(scene.scenario);
    for (EngineRecord& record : scene.runs) {
      const auto executable = find_engine(record.engine, record.precision);
      if (!executable) {
        record.reason =
            fmt::format("slipcheck-engine-{}-{} is not installed", record.engine, record.precision);
        continue;
      }
      jobs.push_back({executable->path,
                      [&record, &scene, &options, &solver = solvers[s]](RemoteEngine& engine) {
                        engine.limit_run(options.time_limit);
                        std::visit(
                            [&](const auto& chosen) {
                              run_ensemble_of(chosen, engine, scene, options, record);
                            },
                            solver);
                      }});
      records.push_back(&record);
    }
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
  return scenes;
}

}  // namespace slipcheck
