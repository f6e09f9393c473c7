#include "reference/events/calendar_queue.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "physics/numbers.h"

namespace slipcheck {
namespace {

/// Entries that are placed while time is in one stretch: few enough for a flat heap, and enough
/// that the ends of all lists together stay in a cache.
constexpr double kGoal = 48;

/// No finer than what times about `now` can tell apart.
double finest_width(double now) {
  return 1e3 * std::numeric_limits<double>::epsilon() * std::abs(now);
}

constexpr auto kLater = [](const QueuedEvent& a, const QueuedEvent& b) { return b < a; };

}  // namespace

CalendarQueue::CalendarQueue(std::size_t n)
    : time_(n, kNever), wheel_(std::bit_ceil(std::max<std::size_t>(n / 8, 16))) {}

void CalendarQueue::clear(List& list) {
  for (std::uint32_t at = list.last; at != kNone; at = pieces_[at].before) free_.push_back(at);
  list = {};
}

void CalendarQueue::place(const QueuedEvent& entry) {
  const double stretch = stretch_of(entry.time);
  const auto lists = static_cast<std::int64_t>(wheel_.size());
  if (stretch < static_cast<double>(current_ + 1)) {
    heap_.push_back(entry);
    std::push_heap(heap_.begin(), heap_.end(), kLater);
  } else if (stretch < static_cast<double>(current_ + lists)) {
    const auto list = static_cast<std::size_t>(static_cast<std::int64_t>(stretch) & (lists - 1));
    if (time_.size() < kManyForCaches) {
      append(wheel_[list], entry);
    } else {
      slipcheck::prefetch(&wheel_[list]);
      entering_.push_back({entry, list});
    }
    ++in_wheel_;
  } else if (entry.time < kNever) {
    beyond_.push_back(entry);
  }
}

/// All that are on their way into their lists, in the order in which they came.
void CalendarQueue::enter() {
  for (const auto& [entry, list] : entering_) {
    const List& to = wheel_[list];
    if (to.last != kNone) slipcheck::prefetch(&pieces_[to.last].entry[to.count % kInPiece]);
  }
  for (const auto& [entry, list] : entering_) append(wheel_[list], entry);
  entering_.clear();
}

void CalendarQueue::set(std::uint32_t body, double time) {
  if (time_[body] == time) return;
  time_[body] = time;
  ++placed_;
  place({time, body});
}

QueuedEvent CalendarQueue::first() {
  if (!is_started_) start();
  // A new width costs as much as some events of every body: not too often.
  if (placed_ > 8 * std::max<std::size_t>(time_.size(), 256) && !heap_.empty())
    adapt(heap_.front().time);
  while (true) {
    while (!heap_.empty() && !holds(heap_.front())) {
      std::pop_heap(heap_.begin(), heap_.end(), kLater);
      heap_.pop_back();
    }
    if (!heap_.empty()) return heap_.front();
    if (in_wheel_ > 0)
      advance();
    else if (!beyond_.empty())
      jump();
    else
      return {kNever, 0};
  }
}

void CalendarQueue::advance() {
  enter();
  ++current_;
  ++advances_;
  const auto lists = static_cast<std::int64_t>(wheel_.size());
  if ((current_ & (lists - 1)) == 0) {
    moved_.swap(beyond_);
    for (const QueuedEvent& entry : moved_)
      if (holds(entry)) place(entry);
    moved_.clear();
  }
  List& list = wheel_[static_cast<std::size_t>(current_ & (lists - 1))];
  for_each_in(list, [&](const QueuedEvent& entry) {
    --in_wheel_;
    if (holds(entry)) heap_.push_back(entry);
  });
  clear(list);
  std::make_heap(heap_.begin(), heap_.end(), kLater);
}

/// Time goes on to the earliest of what lies beyond.
void CalendarQueue::jump() {
  std::erase_if(beyond_, [&](const QueuedEvent& entry) { return !holds(entry); });
  if (!beyond_.empty())
    rebuild(std::min_element(beyond_.begin(), beyond_.end())->time, 1 / per_width_);
}

void CalendarQueue::rebuild(double base, double width) {
  std::ranges::fill(wheel_, List{});
  pieces_.clear();
  free_.clear();
  heap_.clear();
  beyond_.clear();
  entering_.clear();
  in_wheel_ = 0;
  base_ = base;
  per_width_ = 1 / width;
  current_ = 0;
  for (std::uint32_t i = 0; i < time_.size(); ++i) place({time_[i], i});
}

/// The first width, from the times that the bodies begin with: half of them have theirs before the
/// median, and each event places about two entries.
void CalendarQueue::start() {
  is_started_ = true;
  std::vector<double> times;
  for (double time : time_)
    if (time < kNever) times.push_back(time);
  if (times.empty()) return;
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  const double first = *std::min_element(times.begin(), middle + 1);
  const double width = kGoal * (*middle - first) / static_cast<double>(times.size());
  placed_ = advances_ = 0;
  looked_at_ = first;
  if (width > finest_width(*middle)) rebuild(first, width);
}

void CalendarQueue::adapt(double now) {
  const auto placed = static_cast<double>(placed_);
  const double per_stretch = placed / static_cast<double>(std::max<std::size_t>(advances_, 1));
  const double elapsed = now - looked_at_;
  placed_ = advances_ = 0;
  looked_at_ = now;
  if (per_stretch > kGoal / 3 && per_stretch < 3 * kGoal) return;
  const double width = std::max(kGoal * elapsed / placed, finest_width(now));
  if (width > 0) rebuild(now, width);
}

}  // namespace slipcheck
