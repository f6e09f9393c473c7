#pragma once

#include <cstddef>
#include <string>

namespace slipcheck {

/// Tells when events have come too fast for too long, as in a collapse that no rule ends.
class RateLimit {
 public:
  /// At most `most` events for each of `bodies` and second [1/s], looked at over `window` events.
  RateLimit(double most, std::size_t bodies, std::size_t window, double now)
      : most_(most), bodies_(static_cast<double>(bodies)), window_(window), start_(now) {}

  /// After one event more, at `now` [s].
  bool is_exceeded(double now) {
    if (++count_ % window_ != 0) return false;
    const double passed = now - start_;
    start_ = now;
    return static_cast<double>(window_) > most_ * bodies_ * passed;
  }

  /// Why a run ends where it is exceeded.
  std::string reason(double now) const;

 private:
  double most_, bodies_;
  std::size_t window_, count_ = 0;
  double start_;
};

}  // namespace slipcheck
