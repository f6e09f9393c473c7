#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "engine/remote_engine.h"
#include "harness/compare/record.h"
#include "harness/observe/phase_watch.h"

namespace slipcheck {

/// What an ensemble of one engine's runs needs to know.
struct EnsembleTask {
  const ReferenceSolver* solver = nullptr;
  const ReferenceResult* reference = nullptr;
  const Scenario* scenario = nullptr;
  std::size_t phases = 32;                                      ///< >= 1
  double time_limit = std::numeric_limits<double>::infinity();  ///< of wall time for each [s]
  PhaseWatch* watch = nullptr;                                  ///< sees every frame too
};

/// Phases of an ensemble that one worker runs.
struct PhaseShare {
  std::size_t first = 0, last = 0;  ///< of the ensemble's phases; one beyond the last
  std::vector<std::map<std::string, double>> seen;  ///< observables by name, of those that ended
  std::size_t unfinished = 0;                       ///< of these, at the limit
  std::string unstable;                             ///< why the next one was given up
  std::string version;
  Applied applied;
  double cpu_seconds = 0;  ///< of the stepping alone
  std::size_t steps = 0;
};

/// The shares in which `count` workers run so many phases, in their order.
std::vector<PhaseShare> phase_shares(std::size_t phases, std::size_t count);

/// Runs the share's phases at the rate and with the settings of `record`. A state that is not
/// finite, or that has left all bounds, ends it. Throws what RemoteEngine throws, and what
/// StopScope does; what had ended by then is in the share.
void run_phases(RemoteEngine& engine, const EnsembleTask& task, const EngineRecord& record,
                PhaseShare& share);

/// The record's observables, errors and costs, from shares in the order of their phases: the same
/// as from one share, because nothing counts that comes after a phase that has none.
void finish_ensemble(const EnsembleTask& task, const std::vector<PhaseShare>& shares,
                     EngineRecord& record);

}  // namespace slipcheck
