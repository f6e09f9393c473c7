#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <memory>

#include "base/in_parallel.h"
#include "studies/stability/outcome_watch.h"
#include "studies/stability/phase_comparison.h"
#include "studies/stability/stability.h"

namespace slipcheck {
namespace {

struct KnownPath {
  std::unique_ptr<const ReferencePath> path;
  std::string fault;  ///< why there is none
};

/// What the reference shows of each scene that something is to be run on.
std::map<const PreparedScene*, KnownPath> find_paths(std::span<const OutcomeTask> tasks,
                                                     std::size_t threads) {
  std::map<const PreparedScene*, KnownPath> paths;
  for (const OutcomeTask& task : tasks)
    if (task.record.reason.empty()) paths[task.scene];
  std::vector<const PreparedScene*> scenes;
  for (const auto& [scene, path] : paths) scenes.push_back(scene);
  in_parallel(scenes.size(), threads, [&](std::size_t k) {
    KnownPath& known = paths.at(scenes[k]);
    try {
      known.path = std::make_unique<const ReferencePath>(*scenes[k]);
    } catch (const std::exception& error) {
      known.fault = error.what();
    }
  });
  return paths;
}

void raise(double& value, double to) {
  if (std::isnan(value) || to > value) value = to;
}

/// Collects how phases came out into a run.
class Collector {
 public:
  explicit Collector(StabilityRun& run) : run_(run) { run.outcome = Outcome::accurate; }

  void add(const PhaseOutcome& phase) {
    ++run_.phases[static_cast<std::size_t>(phase.outcome)];
    if (phase.outcome <= run_.outcome) return;
    run_.outcome = phase.outcome;
    run_.why = phase.time > 0 ? fmt::format("{} (t = {:.4g} s)", phase.why, phase.time) : phase.why;
  }

 private:
  StabilityRun& run_;
};

/// The values that a phase shows.
std::map<std::string, double> shown_in(const EngineRecord& record, std::size_t phase) {
  std::map<std::string, double> shown;
  for (const auto& [name, value] : record.observables) shown.emplace(name, value.values[phase]);
  return shown;
}

/// The class of a phase of a complete ensemble.
PhaseOutcome compared(const PreparedScene& scene, const WatchedPhase& watched,
                      const PhaseComparison& comparison) {
  if (watched.outcome.outcome != Outcome::accurate) return watched.outcome;
  if (!comparison.within) return {Outcome::degraded, comparison.why, 0};
  const Run& run = scene.scenario.run;
  if (run.until != Run::Until::time && watched.end >= run.limit)
    return {Outcome::degraded, fmt::format("had not ended at the limit of {} s", run.limit), 0};
  return {};
}

/// How the phase came out in which an ensemble broke off.
PhaseOutcome broken(const EngineRecord& record, const WatchedPhase* watched) {
  switch (record.status) {
    case RunStatus::timed_out:
      return {Outcome::timed_out, record.reason, 0};
    case RunStatus::unstable:
      if (watched && watched->outcome.outcome >= Outcome::exploded) return watched->outcome;
      return {Outcome::exploded, record.reason, 0};
    default:
      return {Outcome::crashed, record.reason, 0};
  }
}

void class_run(const PreparedScene& scene, const std::vector<WatchedPhase>& watched,
               StabilityRun& run) {
  if (run.record.status == RunStatus::skipped) {
    run.outcome = Outcome::refused;
    run.why = run.record.reason;
    return;
  }
  for (const WatchedPhase& phase : watched) {
    raise(run.energy_gain, phase.energy_gain);
    raise(run.creep, phase.creep);
    raise(run.depth, phase.depth);
  }
  Collector collector(run);
  const std::size_t complete = std::min(run.record.phases, watched.size());
  for (std::size_t p = 0; p < complete; ++p) {
    // Of an ensemble that broke off later nothing is left that could be compared.
    if (run.record.status != RunStatus::ok) {
      if (watched[p].outcome.outcome != Outcome::accurate) collector.add(watched[p].outcome);
      continue;
    }
    const PhaseComparison comparison =
        compare_phase(scene.scenario, scene.reference, shown_in(run.record, p));
    if (!std::isnan(comparison.worst_error) &&
        (std::isnan(run.worst_error) || comparison.worst_error > run.worst_error)) {
      run.worst_error = comparison.worst_error;
      run.worst_observable = comparison.worst_observable;
    }
    collector.add(compared(scene, watched[p], comparison));
  }
  if (run.record.status != RunStatus::ok)
    collector.add(broken(run.record, watched.size() > complete ? &watched[complete] : nullptr));
}

}  // namespace

std::vector<StabilityRun> run_outcomes(std::span<const OutcomeTask> tasks,
                                       const OutcomeCriteria& criteria, const RunOptions& options) {
  const auto paths = find_paths(tasks, options.workers);
  std::vector<StabilityRun> runs(tasks.size());
  std::vector<std::unique_ptr<OutcomeWatch>> watches(tasks.size());
  std::vector<EngineTask> engine_tasks;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    EngineRecord& record = runs[k].record;
    record = tasks[k].record;
    if (!record.reason.empty()) continue;
    const KnownPath& known = paths.at(tasks[k].scene);
    if (!known.path) {
      record.reason = fmt::format("the reference fails along its run: {}", known.fault);
      continue;
    }
    watches[k] = std::make_unique<OutcomeWatch>(*known.path, criteria, 1 / record.rate);
    engine_tasks.push_back({tasks[k].scene, &record, watches[k].get()});
  }
  run_engines(engine_tasks, options);
  for (std::size_t k = 0; k < tasks.size(); ++k)
    class_run(*tasks[k].scene, watches[k] ? watches[k]->phases() : std::vector<WatchedPhase>{},
              runs[k]);
  return runs;
}

}  // namespace slipcheck
