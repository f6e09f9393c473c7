#include "base/thread_team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace slipcheck {
namespace {

/// That run(team, count, times) counts each of 0 … count − 1 once, whatever the number of threads.
template <class Run>
void expect_each_once(Run&& run) {
  for (const std::size_t threads : {1, 2, 3, 8}) {
    ThreadTeam team(threads);
    for (const std::size_t count : {0, 1, 2, 7, 8, 500}) {
      std::vector<std::atomic<int>> times(count);
      run(team, count, times);
      for (std::size_t k = 0; k < count; ++k)
        ASSERT_EQ(times[k], 1) << k << " of " << count << ", threads: " << threads;
    }
  }
}

TEST(ThreadTeam, DoesEachWorkOnce) {
  expect_each_once([](ThreadTeam& team, std::size_t count, std::vector<std::atomic<int>>& times) {
    team.run(count, [&](std::size_t k) { ++times[k]; });
  });
}

TEST(ThreadTeam, SharesAreSideBySide) {
  expect_each_once([](ThreadTeam& team, std::size_t count, std::vector<std::atomic<int>>& times) {
    team.run_shares(count, [&](std::size_t own, std::size_t first, std::size_t last) {
      EXPECT_EQ(team.share_of(count, own), std::pair(first, last));
      for (std::size_t k = first; k < last; ++k) ++times[k];
    });
  });
}

TEST(ThreadTeam, OwnFirstIsEachWorkOnce) {
  expect_each_once([](ThreadTeam& team, std::size_t count, std::vector<std::atomic<int>>& times) {
    team.run_own_first(count, [&](std::size_t own, std::size_t k) {
      EXPECT_LT(own, team.size());
      ++times[k];
    });
  });
}

/// The first work lasts until all others are done, those behind it in its thread's share too.
TEST(ThreadTeam, WhoIsDoneTakesWhatIsLeftOfOthers) {
  ThreadTeam team(2);
  ASSERT_EQ(team.size(), 2u);
  constexpr std::size_t kCount = 10;
  std::atomic<std::size_t> done = 0, long_one = 2;
  bool all_done = false;
  team.run_own_first(kCount, [&](std::size_t own, std::size_t k) {
    if (k > 0) {
      EXPECT_NE(own, long_one);
      ++done;
      return;
    }
    long_one = own;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (done + 1 < kCount && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    all_done = done + 1 == kCount;
  });
  EXPECT_TRUE(all_done);
}

/// Another round begins where one failed.
TEST(ThreadTeam, ThrowsOnWhatWorkThrows) {
  for (const std::size_t threads : {1, 3}) {
    ThreadTeam team(threads);
    EXPECT_THROW(team.run_own_first(100,
                                    [](std::size_t, std::size_t k) {
                                      if (k == 50) throw std::runtime_error("fifty");
                                    }),
                 std::runtime_error);
    std::atomic<int> times = 0;
    team.run_own_first(100, [&](std::size_t, std::size_t) { ++times; });
    EXPECT_EQ(times, 100);
  }
}

}  // namespace
}  // namespace slipcheck
