#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "physics/numbers.h"
#include "reference/events/calendar_queue.h"
#include "reference/events/indexed_heap.h"
#include "reference/events/prefetch.h"

namespace slipcheck {
namespace {

/// The earliest by looking at all of them.
QueuedEvent earliest(const std::vector<double>& times) {
  QueuedEvent first{kNever, 0};
  for (std::uint32_t i = 0; i < times.size(); ++i) {
    const QueuedEvent entry{times[i], i};
    if (entry < first) first = entry;
  }
  return first;
}

/// Sets times at random, as events do, and looks whether the queue finds the same first one.
template <class Queue, class Delay>
void compare_with_search(std::size_t n, std::size_t events, Delay delay) {
  Queue queue(n);
  std::vector<double> times(n, kNever);
  std::mt19937_64 random(7);
  const auto set = [&](std::uint32_t i, double time) {
    times[i] = time;
    queue.set(i, time);
  };
  for (std::uint32_t i = 0; i < n; ++i) set(i, delay(random));
  for (std::size_t k = 0; k < events; ++k) {
    const QueuedEvent expected = earliest(times), found = queue.first();
    ASSERT_EQ(found.time, expected.time) << "event " << k;
    if (expected.time == kNever) return;
    ASSERT_EQ(found.body, expected.body) << "event " << k;
    set(found.body, found.time + delay(random));
    // A partner whose plans change too, to sooner or later.
    set(static_cast<std::uint32_t>(random() % n), found.time + delay(random));
  }
}

template <class Queue>
class EventQueue : public ::testing::Test {};
using Queues = ::testing::Types<HeapQueue, CalendarQueue>;
TYPED_TEST_SUITE(EventQueue, Queues);

TYPED_TEST(EventQueue, ServesTheEarliestOfAll) {
  std::exponential_distribution<double> wait(1);
  for (const std::size_t n : {1, 2, 17, 300})
    compare_with_search<TypeParam>(n, 20'000, [&](auto& random) { return wait(random); });
}

TYPED_TEST(EventQueue, ServesTimesOfVeryDifferentScales) {
  std::uniform_real_distribution<double> exponent(-12, 3);
  compare_with_search<TypeParam>(50, 20'000,
                                 [&](auto& random) { return std::pow(10, exponent(random)); });
}

TYPED_TEST(EventQueue, ServesEqualTimesByNumber) {
  compare_with_search<TypeParam>(40, 5'000, [](auto& random) { return double(random() % 4); });
}

TYPED_TEST(EventQueue, ServesBodiesThatNeverHaveAnEvent) {
  compare_with_search<TypeParam>(30, 2'000, [](auto& random) {
    return random() % 3 == 0 ? kNever : 1e-3 * static_cast<double>(random() % 1000);
  });
}

TYPED_TEST(EventQueue, FollowsARateThatChangesByManyOrders) {
  double scale = 1;
  std::exponential_distribution<double> wait(1);
  compare_with_search<TypeParam>(100, 60'000, [&](auto& random) {
    scale *= 0.9998;  // a collapse: 6e-6 in the end
    return scale * wait(random);
  });
}

/// Entries of many wait for their lists to come into the caches.
TEST(CalendarQueue, ServesManyAsAHeapDoes) {
  constexpr std::uint32_t n = kManyForCaches + 500;
  CalendarQueue calendar(n);
  HeapQueue heap(n);
  std::mt19937_64 random(7);
  double scale = 1;
  std::exponential_distribution<double> wait(1);
  const auto set = [&](std::uint32_t i, double now) {
    const double time = random() % 50 == 0 ? kNever : now + scale * wait(random);
    calendar.set(i, time);
    heap.set(i, time);
  };
  for (std::uint32_t i = 0; i < n; ++i) set(i, 0);
  for (int k = 0; k < 400'000; ++k) {
    const QueuedEvent expected = heap.first(), found = calendar.first();
    ASSERT_EQ(found.time, expected.time) << "event " << k;
    ASSERT_EQ(found.body, expected.body) << "event " << k;
    scale *= 0.99999;
    set(found.body, found.time);
    set(static_cast<std::uint32_t>(random() % n), found.time);
  }
}

}  // namespace
}  // namespace slipcheck
