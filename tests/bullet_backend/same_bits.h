#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "physics/frame.h"

namespace slipcheck {

/// Two runs are the same bit for bit, frame by frame.
inline void expect_same_bits(const std::vector<Frame>& a, const std::vector<Frame>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); ++n) {
    ASSERT_EQ(a[n].part, b[n].part) << "frame " << n;
    ASSERT_EQ(a[n].bodies.size(), b[n].bodies.size());
    const std::size_t bytes = a[n].bodies.size() * sizeof(BodyState);
    ASSERT_EQ(std::memcmp(a[n].bodies.data(), b[n].bodies.data(), bytes), 0) << "frame " << n;
    ASSERT_EQ(a[n].touches.size(), b[n].touches.size()) << "frame " << n;
    for (std::size_t k = 0; k < a[n].touches.size(); ++k)
      ASSERT_EQ(a[n].touches[k].normal_impulse, b[n].touches[k].normal_impulse) << "frame " << n;
  }
}

}  // namespace slipcheck
