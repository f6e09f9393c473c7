#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/steps/grain_kernels.h"

namespace slipcheck {

/// Sorts near pairs into islands, which share no grain, and those into groups of about so many
/// grains as the nearest cache holds, or fewer where threads share them. Islands of which no grain
/// is hit are left out: all of them go on as if alone.
class GrainIslands {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  /// `near` are indices into first and second, which tell grains below `grains`. hit: of each pair
  /// that touches or is to meet unless others intervene, one grain.
  void find(std::size_t grains, std::span<const std::uint32_t> first,
            std::span<const std::uint32_t> second, std::span<const std::uint32_t> near,
            std::span<const std::uint32_t> hit, std::size_t threads);

  /// Island by island; kNone between groups.
  const std::vector<std::uint32_t>& grains() const { return grains_; }
  std::size_t grain_count() const { return met_.size(); }
  /// Those of `near`, island by island.
  const std::vector<std::uint32_t>& pairs() const { return pairs_; }
  /// Of a grain in grains(): its place there.
  std::uint32_t place(std::uint32_t grain) const { return place_[grain]; }
  const std::vector<GrainGroup>& groups() const { return groups_; }

 private:
  std::uint32_t root(std::uint32_t grain);
  void join(std::uint32_t a, std::uint32_t b);
  void forget();
  void make_groups(std::size_t threads);

  static constexpr std::uint32_t kHit = kNone - 1;
  // Of each grain of the scene; between two calls it is its own parent, in no island.
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint32_t> island_;  ///< of a root; kHit before it has a number
  std::vector<std::uint32_t> place_;
  std::vector<std::uint32_t> met_, kept_;  ///< grains and pairs in the order of the pairs
  std::vector<std::uint32_t> grain_start_, pair_start_, next_;
  std::vector<std::uint32_t> grains_, pairs_;
  std::vector<GrainGroup> groups_;
};

}  // namespace slipcheck
