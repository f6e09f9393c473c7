#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace slipcheck {

/// A body and the time of its next event [s].
struct QueuedEvent {
  double time;
  std::uint32_t body;
  /// Equal times go by number.
  bool operator<(const QueuedEvent& other) const {
    return time < other.time || (time == other.time && body < other.body);
  }
};

/// Event queue whose cost for an event does not grow with the number of bodies, after the calendar
/// of Brown (1988) and Paul (2007): a wheel of unsorted lists, each for a short stretch of time,
/// one heap for the stretch that time is in, and one list for what lies beyond the wheel. How long
/// a stretch is follows the rate of events.
///
/// Every body has one time, maybe infinite. An entry that a later set() has replaced stays where it
/// is and is dropped when time comes to it: nothing is ever looked for in a list.
class CalendarQueue {
 public:
  /// For bodies 0 to n − 1, all at infinity.
  explicit CalendarQueue(std::size_t n);

  void set(std::uint32_t body, double time);
  /// The body with the earliest time. Where that is infinite, any.
  QueuedEvent first();

  /// Number of the stretch of time that first() is in. It may begin again.
  std::int64_t stretch() const { return current_; }
  /// Entries of the k-th stretch from there, in [0, 16), some of them replaced; more may come.
  std::span<const QueuedEvent> in_stretch(std::int64_t k) const {
    if (k == 0) return heap_;
    return wheel_[static_cast<std::size_t>(current_ + k) & (wheel_.size() - 1)];
  }
  void prefetch(std::uint32_t body) const { __builtin_prefetch(&time_[body]); }

 private:
  bool holds(const QueuedEvent& entry) const { return time_[entry.body] == entry.time; }
  /// Of a time in stretches since `base_`; as a double, for it may be huge.
  double stretch_of(double time) const { return (time - base_) * per_width_; }
  void place(const QueuedEvent& entry);
  void advance();
  void jump();
  void start();
  void rebuild(double base, double width);
  void adapt(double now);

  std::vector<double> time_;
  std::vector<QueuedEvent> heap_;
  std::vector<std::vector<QueuedEvent>> wheel_;
  std::vector<QueuedEvent> beyond_, moved_;
  std::size_t in_wheel_ = 0;
  double base_ = 0, per_width_ = 1;
  std::int64_t current_ = 0;  ///< the stretch that the heap holds, with all earlier ones
  // Since the width was last looked at:
  std::size_t placed_ = 0, advances_ = 0;
  double looked_at_ = 0;
  bool is_started_ = false;
};

}  // namespace slipcheck
