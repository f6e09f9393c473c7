#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

namespace slipcheck {

/// "45 s", "12 min", "3 h 20 min", "2 d 5 h".
std::string duration_text(double seconds);

/// How far a sweep has come and how long it takes yet, on stderr: a line that stays in its place on
/// a terminal, else a line of a log every half minute.
class SweepProgress {
 public:
  SweepProgress(std::uint64_t total, bool shown);
  ~SweepProgress();
  SweepProgress(const SweepProgress&) = delete;
  SweepProgress& operator=(const SweepProgress&) = delete;

  /// From any thread.
  void set(std::uint64_t done);

 private:
  std::string line(double seconds) const;

  std::uint64_t total_;
  std::atomic<std::uint64_t> done_{0};
  std::jthread ticker_;
};

}  // namespace slipcheck
