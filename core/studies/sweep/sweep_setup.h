#pragma once

#include <array>
#include <atomic>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "engine/engine_registry.h"
#include "engine/worker_process.h"
#include "harness/compare/record.h"
#include "studies/sweep/sweep_plan.h"
#include "studies/sweep/sweep_store.h"

namespace slipcheck {

/// A plan whose engines have been asked and whose settings they take.
class SweepSetup {
 public:
  struct Engine {
    WorkerCommand command;
    EngineRecord record;  ///< with the settings of its profile
    EngineInfo info;
  };

  /// Throws BadScenario with all that is wrong: engines that are unknown or not installed, profiles
  /// that cannot be used, settings that an engine does not take. `stop` as of RemoteEngine.
  SweepSetup(SweepPlan plan, const WorkerLimits& limits, const std::atomic<bool>* stop);

  const SweepPlan& plan() const { return plan_; }
  /// Of a choice of the plan, not of the reference alone.
  const Engine& engine(const SweepChoice& choice) const;
  /// The record of a run before it is made.
  EngineRecord record_of(const SweepChoice& choice) const;
  /// The head of its store; `program` as of StoreHead.
  StoreHead head(const std::string& program) const;
  /// What the installed engines are: engine, precision, version.
  std::vector<std::array<std::string, 3>> versions() const;

 private:
  using Key = std::tuple<std::string, std::string, std::string>;  // engine, precision, profile
  static Key key_of(const SweepChoice& choice);
  void choose_engines(const WorkerLimits& limits, const std::atomic<bool>* stop);
  void check_settings_of(std::size_t part) const;

  SweepPlan plan_;
  std::map<Key, Engine> engines_;
  std::vector<StoreColumn> columns_;
};

}  // namespace slipcheck
