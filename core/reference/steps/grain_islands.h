#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/thread_team.h"
#include "reference/steps/grain_kernels.h"

namespace slipcheck {

/// The grains of the pairs of a list, which is in the order of the first.
struct GrainPairs {
  std::span<const std::uint32_t> first, second;
};

/// What there is between grains for some steps.
struct GrainNear {
  std::vector<std::uint32_t> near;  ///< indices of a list's near pairs, in its order
  std::vector<std::uint32_t> hit;   ///< of each near pair that is to meet, its first grain
};

/// Islands whose steps are done at once.
struct GrainIslandGroup {
  std::span<const std::uint32_t> grains;
  std::span<const std::uint32_t> pairs;  ///< near ones, island by island
  std::size_t first = 0;  ///< place among all groups; behind each is one for what stands for walls
  std::uint32_t shift = 0;  ///< from GrainIslands::place() to indices of `grains`
};

/// Grains of a group that are of one stretch, or of islands between stretches.
struct GrainIslandPart {
  std::span<const std::uint32_t> grains;
  std::size_t first = 0;    ///< place among all groups
  std::size_t stretch = 0;  ///< that of the thread of this number; the number of threads: between
};

/// Sorts near pairs into islands, which share no grain, and those into groups of about so many
/// grains as the nearest cache holds, or fewer where threads share few. Islands of which no grain
/// is hit are left out: all of them go on as if alone.
///
/// Each thread looks at the pairs and sorts the islands of a stretch of grains; those that reach
/// from one to another are sorted then. So the order of the islands, and nothing else, depends on
/// the number of threads.
class GrainIslands {
 public:
  /// Tells of the listed pairs first … last − 1; called on several threads at once.
  using Look = std::function<void(std::size_t first, std::size_t last, GrainNear& found)>;

  /// Of `grains` grains. hit: those that are hit whatever `look` tells.
  void find(std::size_t grains, const GrainPairs& listed, std::span<const std::uint32_t> hit,
            const Look& look, ThreadTeam& team);

  /// Valid until the next find().
  const std::vector<GrainIslandGroup>& groups() const { return groups_; }
  /// Of the groups, one by one.
  const std::vector<GrainIslandPart>& parts() const { return parts_; }
  /// Of a grain of a group, to be shifted.
  std::uint32_t place(std::uint32_t grain) const { return place_[grain]; }
  std::size_t grain_count() const;
  /// Of all groups, and what lies between and behind them.
  std::size_t grain_places() const { return grain_places_; }

 private:
  /// The islands of a stretch, or those between stretches.
  struct alignas(64) Share {
    GrainNear found;
    std::vector<std::uint32_t> across;        ///< pairs with a grain of another stretch
    std::vector<std::uint32_t> reached, hit;  ///< pairs and hit grains of islands that have such
    std::vector<std::uint32_t> met, kept;     ///< its grains and pairs, in the order of the pairs
    std::vector<std::uint32_t> grain_start, pair_start, next;  ///< by island
    std::vector<std::uint32_t> grains, pairs;                  ///< island by island
  };
  /// Islands first … last − 1 of a share.
  struct Piece {
    std::size_t stretch, first, last;
  };

  std::uint32_t root(std::uint32_t grain);
  void join(std::uint32_t a, std::uint32_t b);
  void part(std::uint32_t grain);
  void forget(Share& share);
  void join_within(const GrainPairs& pairs, const GrainStretch& own, Share& share);
  void sort_within(const GrainPairs& pairs, std::span<const std::uint32_t> hit,
                   const GrainStretch& own, Share& share);
  void sort_between(const GrainPairs& pairs);
  void count(const GrainPairs& pairs, Share& share);
  void place(const GrainPairs& pairs, Share& share);
  void make_groups(std::size_t threads);
  void reserve_joined(std::size_t grains);
  void take(const Piece& piece, std::size_t before);
  void join(std::span<const Piece> pieces, std::size_t before);
  std::span<const std::uint32_t> grains_of(const Piece& piece) const;
  std::span<const std::uint32_t> pairs_of(const Piece& piece) const;

  static constexpr std::uint32_t kNone = ~std::uint32_t{0}, kHit = kNone - 1, kReached = kNone - 2;
  // Of each grain of the scene; between two calls it is its own parent, in no island.
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint32_t> island_;  ///< of a root; kHit or kReached before it has a number
  std::vector<std::uint32_t> place_;   ///< in Share::grains or its group; while counted its island
  std::vector<Share> shares_;          ///< by thread; the last: between these
  std::vector<GrainIslandGroup> groups_;
  std::size_t grain_places_ = 0;
  std::vector<GrainIslandPart> parts_;
  std::vector<Piece> pieces_;                                ///< of the group that is made
  std::vector<std::uint32_t> joined_grains_, joined_pairs_;  ///< of groups of several shares
};

}  // namespace slipcheck
