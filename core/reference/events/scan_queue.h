#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "reference/events/calendar_queue.h"

namespace slipcheck {

/// The event queue of a few bodies: their times in a row, looked through for the earliest. Order
/// and ties are as in HeapQueue. O(n) an event, but with nothing to set up.
class ScanQueue {
 public:
  explicit ScanQueue(std::size_t n) : times_(n, std::numeric_limits<double>::infinity()) {}

  void set(std::uint32_t body, double time) { times_[body] = time; }
  /// The body with the earliest time; there is one body at least.
  QueuedEvent first() const {
    QueuedEvent earliest{times_.front(), 0};
    for (std::uint32_t i = 1; i < times_.size(); ++i)
      if (times_[i] < earliest.time) earliest = {times_[i], i};
    return earliest;
  }

 private:
  std::vector<double> times_;
};

}  // namespace slipcheck
