#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <thread>

namespace slipcheck {

/// Colour and progress bars only on a terminal, never with NO_COLOR or --quiet.
bool is_plain_terminal(int file_descriptor);

/// A line on stderr that shows how far a longer piece of work has come; it appears after a second
/// and vanishes at the end.
class ProgressBar {
 public:
  ProgressBar(std::string label, bool shown);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// From any thread.
  void set(std::size_t done, std::size_t total);

 private:
  void draw(double seconds) const;

  std::string label_;
  std::atomic<std::size_t> done_{0}, total_{0};
  std::jthread ticker_;
};

}  // namespace slipcheck
