#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/worker_process.h"
#include "harness/compare/record.h"
#include "harness/observe/phase_watch.h"
#include "harness/run/checkpoints.h"
#include "harness/run/prepared_scene.h"

namespace slipcheck {

class WorkerPool;

struct RunOptions {
  std::size_t phases = 32;  ///< size of each engine's ensemble, >= 1
  Settings settings;        ///< of engines, over those of every profile
  /// Scenes are looked at as a whole alone, as their `extras` say: one run of each engine, and
  /// nothing is judged.
  bool whole = false;
  bool general = false;  ///< nothing is left out, as of ReferenceSettings and requested_runs()
  /// Of the reference and of what no EngineTask::watch looks at; not in a box, nor of more bodies
  /// than kMostRecordedBodies.
  bool record_motion = false;
  std::size_t workers = 0;  ///< at once; 0: one for each core
  std::size_t threads = 1;  ///< that share one scene's reference, as of ReferenceSettings
  /// Of wall time for one phase of an engine, and for the reference of a scene [s], > 0.
  double time_limit = 60;
  /// Of CPU time for the steps of one ensemble, which else runs fewer phases, two at least [s], >
  /// 0.
  double budget = std::numeric_limits<double>::infinity();
  /// By the scenes' names: what else is wanted of their references, as of prepare_scenes().
  std::map<std::string, ReferenceExtras> extras;
  /// How a run of an engine that is looked at as a whole is kept on its way; empty: none is. Called
  /// before anything runs.
  std::function<Checkpoints(const Scenario&, const EngineRecord&)> keep_run;
  WorkerLimits limits;
  /// Its workers, started with these limits, serve one run after another; null: each run has its
  /// own.
  std::shared_ptr<WorkerPool> pool;
  /// Once set, what has not begun is skipped and what is at work ends within a second.
  const std::atomic<bool>* stop = nullptr;
  std::function<void(std::size_t done, std::size_t total)> progress;  ///< of ensembles
};

/// One engine at one rate on one scene. The record says which: its engine, precision, settings and
/// rate are given, the rest is filled in.
struct EngineTask {
  const PreparedScene* scene = nullptr;
  EngineRecord* record = nullptr;
  PhaseWatch* watch = nullptr;                               ///< sees every frame too; not in a box
  std::shared_ptr<const Checkpoints> checkpoints = nullptr;  ///< of a look at the whole; or null
};

/// Runs the ensembles of these tasks in worker processes, several at once. What becomes of each is
/// in its record; only a fault of the harness itself is thrown.
void run_engines(std::span<const EngineTask> tasks, const RunOptions& options);

/// Everything that is asked of these scenes: the reference, then every engine at every rate under
/// its profile. Before anything runs, throws BadScenario where a scene names an unknown engine or a
/// profile that cannot be used, and Unsupported where no solver knows a model. What engines do
/// afterwards is in the records.
std::vector<SceneRecord> run_scenes(std::vector<Scenario> scenarios, const RunOptions& options);

}  // namespace slipcheck
