#pragma once

#include <algorithm>

namespace slipcheck {

/// A quantity that falls towards zero and is seen at some instants only: slip, speed, spin.
/// Remembers how fast it fell, so that its zero is found inside a step.
class FallingQuantity {
 public:
  void reset() { rate_ = 0; }
  /// It was `before` and is `after` at the end of an interval `dt` [s], > 0.
  void fall(double before, double after, double dt) { rate_ = (before - after) / dt; }
  /// When it reaches zero, counted from the start of an interval `dt` in which it fell from
  /// `before` to `after` and came to count as zero. The end of the interval where no rate is known;
  /// beyond it only where `after` is what a steady fall leaves.
  double time_to_zero(double before, double after, double dt) const;
  /// The same where it is zero at the end of the interval: not beyond.
  double time_to_zero(double before, double dt) const;
  /// What falls in `dt`, or 0 where no rate is known.
  double falls_in(double dt) const { return std::max(rate_, 0.0) * dt; }

 private:
  double rate_ = 0;
};

}  // namespace slipcheck
