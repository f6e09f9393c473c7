#pragma once

#include <CLI/App.hpp>
#include <cstddef>

#include "engine/worker_process.h"

namespace slipcheck {

/// `--workers`: how many engines are at work at once; 0 for each core one.
void add_workers_option(CLI::App& command, std::size_t& workers);

/// `--time-limit`: of one run of an engine, and of a scene's reference [s], finite and > 0.
void add_time_limit_option(CLI::App& command, double& time_limit);

/// `--memory-limit`, in MiB: of one engine.
void add_memory_limit_option(CLI::App& command, WorkerLimits& limits);

/// All three, for options that have `workers`, `time_limit` and `limits`.
template <class Options>
void add_limit_options(CLI::App& command, Options& options) {
  add_workers_option(command, options.workers);
  add_time_limit_option(command, options.time_limit);
  add_memory_limit_option(command, options.limits);
}

}  // namespace slipcheck
