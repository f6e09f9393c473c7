#pragma once

#include <compare>
#include <concepts>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace slipcheck {

/// How a worker is started.
struct WorkerCommand {
  WorkerCommand() = default;
  /// A worker that is a program of its own needs no arguments.
  template <std::convertible_to<std::filesystem::path> Path>
  WorkerCommand(const Path& to_start, std::vector<std::string> with = {})
      : program(to_start), arguments(std::move(with)) {}
  auto operator<=>(const WorkerCommand&) const = default;

  std::filesystem::path program;  ///< found by PATH where it is a name alone
  std::vector<std::string> arguments;
};

}  // namespace slipcheck
