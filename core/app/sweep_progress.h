#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "app/progress_line.h"

namespace slipcheck {

/// How far a sweep has come and how long it takes yet, on stderr: a line that stays in its place on
/// a terminal, else a line of a log every half minute.
class SweepProgress {
 public:
  SweepProgress(std::uint64_t total, bool shown);

  /// From any thread.
  void set(std::uint64_t done);

 private:
  std::string line(double seconds) const;

  std::uint64_t total_;
  std::atomic<std::uint64_t> done_{0};
  std::optional<ProgressLine> line_;
};

}  // namespace slipcheck
