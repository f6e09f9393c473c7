#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "reference/events/calendar_queue.h"

namespace slipcheck {

/// Binary heap of bodies by the time of their next event, the earliest on top, equal times by
/// number. Knows where each body is, so that one can be taken out: O(log n).
class IndexedHeap {
 public:
  /// For bodies 0 to n − 1; empty.
  explicit IndexedHeap(std::size_t n) : place_(n, kAbsent) {}

  bool holds(std::uint32_t body) const { return place_[body] != kAbsent; }
  const QueuedEvent& top() const { return heap_.front(); }

  void insert(std::uint32_t body, double time) {
    heap_.push_back({time, body});
    place_[body] = static_cast<std::uint32_t>(heap_.size() - 1);
    rise(heap_.size() - 1);
  }
  void erase(std::uint32_t body) {
    const std::size_t hole = place_[body];
    place_[body] = kAbsent;
    const QueuedEvent last = heap_.back();
    heap_.pop_back();
    if (hole == heap_.size()) return;
    put(hole, last);
    restore(hole);
  }
  /// Of a body that it holds.
  void change(std::uint32_t body, double time) {
    const std::size_t at = place_[body];
    heap_[at].time = time;
    restore(at);
  }

 private:
  static constexpr std::uint32_t kAbsent = std::numeric_limits<std::uint32_t>::max();

  void put(std::size_t at, const QueuedEvent& entry) {
    heap_[at] = entry;
    place_[entry.body] = static_cast<std::uint32_t>(at);
  }
  void restore(std::size_t at) {
    if (at > 0 && heap_[at] < heap_[(at - 1) / 2])
      rise(at);
    else
      sink(at);
  }
  void rise(std::size_t at) {
    const QueuedEvent entry = heap_[at];
    while (at > 0 && entry < heap_[(at - 1) / 2]) {
      put(at, heap_[(at - 1) / 2]);
      at = (at - 1) / 2;
    }
    put(at, entry);
  }
  void sink(std::size_t at) {
    const QueuedEvent entry = heap_[at];
    while (true) {
      std::size_t child = 2 * at + 1;
      if (child >= heap_.size()) break;
      if (child + 1 < heap_.size() && heap_[child + 1] < heap_[child]) ++child;
      if (!(heap_[child] < entry)) break;
      put(at, heap_[child]);
      at = child;
    }
    put(at, entry);
  }

  std::vector<QueuedEvent> heap_;
  std::vector<std::uint32_t> place_;
};

/// The same as an event queue: every body has one time, maybe infinite. O(log n) an event.
class HeapQueue {
 public:
  explicit HeapQueue(std::size_t n) : heap_(n) {
    for (std::uint32_t i = 0; i < n; ++i) heap_.insert(i, std::numeric_limits<double>::infinity());
  }
  void set(std::uint32_t body, double time) { heap_.change(body, time); }
  /// The body with the earliest time; there is one body at least.
  QueuedEvent first() { return heap_.top(); }

 private:
  IndexedHeap heap_;
};

}  // namespace slipcheck
