#pragma once

#include <cstdint>
#include <deque>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "harness/run/prepared_scene.h"
#include "scenario/reading.h"
#include "studies/sweep/sweep_plan.h"

namespace slipcheck {

/// A scene of a sweep with its reference.
struct SweepScene {
  std::optional<PreparedScene> prepared;
  std::string refused;  ///< why there is none: a rule that the combination breaks
  ReadNumbers numbers;  ///< of its parameters
};

/// Scenes by their number, each solved once by the thread that asks first; the last `kept` stay.
class SweepScenes {
 public:
  /// `time_limit`: of wall time for a reference [s].
  SweepScenes(const SweepPlan& plan, std::size_t kept, double time_limit)
      : plan_(plan), kept_(kept), time_limit_(time_limit) {}

  /// The run's scene; waits where another thread solves it. Throws Interrupted.
  std::shared_ptr<const SweepScene> of(std::uint64_t run);

 private:
  using Pointer = std::shared_ptr<const SweepScene>;
  Pointer solved(std::uint64_t run) const;

  const SweepPlan& plan_;
  std::size_t kept_;
  double time_limit_;
  std::mutex mutex_;
  std::map<std::uint64_t, std::shared_future<Pointer>> scenes_;
  std::deque<std::uint64_t> order_;  ///< the oldest first
};

}  // namespace slipcheck
