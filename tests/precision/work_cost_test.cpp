#include "studies/precision/work_cost.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <stdexcept>
#include <string>

#include "studies/precision/pinned_thread.h"

namespace slipcheck {
namespace {

/// Takes these times [s] one after the other, and notes its name when it does.
TimedWork scripted(WorkPrecision& point, std::string& log, char name, std::vector<double> seconds,
                   double steps = 10, double steps_per_second = 1000) {
  return {&point, steps, steps_per_second, [&log, name, seconds, next = 0u]() mutable {
            log += name;
            return seconds.at(next++);
          }};
}

TEST(WorkCost, LeastOfTheRoundsWithTheirSpread) {
  WorkPrecision point;
  std::string log;
  std::vector<TimedWork> works = {scripted(point, log, 'a', {5, 2, 4, 3, 20})};
  time_in_turn(works, 5);
  ASSERT_TRUE(point.cost);
  EXPECT_DOUBLE_EQ(point.cost->per_step, 0.2);
  EXPECT_DOUBLE_EQ(point.cost->per_simulated_second, 200);
  EXPECT_DOUBLE_EQ(point.cost->spread, (4.0 - 2) / 2);
  EXPECT_EQ(point.cost->repeats, 5u);
  EXPECT_EQ(point.reason, "");
}

TEST(WorkCost, AllInTurnInEachRound) {
  std::vector<WorkPrecision> points(3);
  std::string log;
  std::vector<TimedWork> works;
  for (std::size_t k = 0; k < 3; ++k)
    works.push_back(scripted(points[k], log, "abc" [k], { 1, 1, 1 }));
  time_in_turn(works, 3);
  EXPECT_EQ(log, "abcabcabc");
}

TEST(WorkCost, WhatFailsLosesItsOwnCostAlone) {
  std::vector<WorkPrecision> points(3);
  std::string log;
  int tried = 0;
  std::vector<TimedWork> works = {scripted(points[0], log, 'a', {1, 2}),
                                  {&points[1], 1, 1,
                                   [&tried]() -> double {
                                     if (++tried == 2) throw std::runtime_error("hung");
                                     return 1;
                                   }},
                                  scripted(points[2], log, 'c', {3, 4})};
  time_in_turn(works, 2);
  EXPECT_EQ(tried, 2);
  EXPECT_FALSE(points[1].cost);
  EXPECT_EQ(points[1].reason, "not timed: hung");
  EXPECT_DOUBLE_EQ(points[0].cost->per_step, 0.1);
  EXPECT_DOUBLE_EQ(points[2].cost->per_step, 0.3);
}

TEST(WorkCost, StoppedTheyKeepWhatTheyHave) {
  std::vector<WorkPrecision> points(2);
  std::atomic<bool> stop = false;
  int taken = 0;
  const auto once = [&] {
    if (++taken == 3) stop = true;
    return 1.0;
  };
  std::vector<TimedWork> works = {{&points[0], 1, 1, once}, {&points[1], 1, 1, once}};
  time_in_turn(works, 5, &stop);
  EXPECT_EQ(taken, 3);
  EXPECT_EQ(points[0].cost->repeats, 2u);
  EXPECT_EQ(points[1].cost->repeats, 1u);
}

TEST(WorkCost, AThreadIsPinnedAndSetFreeAgain) {
  cpu_set_t before, during, after;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  {
    const PinnedThread pinned;
    if (pinned.core() < 0) GTEST_SKIP() << "the system does not let threads be pinned";
    ASSERT_EQ(sched_getaffinity(0, sizeof during, &during), 0);
    EXPECT_EQ(CPU_COUNT(&during), 1);
    EXPECT_TRUE(CPU_ISSET(pinned.core(), &during));
    EXPECT_EQ(sched_getcpu(), pinned.core());
  }
  ASSERT_EQ(sched_getaffinity(0, sizeof after, &after), 0);
  EXPECT_TRUE(CPU_EQUAL(&before, &after));
}

}  // namespace
}  // namespace slipcheck
