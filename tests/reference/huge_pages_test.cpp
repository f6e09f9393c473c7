#include "reference/events/huge_pages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <numeric>
#include <vector>

namespace slipcheck {
namespace {

constexpr std::size_t kPage = std::size_t{1} << 21;

/// From small to large blocks and back, as vectors grow and shrink.
TEST(HugePages, KeepWhatAVectorHolds) {
  std::vector<std::uint32_t, HugePages<std::uint32_t>> numbers;
  for (std::uint32_t i = 0; i < 3'000'000; ++i) numbers.push_back(i);
  std::vector<std::uint32_t> expected(numbers.size());
  std::iota(expected.begin(), expected.end(), 0u);
  EXPECT_TRUE(std::equal(numbers.begin(), numbers.end(), expected.begin()));
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(numbers.data()) % kPage, 0u);
  numbers.resize(10);
  numbers.shrink_to_fit();
  EXPECT_EQ(numbers.back(), 9u);
}

TEST(HugePages, TooMuchIsRefused) {
  HugePages<double> pages;
  EXPECT_THROW(static_cast<void>(pages.allocate(std::numeric_limits<std::size_t>::max() / 8)),
               std::bad_array_new_length);
}

}  // namespace
}  // namespace slipcheck
