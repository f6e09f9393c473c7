#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reference/events/huge_pages.h"
#include "reference/events/prefetch.h"

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
  /// f(body) for the entries of the k-th stretch from there, in [0, 16), that hold so far; more may
  /// come.
  template <class F>
  void for_each_in_stretch(std::int64_t k, F f) const {
    const auto look = [&](const QueuedEvent& entry) {
      if (holds(entry)) f(entry.body);
    };
    if (k == 0)
      std::ranges::for_each(heap_, look);
    else
      for_each_in(list_of(current_ + k), look);
  }
  // Into the caches, in this order as time comes nearer: the entries of the k-th stretch from
  // there, and what tells which of them hold.
  void prefetch_entries(std::int64_t k) const {
    for (std::uint32_t at = list_of(current_ + k).last; at != kNone; at = pieces_[at].before)
      for (std::size_t i = 0; i < kInPiece; i += 64 / sizeof(QueuedEvent))
        slipcheck::prefetch(&pieces_[at].entry[i]);
  }
  void prefetch_times(std::int64_t k) const {
    for_each_in(list_of(current_ + k),
                [&](const QueuedEvent& entry) { slipcheck::prefetch(&time_[entry.body]); });
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  static constexpr std::uint32_t kInPiece = 15;
  /// A piece of a list. Pieces are used again as soon as they are empty: all of them together take
  /// little more memory than their entries.
  struct alignas(64) Piece {
    std::array<QueuedEvent, kInPiece> entry;
    std::uint32_t before = kNone;  ///< in its list; full
  };
  static_assert(sizeof(Piece) == 256);
  struct List {
    std::uint32_t last = kNone;  ///< piece
    std::uint32_t count = 0;     ///< of entries in it
  };

  struct Entering {
    QueuedEvent entry;
    std::size_t list;
  };

  const List& list_of(std::int64_t stretch) const {
    return wheel_[static_cast<std::size_t>(stretch) & (wheel_.size() - 1)];
  }
  template <class F>
  void for_each_in(const List& list, F f) const {
    std::uint32_t count = list.count;
    for (std::uint32_t at = list.last; at != kNone; at = pieces_[at].before) {
      const Piece& piece = pieces_[at];
      for (std::uint32_t k = 0; k < count; ++k) f(piece.entry[k]);
      count = kInPiece;
    }
  }
  void append(List& list, const QueuedEvent& entry) {
    if (list.last == kNone || list.count == kInPiece) {
      if (free_.empty()) {
        free_.push_back(static_cast<std::uint32_t>(pieces_.size()));
        pieces_.emplace_back();
      }
      pieces_[free_.back()].before = list.last;
      list = {free_.back(), 0};
      free_.pop_back();
    }
    pieces_[list.last].entry[list.count++] = entry;
  }
  void clear(List& list);
  void enter();
  bool holds(const QueuedEvent& entry) const { return time_[entry.body] == entry.time; }
  /// Of a time in stretches since `base_`; as a double, for it may be huge.
  double stretch_of(double time) const { return (time - base_) * per_width_; }
  void place(const QueuedEvent& entry);
  void advance();
  void jump();
  void start();
  void rebuild(double base, double width);
  void adapt(double now);

  std::vector<double, HugePages<double>> time_;
  std::vector<QueuedEvent> heap_;
  std::vector<List> wheel_;
  std::vector<Piece, HugePages<Piece>> pieces_;
  std::vector<std::uint32_t> free_;  ///< pieces; the last that became empty last
  std::vector<QueuedEvent> beyond_, moved_;
  /// Placed since the present stretch began, and not yet in their lists, which are on their way
  /// into the caches meanwhile.
  std::vector<Entering> entering_;
  std::size_t in_wheel_ = 0;
  double base_ = 0, per_width_ = 1;
  std::int64_t current_ = 0;  ///< the stretch that the heap holds, with all earlier ones
  // Since the width was last looked at:
  std::size_t placed_ = 0, advances_ = 0;
  double looked_at_ = 0;
  bool is_started_ = false;
};

}  // namespace slipcheck
