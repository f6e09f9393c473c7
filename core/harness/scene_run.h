#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

#include "engine/worker_process.h"
#include "harness/record.h"

namespace slipcheck {

struct RunOptions {
  std::size_t phases = 32;  ///< size of each engine's ensemble, >= 1
  std::size_t workers = 0;  ///< at once; 0: one for each core
  double time_limit = 60;   ///< of wall time for one phase of an engine [s], > 0
  WorkerLimits limits;
  const std::atomic<bool>* stop = nullptr;  ///< once set, what has not begun is skipped
  std::function<void(std::size_t done, std::size_t total)> progress;  ///< of ensembles
};

/// Everything that is asked of these scenes: the reference, then every engine at every rate in
/// worker processes. Before anything runs, throws BadScenario where a scene names an unknown engine
/// and Unsupported where no solver knows a model. What engines do afterwards is in the records.
std::vector<SceneRecord> run_scenes(std::vector<Scenario> scenarios, const RunOptions& options);

}  // namespace slipcheck
