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
  const ContactScene* scaled = nullptr;  ///< at the record's scale; may be null where that is 1
  std::size_t phases = 32;               ///< >= 1
  double time_limit = std::numeric_limits<double>::infinity();  ///< of wall time for each [s]
  double budget = std::numeric_limits<double>::infinity();      ///< of CPU time for all steps [s]
  PhaseWatch* watch = nullptr;                                  ///< sees every frame too
};

/// Runs of an ensemble that one worker does: of all phases in the first heading, then in the next.
struct PhaseShare {
  std::size_t first = 0, last = 0;                  ///< of the ensemble's runs; one beyond the last
  std::size_t stride = 1;                           ///< from one phase that is run to the next
  std::vector<std::map<std::string, double>> seen;  ///< observables by name, of those that ended
  std::size_t unfinished = 0;                       ///< of these, at the limit
  std::string unstable;                             ///< why the next one was given up
  std::string version;
  Applied applied;
  double cpu_seconds = 0;  ///< of the stepping alone
  std::size_t steps = 0;
};

/// How many phases an ensemble at this rate [Hz], > 0, has in each heading: of those that are asked
/// for, or one where nothing is met, the first of every `stride`.
std::size_t phase_count(const EnsembleTask& task, double rate, std::size_t stride);

/// The shares in which `count` workers do so many runs, in their order.
std::vector<PhaseShare> phase_shares(std::size_t runs, std::size_t count);

/// Does the share's runs at the rate, at the scale and with the settings of `record`: the engine
/// gets the similar scene, what it shows is scaled and turned back. A state that is not
/// finite, or that has left all bounds, ends it. Throws what RemoteEngine throws, and what
/// StopScope does; what had ended by then is in the share. Under a budget, which wants one share
/// for all, only every `stride`-th phase is run, as many as fit by what the first has taken, and
/// two at least.
void run_phases(RemoteEngine& engine, const EnsembleTask& task, const EngineRecord& record,
                PhaseShare& share);

/// The record's observables, errors and costs, from shares in the order of their phases: the same
/// as from one share, because nothing counts that comes after a run that did not end. Returns how
/// many runs came before that.
std::size_t finish_ensemble(const EnsembleTask& task, const std::vector<PhaseShare>& shares,
                            EngineRecord& record);

}  // namespace slipcheck
