#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/worker_process.h"

namespace slipcheck {

enum class CheckVerdict { passed, failed, not_judged };
template <>
inline constexpr std::array kNamesOf<CheckVerdict> = {"passed", "failed", "not judged"};

/// One question about a worker and its answer.
struct ConformanceCheck {
  std::string name;  ///< "greeting"
  CheckVerdict verdict = CheckVerdict::not_judged;
  std::string why;   ///< what was seen
  std::string mend;  ///< what to change in the worker; empty unless it failed
};

/// What a worker keeps of docs/engine-protocol.md, and of what every engine of spheres does.
struct ConformanceReport {
  WorkerCommand executable;
  std::string engine, version, precision;  ///< as it greets; empty where it does not
  std::string no_start;                    ///< why there is no worker to ask; empty where there is
  std::vector<ConformanceCheck> checks;    ///< in the order of the list

  std::size_t count(CheckVerdict verdict) const;
};

struct ConformanceOptions {
  WorkerLimits limits;
  const std::atomic<bool>* stop = nullptr;
  std::vector<std::string> only = {};  ///< names of the checks that are wanted; all where empty
  /// Called after each check with how many are done of how many.
  std::function<void(std::size_t, std::size_t)> progress = {};
};

/// Asks a worker everything, each check in worker processes of its own, so that no fault hides
/// another. Throws Interrupted.
ConformanceReport check_conformance(const WorkerCommand& executable,
                                    const ConformanceOptions& options = {});

/// The names of all checks, in their order.
std::vector<std::string> conformance_check_names();

}  // namespace slipcheck
