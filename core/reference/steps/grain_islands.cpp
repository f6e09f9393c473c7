#include "reference/steps/grain_islands.h"

#include <algorithm>
#include <numeric>

namespace slipcheck {
namespace {

/// Grains of a group: with their pairs some 30 kB.
constexpr std::size_t kGroup = 128;
/// Where threads share them: groups for each thread, of at least so many grains, and what of a
/// group's numbers begins lines of the cache that no other thread writes.
constexpr std::size_t kForThread = 8, kSmallGroup = 16, kApart = 16;

}  // namespace

std::uint32_t GrainIslands::root(std::uint32_t grain) {
  while (parent_[grain] != grain) grain = parent_[grain] = parent_[parent_[grain]];
  return grain;
}

void GrainIslands::join(std::uint32_t a, std::uint32_t b) {
  a = root(a);
  b = root(b);
  parent_[std::max(a, b)] = std::min(a, b);
}

void GrainIslands::find(std::size_t grains, std::span<const std::uint32_t> first,
                        std::span<const std::uint32_t> second, std::span<const std::uint32_t> near,
                        std::span<const std::uint32_t> hit, std::size_t threads) {
  forget();
  while (parent_.size() < grains) parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
  island_.resize(grains, kNone);
  place_.resize(grains, kNone);
  for (const std::uint32_t k : near) join(first[k], second[k]);
  for (const std::uint32_t grain : hit) island_[root(grain)] = kHit;
  for (const std::uint32_t k : near) {
    if (island_[root(first[k])] == kHit)
      kept_.push_back(k);
    else
      parent_[first[k]] = first[k], parent_[second[k]] = second[k];
  }
  // Number and count, then place.
  grain_start_.assign(1, 0);
  pair_start_.assign(1, 0);
  for (const std::uint32_t k : kept_) {
    std::uint32_t& island = island_[root(first[k])];
    if (island == kHit) {
      island = static_cast<std::uint32_t>(grain_start_.size() - 1);
      grain_start_.push_back(0);
      pair_start_.push_back(0);
    }
    ++pair_start_[island + 1];
    for (const std::uint32_t grain : {first[k], second[k]}) {
      if (place_[grain] != kNone) continue;
      place_[grain] = island;
      met_.push_back(grain);
      ++grain_start_[island + 1];
    }
  }
  std::partial_sum(grain_start_.begin(), grain_start_.end(), grain_start_.begin());
  std::partial_sum(pair_start_.begin(), pair_start_.end(), pair_start_.begin());
  pairs_.resize(kept_.size());
  next_ = pair_start_;
  for (const std::uint32_t k : kept_) pairs_[next_[place_[first[k]]]++] = k;
  make_groups(threads);
  for (const std::uint32_t grain : met_) {
    place_[grain] = next_[place_[grain]]++;
    grains_[place_[grain]] = grain;
  }
}

void GrainIslands::forget() {
  for (const std::uint32_t grain : met_) {
    parent_[grain] = grain;
    island_[grain] = place_[grain] = kNone;
  }
  met_.clear();
  kept_.clear();
}

void GrainIslands::make_groups(std::size_t threads) {
  const bool shared = threads > 1;
  const std::size_t grains =
      shared ? std::clamp(met_.size() / (kForThread * threads), kSmallGroup, kGroup) : kGroup;
  groups_.clear();
  next_.clear();  // where the grains of each island begin
  GrainGroup group;
  std::uint32_t moved = 0;  // by what lies between groups
  for (std::size_t k = 1; k < grain_start_.size(); ++k) {
    next_.push_back(grain_start_[k - 1] + moved);
    group.last_grain = grain_start_[k] + moved;
    group.last_pair = pair_start_[k];
    if (group.last_grain - group.first_grain < grains && k + 1 < grain_start_.size()) continue;
    groups_.push_back(group);
    if (shared) moved += static_cast<std::uint32_t>(-group.last_grain % kApart);
    group = {grain_start_[k] + moved, grain_start_[k] + moved, group.last_pair, group.last_pair};
  }
  grains_.assign(met_.size() + moved, kNone);
}

}  // namespace slipcheck
