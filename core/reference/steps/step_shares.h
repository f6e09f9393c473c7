#pragma once

#include <algorithm>
#include <cstddef>
#include <ranges>
#include <vector>

#include "reference/steps/step_contact.h"
#include "reference/steps/step_neighbours.h"

namespace slipcheck {

/// One thread's part of a step over StepNeighbours: bodies stored one behind the other, and the
/// pairs whose further body is among them.
struct alignas(64) StepShare {
  std::size_t number = 0;
  std::size_t bodies = 0, pairs = 0;  ///< where they begin
  StepTally tally;
  double longest2 = 0;  ///< way in the last step, squared [m²]
};

/// One for each thread of the neighbours' team.
class StepShares {
 public:
  /// Such that each has as many bodies and pairs.
  void divide(StepNeighbours& neighbours, std::size_t bodies) {
    const std::vector<StepNeighbour>& all = neighbours.all();
    const auto pairs_before = [&](std::size_t stored) {
      return static_cast<std::size_t>(
          std::ranges::lower_bound(all, stored, {}, &StepNeighbour::further) - all.begin());
    };
    const std::size_t shares = neighbours.team().size();
    bodies_ = bodies;
    shares_.resize(shares);
    for (std::size_t s = 0; s < shares; ++s) {
      const std::size_t work = (bodies + all.size()) * s / shares;
      const auto stored = std::views::iota(std::size_t{0}, bodies);
      shares_[s].bodies = static_cast<std::size_t>(
          std::ranges::partition_point(stored,
                                       [&](std::size_t k) { return k + pairs_before(k) < work; }) -
          stored.begin());
      shares_[s].pairs = pairs_before(shares_[s].bodies);
      shares_[s].number = s;
    }
  }

  const std::vector<StepShare>& all() const { return shares_; }

  /// Calls work(share, begin, end) with the bodies of each: always the same thread with the same
  /// share, in whose caches it is.
  template <class Work>
  void run(ThreadTeam& team, const Work& work) {
    team.run(shares_.size(), [&](std::size_t s) {
      const bool is_last = s + 1 == shares_.size();
      work(shares_[s], shares_[s].bodies, is_last ? bodies_ : shares_[s + 1].bodies);
    });
  }

 private:
  std::vector<StepShare> shares_;
  std::size_t bodies_ = 0;
};

}  // namespace slipcheck
