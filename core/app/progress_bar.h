#pragma once

#include <atomic>
#include <cstddef>
#include <optional>
#include <string>

#include "app/progress_line.h"

namespace slipcheck {

/// Colour and progress bars only on a terminal, never with NO_COLOR or --quiet.
bool is_plain_terminal(int file_descriptor);

/// Shows on stderr how far a longer piece of work has come and how long it takes yet: on a terminal
/// a bar after a second, which vanishes at the end, else a line of a log every half minute.
class ProgressBar {
 public:
  ProgressBar(std::string label, bool shown);

  /// From any thread.
  void set(std::size_t done, std::size_t total);

 private:
  std::string line(double seconds) const;

  LinePlace place_;
  std::string label_;
  std::atomic<std::size_t> done_{0}, total_{0};
  std::optional<ProgressLine> line_;
};

}  // namespace slipcheck
