#pragma once

#include <compare>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace slipcheck {

/// How a worker is started.
struct WorkerCommand {
  WorkerCommand() = default;
  /// A worker that is a program of its own needs no arguments.
  WorkerCommand(std::filesystem::path to_start, std::vector<std::string> with = {})
      : program(std::move(to_start)), arguments(std::move(with)) {}
  auto operator<=>(const WorkerCommand&) const = default;

  std::filesystem::path program;  ///< found by PATH where it is a name alone
  std::vector<std::string> arguments;
};

}  // namespace slipcheck
