#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/steps/grain_kernels.h"

namespace slipcheck {

/// Sorts near pairs into islands, which share no grain, and those into groups of about so many
/// grains as the nearest cache holds.
class GrainIslands {
 public:
  /// `near` are indices into first and second, which tell grains below `grains`.
  void find(std::size_t grains, std::span<const std::uint32_t> first,
            std::span<const std::uint32_t> second, std::span<const std::uint32_t> near);

  const std::vector<std::uint32_t>& grains() const { return grains_; }  ///< island by island
  /// Of each of `near`: its place, island by island.
  const std::vector<std::uint32_t>& pair_place() const { return pair_place_; }
  /// Of a grain in grains(): its place there.
  std::uint32_t place(std::uint32_t grain) const { return place_[slot_[grain]]; }
  const std::vector<GrainGroup>& groups() const { return groups_; }

 private:
  std::uint32_t root(std::uint32_t k);
  std::uint32_t slot_of(std::uint32_t grain);
  void make_groups();

  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<std::uint32_t> slot_;    ///< of each grain, kNone where it is in no pair
  std::vector<std::uint32_t> active_;  ///< grain of each slot
  std::vector<std::uint32_t> parent_;  ///< of each slot
  std::vector<std::uint32_t> island_;  ///< of each root
  std::vector<std::uint32_t> grain_start_, pair_start_, next_;
  std::vector<std::uint32_t> grains_, place_, pair_place_;
  std::vector<GrainGroup> groups_;
};

}  // namespace slipcheck
