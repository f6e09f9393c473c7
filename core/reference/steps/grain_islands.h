#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/thread_team.h"
#include "reference/steps/grain_kernels.h"

namespace slipcheck {

/// Near pairs, as indices into those of a list, in its order.
struct GrainNear {
  std::span<const std::uint32_t> first, second;  ///< of the list, by its first grain
  std::span<const std::uint32_t> near;
};

/// Sorts near pairs into islands, which share no grain, and those into groups of about so many
/// grains as the nearest cache holds, or fewer where threads share them. Islands of which no grain
/// is hit are left out: all of them go on as if alone.
///
/// Each thread sorts the islands of a stretch of grains; those that reach from one to another are
/// sorted then. So the order of the islands, and nothing else, depends on the number of threads.
class GrainIslands {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  /// Of `grains` grains. hit: of each pair that touches or is to meet unless others intervene, one
  /// grain.
  void find(std::size_t grains, const GrainNear& pairs, std::span<const std::uint32_t> hit,
            ThreadTeam& team);

  /// Island by island; kNone between groups.
  const std::vector<std::uint32_t>& grains() const { return grains_; }
  std::size_t grain_count() const;
  /// Those that are near, island by island.
  const std::vector<std::uint32_t>& pairs() const { return pairs_; }
  /// Of a grain in grains(): its place there.
  std::uint32_t place(std::uint32_t grain) const { return place_[grain]; }
  const std::vector<GrainGroup>& groups() const { return groups_; }

 private:
  /// Grains first … last − 1.
  struct Stretch {
    std::size_t first, last;
    bool has(std::uint32_t grain) const { return first <= grain && grain < last; }
  };
  /// The islands of a stretch, or those between stretches.
  struct Share {
    std::vector<std::uint32_t> across;        ///< pairs with a grain of another stretch
    std::vector<std::uint32_t> reached, hit;  ///< pairs and hit grains of islands that have such
    std::vector<std::uint32_t> met, kept;     ///< its grains and pairs, in the order of the pairs
    std::vector<std::uint32_t> grain_start, pair_start, next;  ///< by island
    std::vector<std::uint32_t> placed;                         ///< where an island's grains begin
    std::size_t first_pair = 0;
  };

  std::uint32_t root(std::uint32_t grain);
  void join(std::uint32_t a, std::uint32_t b);
  void part(std::uint32_t grain);
  void forget(Share& share);
  void join_within(const GrainNear& pairs, const Stretch& own, Share& share);
  void sort_within(const GrainNear& pairs, std::span<const std::uint32_t> hit, const Stretch& own,
                   Share& share);
  void sort_between(const GrainNear& pairs);
  void count(const GrainNear& pairs, Share& share);
  void make_groups(std::size_t threads);
  void place(const GrainNear& pairs, Share& share);

  static constexpr std::uint32_t kHit = kNone - 1, kReached = kNone - 2;
  // Of each grain of the scene; between two calls it is its own parent, in no island.
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint32_t> island_;  ///< of a root; kHit or kReached before it has a number
  std::vector<std::uint32_t> place_;
  std::vector<Share> shares_;  ///< by thread; the last: between these
  std::vector<std::uint32_t> grains_, pairs_;
  std::vector<GrainGroup> groups_;
};

}  // namespace slipcheck
