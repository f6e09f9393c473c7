#include "harness/observe/observables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "physics/frame.h"

namespace slipcheck {
namespace {

/// Each place once, and their names as a map has them: also where one body's name begins another's,
/// or that of a pair.
TEST(Observables, ComeInTheOrderOfTheirNames) {
  const std::vector<std::string> names = {"b", "a", "a-c", "all2", "Z", "a1", "plate"};
  Observables seen;
  seen.bodies.resize(6);
  seen.pairs = {{.first = 0, .second = 1},
                {.first = 1, .second = kSubstrate},
                {.first = 1, .second = 2},
                {.first = 2, .second = surface_touch(0)}};
  std::vector<std::size_t> order = order_of_names(seen, names);
  std::vector<std::string> texts;
  for (const std::size_t k : order) texts.push_back(value_name(seen, names, k));
  EXPECT_TRUE(std::ranges::is_sorted(texts));
  EXPECT_EQ(std::ranges::adjacent_find(texts), texts.end());
  std::ranges::sort(order);
  std::vector<std::size_t> all(flat_values(seen).size());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(order, all);
}

}  // namespace
}  // namespace slipcheck
