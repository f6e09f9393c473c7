#include "reference/calendar_queue.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace slipcheck {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
/// Events in a stretch: few enough for a flat heap, enough not to advance all the time.
constexpr double kGoal = 3;

}  // namespace

CalendarQueue::CalendarQueue(std::size_t n)
    : nodes_(n, Node{kNever, 0, kNone, kNone}),
      head_(std::bit_ceil(std::max<std::size_t>(n, 16)) + 1, kNone),
      heap_(n) {
  for (std::uint32_t i = 0; i < n; ++i) place(i);
}

void CalendarQueue::place(std::uint32_t body) {
  Node& node = nodes_[body];
  const double stretch = stretch_of(node.time);
  const auto wheel = static_cast<std::int64_t>(beyond());
  if (stretch < static_cast<double>(current_ + 1)) {
    node.list = kNone;
    heap_.insert(body, node.time);
    return;
  }
  if (stretch < static_cast<double>(current_ + wheel)) {
    node.list = static_cast<std::uint32_t>(static_cast<std::int64_t>(stretch) & (wheel - 1));
    ++in_wheel_;
  } else {
    node.list = beyond();
  }
  std::uint32_t& head = head_[node.list];
  node.before = kNone;
  node.after = head;
  if (head != kNone) nodes_[head].before = body;
  head = body;
}

void CalendarQueue::take_out(std::uint32_t body) {
  const Node& node = nodes_[body];
  if (node.list == kNone) {
    heap_.erase(body);
    return;
  }
  if (node.list != beyond()) --in_wheel_;
  (node.before == kNone ? head_[node.list] : nodes_[node.before].after) = node.after;
  if (node.after != kNone) nodes_[node.after].before = node.before;
}

void CalendarQueue::set(std::uint32_t body, double time) {
  Node& node = nodes_[body];
  const bool stays = node.list == kNone && stretch_of(time) < static_cast<double>(current_ + 1);
  if (stays) {
    node.time = time;
    heap_.change(body, time);
    return;
  }
  take_out(body);
  node.time = time;
  place(body);
}

IndexedHeap::Entry CalendarQueue::first() {
  while (heap_.is_empty()) {
    if (in_wheel_ == 0) {
      // Time jumps to the earliest of what lies beyond.
      IndexedHeap::Entry earliest{kNever, head_.back()};
      for (std::uint32_t i = head_.back(); i != kNone; i = nodes_[i].after)
        earliest = std::min(earliest, {nodes_[i].time, i});
      if (earliest.time == kNever) return earliest;
      rebuild(earliest.time, 1 / per_width_);
    } else {
      advance();
    }
  }
  const IndexedHeap::Entry next = heap_.top();
  // Looked at once in a while only: a new width costs as much as some events for every body.
  if (++served_ >= 8 * std::max<std::size_t>(nodes_.size(), 64)) {
    adapt(next.time);
    return heap_.is_empty() ? first() : heap_.top();
  }
  return next;
}

void CalendarQueue::advance() {
  ++current_;
  ++advances_;
  const auto wheel = static_cast<std::int64_t>(beyond());
  if ((current_ & (wheel - 1)) == 0) place_what_lies_beyond();
  std::uint32_t& head = head_[static_cast<std::size_t>(current_ & (wheel - 1))];
  for (std::uint32_t i = head; i != kNone; i = nodes_[i].after) {
    nodes_[i].list = kNone;
    heap_.insert(i, nodes_[i].time);
    --in_wheel_;
  }
  head = kNone;
}

void CalendarQueue::place_what_lies_beyond() {
  std::uint32_t i = head_.back();
  head_.back() = kNone;
  while (i != kNone) {
    const std::uint32_t after = nodes_[i].after;
    place(i);
    i = after;
  }
}

void CalendarQueue::rebuild(double base, double width) {
  std::fill(head_.begin(), head_.end(), kNone);
  heap_ = IndexedHeap(nodes_.size());
  in_wheel_ = 0;
  base_ = base;
  per_width_ = 1 / width;
  current_ = 0;
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) place(i);
}

void CalendarQueue::adapt(double now) {
  const auto served = static_cast<double>(served_);
  const double per_stretch = served / static_cast<double>(std::max<std::size_t>(advances_, 1));
  const double elapsed = now - served_since_;
  const bool is_off = per_stretch > 3 * kGoal || per_stretch < kGoal / 3;
  if (is_off && elapsed > 0) {
    // No finer than what times can tell apart.
    const double finest = 1e3 * std::numeric_limits<double>::epsilon() * std::abs(now);
    rebuild(now, std::max(kGoal * elapsed / served, finest));
  }
  served_ = advances_ = 0;
  served_since_ = now;
}

}  // namespace slipcheck
