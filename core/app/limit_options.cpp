#include "app/limit_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/number_range.h"

namespace slipcheck {

void add_workers_option(CLI::App& command, std::size_t& workers) {
  command.add_option("--workers", workers, "Engines at work at once; 0: one for each core")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
}

void add_time_limit_option(CLI::App& command, double& time_limit) {
  command
      .add_option("--time-limit", time_limit,
                  "Wall-clock seconds for one run of an engine, and for a scene's reference")
      ->check(positive_number())
      ->capture_default_str();
}

void add_memory_limit_option(CLI::App& command, WorkerLimits& limits) {
  command
      .add_option_function<std::size_t>(
          "--memory-limit", [&limits](std::size_t mebibytes) { limits.memory = mebibytes << 20; },
          "MiB for one engine")
      ->check(CLI::Range(16, 1 << 20))
      ->default_str(fmt::format("{}", limits.memory >> 20));
}

}  // namespace slipcheck
