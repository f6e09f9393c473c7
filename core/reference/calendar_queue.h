#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "reference/indexed_heap.h"

namespace slipcheck {

/// Event queue whose cost for an event does not grow with the number of bodies (Paul 2007, after
/// Brown's calendar): a wheel of unsorted lists, each for a short stretch of time, one heap for the
/// stretch that time is in, and one list for what lies beyond the wheel. The stretch is chosen, and
/// chosen again when the rate of events has changed, so that a few events fall into it.
///
/// Every body has one time, maybe infinite. Order and ties are as in HeapQueue.
class CalendarQueue {
 public:
  explicit CalendarQueue(std::size_t n);

  void set(std::uint32_t body, double time);
  /// The body with the earliest time; there is one body at least.
  IndexedHeap::Entry first();

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  struct Node {
    double time;
    std::uint32_t list;  ///< kNone: in the heap
    std::uint32_t before, after;
  };

  std::uint32_t beyond() const { return static_cast<std::uint32_t>(head_.size() - 1); }
  /// Of a time in the number of stretches since `base_`, as a double: maybe huge.
  double stretch_of(double time) const { return (time - base_) * per_width_; }
  void place(std::uint32_t body);
  void take_out(std::uint32_t body);
  void advance();
  void place_what_lies_beyond();
  void rebuild(double base, double width);
  void adapt(double now);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> head_;  ///< of each list; the last one lies beyond the wheel
  IndexedHeap heap_;
  std::size_t in_wheel_ = 0;
  double base_ = 0, per_width_ = 1;
  std::int64_t current_ = 0;  ///< stretch that the heap holds; all earlier ones too
  // Since the width was last looked at:
  std::size_t served_ = 0, advances_ = 0;
  double served_since_ = 0;
};

}  // namespace slipcheck
