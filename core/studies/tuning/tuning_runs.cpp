#include "studies/tuning/tuning_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "engine/worker_pool.h"
#include "scenario/observable_key.h"
#include "scenario/tolerances.h"

namespace slipcheck {
namespace {

bool has_observable(const PreparedScene& scene, const std::string& observable) {
  return std::ranges::any_of(scene.reference.observables, [&](const auto& named) {
    return observable_key(named.first).bare() == observable;
  });
}

bool anything_counts(const PreparedScene& scene, const TuningObservables& observables) {
  if (observables.named.empty())
    return std::ranges::any_of(scene.reference.observables, [&](const auto& value) {
      return tolerance_of(scene.scenario, value.first).has_value();
    });
  return std::ranges::any_of(observables.named, [&](const std::string& observable) {
    return has_observable(scene, observable);
  });
}

}  // namespace

std::vector<TuningTask> tuning_tasks(const std::vector<PreparedScene>& scenes, std::size_t training,
                                     const std::vector<double>& rates) {
  std::vector<TuningTask> tasks;
  for (std::size_t s = 0; s < scenes.size(); ++s)
    for (double rate : rates)
      tasks.push_back({scenes[s].scenario.name, scenes[s].scenario.sha256, rate, s >= training, s});
  return tasks;
}

TuningRuns engine_tuning_runs(const std::vector<PreparedScene>& scenes, const std::string& engine,
                              const std::string& precision, const TuningObservables& observables,
                              RunOptions options) {
  options.pool = std::make_shared<WorkerPool>(options.workers, options.limits);
  return [&scenes, engine, precision, observables, options = std::move(options)](
             const Settings& settings, std::size_t phases,
             std::span<const TuningTask* const> tasks) {
    std::vector<EngineRecord> records(tasks.size());
    std::vector<EngineTask> runs;
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      records[k].engine = engine;
      records[k].precision = precision;
      records[k].settings = settings;
      records[k].rate = tasks[k]->rate;
      runs.push_back({&scenes[tasks[k]->scene_index], &records[k]});
    }
    RunOptions chosen = options;
    chosen.phases = phases;
    run_engines(runs, chosen);

    const bool interrupted = options.stop != nullptr && *options.stop;
    std::vector<std::optional<RunScore>> scores;
    for (const EngineRecord& record : records) {
      // After an interruption a failure may be no fault of the settings.
      const bool known = record.status == EngineRecord::Status::ok || !interrupted;
      scores.push_back(known ? std::optional(score_of(record, observables, phases)) : std::nullopt);
    }
    return scores;
  };
}

std::string nothing_to_tune(const std::vector<PreparedScene>& scenes,
                            const TuningObservables& observables) {
  for (const std::string& observable : observables.named)
    if (std::ranges::none_of(
            scenes, [&](const PreparedScene& scene) { return has_observable(scene, observable); }))
      return fmt::format("--observables: must be seen in a scene's reference, got {}", observable);
  for (const PreparedScene& scene : scenes)
    if (!anything_counts(scene, observables))
      return fmt::format(
          "{}: must have a tolerance for an observable of its reference (compare.tolerance), or "
          "--observables must name one",
          scene.scenario.file);
  return "";
}

}  // namespace slipcheck
