#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

namespace slipcheck {

/// The user asked to stop.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// A calculation took longer than it may; what() names the limit.
class OutOfTime : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What ends the calculations of the thread that makes it while it lives. Everything that may take
/// long calls heed_stop(); nothing is handed down to it. Scopes nest: of time limits the earliest
/// holds, of flags the innermost.
class StopScope {
 public:
  using Clock = std::chrono::steady_clock;

  /// Once `stop` is set, heed_stop() throws Interrupted. Null: only what the outer scopes say.
  explicit StopScope(const std::atomic<bool>* stop);
  /// After so many seconds of wall time from now, > 0, maybe infinite, heed_stop() throws
  /// OutOfTime, "took longer than the time limit of 60 s (--time-limit)". An outer limit that comes
  /// earlier holds.
  explicit StopScope(double seconds);
  /// What a scope says, for a thread that takes a share of another one's work.
  struct Terms {
    const std::atomic<bool>* stop = nullptr;
    Clock::time_point deadline = Clock::time_point::max();
    double seconds = 0;  ///< that the deadline was set to
  };
  explicit StopScope(const Terms& terms);
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

  /// Those of this thread now.
  static Terms terms();

 private:
  Terms before_;
};

namespace stop_scope {

/// Of this thread.
struct State {
  StopScope::Terms terms;
  std::uint32_t looks = 0;
};
inline constinit thread_local State state;

/// Throws where the terms say so; looks at the clock.
void look();

}  // namespace stop_scope

/// For the outer loop of whatever takes long, every 10 ms at least: throws Interrupted or OutOfTime
/// where a StopScope of this thread says so. A flag is seen at once, the clock is read at every
/// 64th call; a nanosecond.
inline void heed_stop() {
  stop_scope::State& state = stop_scope::state;
  const std::atomic<bool>* stop = state.terms.stop;
  if ((stop != nullptr && stop->load(std::memory_order_relaxed)) || ++state.looks % 64 == 0)
      [[unlikely]]
    stop_scope::look();
}

}  // namespace slipcheck
