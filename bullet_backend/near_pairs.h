#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "bullet_backend/periodic_cell.h"

namespace slipcheck::bullet {

/// Pairs of balls that are near each other along the first axis of a cell, with images across its
/// edges: sorted, and gone through once.
class NearPairs {
 public:
  explicit NearPairs(const PeriodicCell& cell) : cell_(&cell) {}

  void clear() { ways_.clear(); }
  /// Where a ball is, from `place` on its way by `way`, with its radius.
  void add(const Vector3& place, const Vector3& way, double radius) {
    const double from = cell_->folded(place, 0);
    const double then = cell_->folded(place + way, 0), length = cell_->length(0);
    // Folded, the end of the way may be at the other side.
    const double to = length > 0 ? then - std::round((then - from) / length) * length : then;
    ways_.push_back({std::min(from, to) - radius, std::max(from, to) + radius, ways_.size()});
  }

  /// f(i, j) for each pair of those added, in the order in which they were, i != j.
  template <class F>
  void for_each(const F& f) {
    std::ranges::sort(ways_, {}, &Way::low);
    const double length = cell_->length(0);
    for (std::size_t k = 0; k < ways_.size(); ++k) {
      for (std::size_t l = k + 1; l < ways_.size() && ways_[l].low <= ways_[k].high; ++l)
        f(ways_[k].body, ways_[l].body);
      if (length == 0) continue;
      for (std::size_t l = 0; l < k && ways_[l].low + length <= ways_[k].high; ++l)
        f(ways_[k].body, ways_[l].body);
    }
  }

 private:
  struct Way {
    double low, high;  // along the axis
    std::size_t body;
  };
  const PeriodicCell* cell_;
  std::vector<Way> ways_;
};

}  // namespace slipcheck::bullet
