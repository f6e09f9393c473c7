#include "reference/steps/grain_islands.h"

#include <algorithm>
#include <numeric>

namespace slipcheck {
namespace {

/// Grains of a group: with their pairs some 30 kB.
constexpr std::size_t kGroup = 128;
/// Where threads share them each begins at a multiple of kApart, so that no line of the cache has
/// numbers of two. Up to kForThread for each thread are of equal size, as many for each, and
/// kFewApart, in another page of memory: what the processor asks for ahead goes no further.
constexpr std::size_t kForThread = 4, kApart = 16, kFewApart = 512;

}  // namespace

std::size_t GrainIslands::grain_count() const {
  std::size_t count = 0;
  for (const Share& share : shares_) count += share.met.size();
  return count;
}

void GrainIslands::find(std::size_t grains, const GrainPairs& listed,
                        std::span<const std::uint32_t> hit, const Look& look, ThreadTeam& team) {
  while (parent_.size() < grains) parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
  island_.resize(grains, kNone);
  place_.resize(grains, kNone);
  shares_.resize(team.size() + 1);
  // Between two of these all threads have done the first.
  const auto each = [&](const auto& work) {
    team.run(team.size(),
             [&](std::size_t own) { work(GrainStretch::share(grains, own, team), shares_[own]); });
  };
  forget(shares_.back());
  each([&](const GrainStretch& own, Share& share) {
    const auto at = [&](std::size_t grain) {
      return static_cast<std::size_t>(std::ranges::lower_bound(listed.first, grain) -
                                      listed.first.begin());
    };
    look(at(own.begin), at(own.end), share.found);
    join_within(listed, own, share);
  });
  each([&](const GrainStretch& own, Share& share) { sort_within(listed, hit, own, share); });
  sort_between(listed);
  make_groups(team.size());
}

// --- islands -------------------------------------------------------------------------------------

std::uint32_t GrainIslands::root(std::uint32_t grain) {
  while (parent_[grain] != grain) grain = parent_[grain] = parent_[parent_[grain]];
  return grain;
}

void GrainIslands::join(std::uint32_t a, std::uint32_t b) {
  a = root(a);
  b = root(b);
  parent_[std::max(a, b)] = std::min(a, b);
}

void GrainIslands::part(std::uint32_t grain) {
  parent_[grain] = grain;
  island_[grain] = kNone;
}

void GrainIslands::forget(Share& share) {
  for (const std::uint32_t grain : share.met) {
    part(grain);
    place_[grain] = kNone;
  }
  share.met.clear();
  share.kept.clear();
}

void GrainIslands::join_within(const GrainPairs& pairs, const GrainStretch& own, Share& share) {
  forget(share);
  share.across.clear();
  for (const std::uint32_t k : share.found.near) {
    if (own.has(pairs.second[k]))
      join(pairs.first[k], pairs.second[k]);
    else
      share.across.push_back(k);
  }
}

void GrainIslands::sort_within(const GrainPairs& pairs, std::span<const std::uint32_t> hit,
                               const GrainStretch& own, Share& share) {
  share.reached.clear();
  share.hit.clear();
  for (const Share& other : shares_)
    for (const std::uint32_t k : other.across)
      for (const std::uint32_t grain : {pairs.first[k], pairs.second[k]})
        if (own.has(grain)) island_[root(grain)] = kReached;
  const auto strike = [&](std::uint32_t grain) {
    std::uint32_t& island = island_[root(grain)];
    if (island == kReached)
      share.hit.push_back(grain);
    else
      island = kHit;
  };
  for (const std::uint32_t grain : share.found.hit) strike(grain);
  for (const std::uint32_t grain : hit)
    if (own.has(grain)) strike(grain);
  for (const std::uint32_t k : share.found.near) {
    if (!own.has(pairs.second[k])) continue;
    const std::uint32_t island = island_[root(pairs.first[k])];
    if (island == kHit)
      share.kept.push_back(k);
    else if (island == kReached)
      share.reached.push_back(k);
    else
      part(pairs.first[k]), part(pairs.second[k]);
  }
  count(pairs, share);
  place(pairs, share);
}

void GrainIslands::sort_between(const GrainPairs& pairs) {
  Share& between = shares_.back();
  std::vector<std::uint32_t>& all = between.reached;
  all.clear();
  for (const Share& share : shares_) {
    if (&share == &between) break;
    all.insert(all.end(), share.across.begin(), share.across.end());
    all.insert(all.end(), share.reached.begin(), share.reached.end());
    for (const std::uint32_t k : share.across) join(pairs.first[k], pairs.second[k]);
  }
  std::ranges::sort(all);
  for (const Share& share : shares_)
    for (const std::uint32_t grain : share.hit) island_[root(grain)] = kHit;
  for (const std::uint32_t k : all) {
    if (island_[root(pairs.first[k])] == kHit)
      between.kept.push_back(k);
    else
      part(pairs.first[k]), part(pairs.second[k]);
  }
  count(pairs, between);
  place(pairs, between);
}

/// Numbers the islands, and counts what they have.
void GrainIslands::count(const GrainPairs& pairs, Share& share) {
  share.grain_start.assign(1, 0);
  share.pair_start.assign(1, 0);
  for (const std::uint32_t k : share.kept) {
    std::uint32_t& island = island_[root(pairs.first[k])];
    if (island == kHit) {
      island = static_cast<std::uint32_t>(share.grain_start.size() - 1);
      share.grain_start.push_back(0);
      share.pair_start.push_back(0);
    }
    ++share.pair_start[island + 1];
    for (const std::uint32_t grain : {pairs.first[k], pairs.second[k]}) {
      if (place_[grain] != kNone) continue;
      place_[grain] = island;
      share.met.push_back(grain);
      ++share.grain_start[island + 1];
    }
  }
  std::partial_sum(share.grain_start.begin(), share.grain_start.end(), share.grain_start.begin());
  std::partial_sum(share.pair_start.begin(), share.pair_start.end(), share.pair_start.begin());
}

// --- where they lie ------------------------------------------------------------------------------

void GrainIslands::place(const GrainPairs& pairs, Share& share) {
  share.pairs.resize(share.kept.size());
  share.next = share.pair_start;
  for (const std::uint32_t k : share.kept) share.pairs[share.next[place_[pairs.first[k]]]++] = k;
  share.grains.resize(share.met.size());
  share.next = share.grain_start;
  for (const std::uint32_t grain : share.met) {
    place_[grain] = share.next[place_[grain]]++;
    share.grains[place_[grain]] = grain;
  }
}

/// Those of the stretches become as those between these.
void GrainIslands::take_from_stretches() {
  Share& between = shares_.back();
  for (Share& share : std::span(shares_).first(shares_.size() - 1)) {
    const auto grains = static_cast<std::uint32_t>(between.grains.size());
    const auto pairs = static_cast<std::uint32_t>(between.pairs.size());
    for (const std::uint32_t grain : share.grains) place_[grain] += grains;
    between.grains.insert(between.grains.end(), share.grains.begin(), share.grains.end());
    between.pairs.insert(between.pairs.end(), share.pairs.begin(), share.pairs.end());
    for (std::size_t k = 1; k < share.grain_start.size(); ++k) {
      between.grain_start.push_back(grains + share.grain_start[k]);
      between.pair_start.push_back(pairs + share.pair_start[k]);
    }
    share.grain_start.resize(1);
    share.pair_start.resize(1);
  }
}

void GrainIslands::make_groups(std::size_t threads) {
  std::size_t most = kGroup, apart = threads > 1 ? kApart : 1;
  if (const std::size_t grains = grain_count();
      threads > 1 && grains <= kForThread * threads * kGroup) {
    take_from_stretches();
    const std::size_t groups = threads * (grains / (threads * kGroup) + 1);
    most = (grains + groups - 1) / groups;
    apart = kFewApart;
  }
  groups_.clear();
  std::size_t before = 0;  // grains before a group
  for (Share& share : shares_) {
    share.groups.begin = static_cast<std::uint32_t>(groups_.size());
    const std::vector<std::uint32_t>& ends = share.grain_start;
    for (std::size_t first = 0, last = 1; last < ends.size(); ++last) {
      const std::size_t own_grains = ends[last] - ends[first];
      if (own_grains < most && last + 1 < ends.size()) continue;
      const std::size_t own_pairs = share.pair_start[last] - share.pair_start[first];
      before += -before % apart;
      groups_.push_back({std::span(share.grains).subspan(ends[first], own_grains),
                         std::span(share.pairs).subspan(share.pair_start[first], own_pairs), before,
                         -ends[first]});
      before += own_grains + 1;
      first = last;
    }
    share.groups.end = static_cast<std::uint32_t>(groups_.size());
  }
}

}  // namespace slipcheck
