#include "reference/piles/pile_waves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace slipcheck {
namespace {

/// What has come of slabs that pass so many steps, looked at in each call.
class Watched {
 public:
  Watched(std::size_t slabs, bool is_around)
      : slabs_(slabs), is_around_(is_around), acted_(slabs), done_(slabs) {}

  void act(std::size_t s, std::size_t j) {
    EXPECT_EQ(acted_[s], j);
    EXPECT_EQ(done_[s], j);
    EXPECT_EQ(done_[after(s)], j);
    // Even lists come before the odd ones beside them.
    if (s % 2 == 1) {
      EXPECT_EQ(acted_[s - 1], j + 1);
      if (after(s) != s) {
        EXPECT_EQ(acted_[after(s)], j + 1);
      }
    }
    ++acted_[s];
  }
  void done(std::size_t s, std::size_t j) {
    EXPECT_EQ(done_[s], j);
    EXPECT_EQ(acted_[s], j + 1);
    if (s > 0 || is_around_) {
      EXPECT_EQ(acted_[(s + slabs_ - 1) % slabs_], j + 1);
    }
    ++done_[s];
  }
  bool have_all(std::size_t steps) const {
    const auto is_all = [&](std::size_t each) { return each == steps; };
    return std::ranges::all_of(acted_, is_all) && std::ranges::all_of(done_, is_all);
  }

 private:
  std::size_t after(std::size_t s) const {
    return is_around_ ? (s + 1) % slabs_ : std::min(s + 1, slabs_ - 1);
  }

  std::size_t slabs_;
  bool is_around_;
  std::vector<std::size_t> acted_, done_;
};

/// What a list and a slab wait for has been, whichever block of those that may run at once does.
TEST(PileWaves, PassEachSlabInOrder) {
  std::mt19937 random(1);
  for (const bool is_around : {false, true})
    for (std::size_t slabs = 1; slabs <= 70; ++slabs)
      for (const std::size_t threads : {1, 2, 3, 8}) {
        if (is_around && (slabs < 4 || slabs % 2 == 1)) continue;
        const PileWaves waves(slabs, is_around, threads);
        for (std::size_t steps = 1; steps <= waves.most_steps(); ++steps) {
          SCOPED_TRACE(testing::Message() << slabs << " slabs " << is_around << ", " << threads
                                          << " threads, " << steps << " steps");
          Watched watched(slabs, is_around);
          const auto in_any_order = [&](std::size_t count, const auto& work) {
            std::vector<std::size_t> order(count);
            std::iota(order.begin(), order.end(), 0);
            std::ranges::shuffle(order, random);
            for (const std::size_t k : order) work(k);
          };
          waves.run(
              in_any_order, steps, [&](std::size_t s, std::size_t j) { watched.act(s, j); },
              [&](std::size_t s, std::size_t j) { watched.done(s, j); });
          ASSERT_TRUE(watched.have_all(steps));
        }
      }
}

/// Of many slabs several steps are taken at once, on one thread and on two.
TEST(PileWaves, TakeSeveralSteps) {
  EXPECT_EQ(PileWaves(1, false, 1).most_steps(), 1u);
  EXPECT_GE(PileWaves(64, false, 1).most_steps(), 4u);
  EXPECT_GE(PileWaves(64, true, 1).most_steps(), 4u);
  EXPECT_GE(PileWaves(64, false, 2).most_steps(), 4u);
  EXPECT_GE(PileWaves(64, true, 2).most_steps(), 4u);
}

/// Blocks that run at once meet in no slab.
TEST(PileWaves, ShareNoSlabBetweenBlocks) {
  for (const bool is_around : {false, true})
    for (std::size_t slabs = 4; slabs <= 70; slabs += 2) {
      const PileWaves waves(slabs, is_around, 3);
      std::vector<std::size_t> owner;
      std::size_t block = 0;
      const auto own = [&](std::size_t s) {
        EXPECT_TRUE(owner[s] == 0 || owner[s] == block) << slabs << ' ' << s;
        owner[s] = block;
      };
      waves.run(
          [&](std::size_t count, const auto& work) {
            owner.assign(slabs, 0);
            for (std::size_t k = 0; k < count; ++k) {
              block = k + 1;
              work(k);
            }
          },
          waves.most_steps(),
          [&](std::size_t s, std::size_t) {
            own(s);
            if (is_around || s + 1 < slabs) own((s + 1) % slabs);
          },
          [&](std::size_t s, std::size_t) { own(s); });
    }
}

}  // namespace
}  // namespace slipcheck
