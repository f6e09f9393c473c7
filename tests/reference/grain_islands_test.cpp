#include "reference/steps/grain_islands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace slipcheck {
namespace {

constexpr std::uint32_t kGrains = 400;

struct Pairs {
  std::uint32_t grains;
  std::vector<std::uint32_t> first, second, near;
};

/// A list of pairs, by the first, some of which are near. reach: between the numbers of the two.
Pairs random_pairs(std::mt19937& dice, std::uint32_t grains, std::uint32_t reach) {
  std::uniform_real_distribution<double> unit(0, 1);
  Pairs pairs{grains, {}, {}, {}};
  for (std::uint32_t i = 0; i + 1 < grains; ++i)
    for (std::uint32_t j = i + 1; j < std::min(grains, i + 1 + reach); ++j) {
      if (unit(dice) * reach > 2) continue;
      if (unit(dice) < 0.35) pairs.near.push_back(static_cast<std::uint32_t>(pairs.first.size()));
      pairs.first.push_back(i);
      pairs.second.push_back(j);
    }
  return pairs;
}

/// The least grain of each grain's island, by following pairs until nothing changes.
std::vector<std::uint32_t> least_of_island(const Pairs& pairs) {
  std::vector<std::uint32_t> least(pairs.grains);
  for (std::uint32_t i = 0; i < pairs.grains; ++i) least[i] = i;
  for (bool changes = true; changes;) {
    changes = false;
    for (const std::uint32_t k : pairs.near) {
      std::uint32_t &a = least[pairs.first[k]], &b = least[pairs.second[k]];
      changes = changes || a != b;
      a = b = std::min(a, b);
    }
  }
  return least;
}

/// Checks all that is told of the pairs. Returns how many islands were hit.
std::size_t expect_islands(const GrainIslands& islands, const Pairs& pairs,
                           const std::vector<std::uint32_t>& hit, std::size_t threads) {
  const std::vector<std::uint32_t> least = least_of_island(pairs);
  std::set<std::uint32_t> hit_islands, grains;
  for (const std::uint32_t grain : hit) hit_islands.insert(least[grain]);
  std::map<std::uint32_t, std::vector<std::uint32_t>> expected;  // pairs by island
  for (const std::uint32_t k : pairs.near) {
    if (!hit_islands.contains(least[pairs.first[k]])) continue;
    expected[least[pairs.first[k]]].push_back(k);
    grains.insert({pairs.first[k], pairs.second[k]});
  }
  EXPECT_EQ(islands.grain_count(), grains.size());
  std::map<std::uint32_t, std::vector<std::uint32_t>> found;
  std::map<std::uint32_t, std::size_t> group_of;
  std::map<std::uint32_t, std::size_t> place_of;  // of grains among all groups
  std::size_t told = 0, group = 0;
  std::size_t before = 0;
  // Few are in groups of equal size, as many for each thread as have a place in its nearest cache.
  const std::size_t for_each = grains.size() / (threads * 128) + 1;
  const bool are_few = threads > 1 && for_each <= 4;
  // Of not too many each has pages of its own, and none has a line of the cache with another one.
  const std::size_t apart = grains.size() <= 8192 ? 520 : 16;
  if (are_few) {
    EXPECT_LE(islands.groups().size(), threads * for_each);
  }
  for (const GrainIslandGroup& each : islands.groups()) {
    EXPECT_TRUE(threads == 1 ? each.first == before : each.first % apart == 0);
    if (are_few && group + 1 < islands.groups().size()) {
      EXPECT_GE(each.grains.size() * threads * for_each, grains.size());
    }
    EXPECT_GE(each.first, before);
    std::uint32_t index = 0;
    for (const std::uint32_t grain : each.grains) {
      EXPECT_TRUE(grains.contains(grain));
      place_of[grain] = each.first + index;
      EXPECT_EQ(islands.place(grain) + each.shift, index++);
      EXPECT_EQ(group_of.try_emplace(least[grain], group).first->second, group);
      ++told;
    }
    before = each.first + each.grains.size() + 1;  // a place is left for walls
    for (const std::uint32_t k : each.pairs) {
      found[least[pairs.first[k]]].push_back(k);
      EXPECT_EQ(group_of.at(least[pairs.first[k]]), group);
    }
    ++group;
  }
  EXPECT_EQ(told, grains.size());
  for (const GrainIslandPart& part : islands.parts()) {
    const std::size_t begin = pairs.grains * part.stretch / threads;
    const std::size_t end = pairs.grains * (part.stretch + 1) / threads;
    for (std::size_t k = 0; k < part.grains.size(); ++k, --told) {
      const std::uint32_t grain = part.grains[k];
      EXPECT_EQ(place_of.at(grain), part.first + k);
      EXPECT_TRUE(part.stretch == threads || (begin <= grain && grain < end));
    }
  }
  EXPECT_EQ(told, 0u);
  EXPECT_GE(islands.grain_places(), before);
  EXPECT_TRUE(threads == 1 ? islands.grain_places() == before
                           : islands.grain_places() % apart == 0);
  EXPECT_EQ(found, expected);  // of each island in the order of the list
  return expected.size();
}

/// Those of first … last − 1 among numbers in ascending order.
std::vector<std::uint32_t> from_to(const std::vector<std::uint32_t>& numbers, std::size_t first,
                                   std::size_t last) {
  return {std::ranges::lower_bound(numbers, first), std::ranges::lower_bound(numbers, last)};
}

/// Looks for islands among so many grains, that many times; returns how many are hit.
std::size_t find_islands(std::size_t threads, std::uint32_t grains, int turns) {
  std::mt19937 dice(9);
  ThreadTeam team(threads);
  GrainIslands islands;
  std::size_t count = 0;
  for (int turn = 0; turn < turns; ++turn) {
    const Pairs pairs = random_pairs(dice, grains, turn % 3 == 0 ? 300 : 5);
    std::vector<std::uint32_t> hit, met, touching;
    for (const std::uint32_t k : pairs.near) {
      if (dice() % 8 != 0) continue;
      hit.push_back(pairs.first[k]);
      (dice() % 2 == 0 ? touching : met).push_back(k);
    }
    for (std::uint32_t& k : touching) k = pairs.first[k];
    const auto look = [&](std::size_t first, std::size_t last, GrainNear& found) {
      found.near = from_to(pairs.near, first, last);
      found.hit = from_to(met, first, last);
      for (std::uint32_t& k : found.hit) k = pairs.first[k];
    };
    islands.find(grains, {pairs.first, pairs.second}, touching, look, team);
    count += expect_islands(islands, pairs, hit, threads);
    if (::testing::Test::HasFailure()) {
      ADD_FAILURE() << "threads: " << threads << ", grains: " << grains << ", turn " << turn;
      break;
    }
  }
  return count;
}

/// Islands within the stretches that threads have, over one edge of these and over all of them;
/// few, and so many that their groups have no pages of their own.
TEST(GrainIslands, AreThoseOfFollowingPairs) {
  for (const std::size_t threads : {1, 2, 3, 8}) {
    EXPECT_GT(find_islands(threads, kGrains, 30), 300u);
    EXPECT_GT(find_islands(threads, 20'000, 3), 300u);
  }
}

TEST(GrainIslands, WithoutPairsThereAreNone) {
  for (const std::size_t threads : {1, 3}) {
    ThreadTeam team(threads);
    GrainIslands islands;
    const auto look = [](std::size_t first, std::size_t last, GrainNear&) {
      EXPECT_EQ(first, last);
    };
    islands.find(kGrains, {}, {}, look, team);
    EXPECT_TRUE(islands.groups().empty());
    EXPECT_EQ(islands.grain_count(), 0u);
  }
}

}  // namespace
}  // namespace slipcheck
