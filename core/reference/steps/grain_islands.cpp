#include "reference/steps/grain_islands.h"

#include <numeric>

namespace slipcheck {
namespace {

/// Grains of a group: with their pairs some 30 kB.
constexpr std::size_t kGroup = 128;

}  // namespace

std::uint32_t GrainIslands::root(std::uint32_t k) {
  while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
  return k;
}

std::uint32_t GrainIslands::slot_of(std::uint32_t grain) {
  std::uint32_t& slot = slot_[grain];
  if (slot == kNone) {
    slot = static_cast<std::uint32_t>(active_.size());
    active_.push_back(grain);
    parent_.push_back(slot);
  }
  return slot;
}

void GrainIslands::find(std::size_t grains, std::span<const std::uint32_t> first,
                        std::span<const std::uint32_t> second,
                        std::span<const std::uint32_t> near) {
  for (const std::uint32_t grain : active_) slot_[grain] = kNone;
  slot_.resize(grains, kNone);
  active_.clear();
  parent_.clear();
  for (const std::uint32_t k : near) {
    const std::uint32_t a = root(slot_of(first[k])), b = root(slot_of(second[k]));
    // The smaller root wins, so that islands keep the order in which they were met.
    if (a < b)
      parent_[b] = a;
    else
      parent_[a] = b;
  }
  // Count, then place.
  island_.assign(active_.size(), kNone);
  std::uint32_t islands = 0;
  grain_start_.assign(active_.size() + 1, 0);
  pair_start_.assign(active_.size() + 1, 0);
  for (std::uint32_t k = 0; k < active_.size(); ++k) {
    const std::uint32_t r = root(k);
    if (island_[r] == kNone) island_[r] = islands++;
    ++grain_start_[island_[r] + 1];
  }
  for (const std::uint32_t k : near) ++pair_start_[island_[root(slot_[first[k]])] + 1];
  grain_start_.resize(islands + 1);
  pair_start_.resize(islands + 1);
  std::partial_sum(grain_start_.begin(), grain_start_.end(), grain_start_.begin());
  std::partial_sum(pair_start_.begin(), pair_start_.end(), pair_start_.begin());
  grains_.resize(active_.size());
  place_.resize(active_.size());
  next_ = grain_start_;
  for (std::uint32_t k = 0; k < active_.size(); ++k) {
    place_[k] = next_[island_[root(k)]]++;
    grains_[place_[k]] = active_[k];
  }
  pair_place_.resize(near.size());
  next_ = pair_start_;
  for (std::uint32_t p = 0; p < near.size(); ++p)
    pair_place_[p] = next_[island_[root(slot_[first[near[p]]])]]++;
  make_groups();
}

void GrainIslands::make_groups() {
  groups_.clear();
  GrainGroup group;
  for (std::size_t k = 1; k < grain_start_.size(); ++k) {
    group.last_grain = grain_start_[k];
    group.last_pair = pair_start_[k];
    if (group.last_grain - group.first_grain < kGroup && k + 1 < grain_start_.size()) continue;
    groups_.push_back(group);
    group = {group.last_grain, group.last_grain, group.last_pair, group.last_pair};
  }
}

}  // namespace slipcheck
