#include "reference/steps/grain_islands.h"

#include <algorithm>
#include <numeric>

namespace slipcheck {
namespace {

/// Grains of a group: with their pairs some 30 kB.
constexpr std::size_t kGroup = 128;
/// Where threads share them, up to so many for each are of equal size, as many for each.
constexpr std::size_t kForThread = 4;
/// And each begins at a multiple of kApart, so that no line of the cache has numbers of two. Those
/// of kPaged grains or fewer do so in a page of memory of their own, beyond which no processor asks
/// for ahead, and one line further each, as what lies pages apart shares places in its cache.
constexpr std::size_t kApart = 16, kPaged = 8192, kPageApart = 520;

std::size_t next_multiple(std::size_t from, std::size_t factor) {
  return (from + factor - 1) / factor * factor;
}

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

void GrainIslands::make_groups(std::size_t threads) {
  const std::size_t grains = grain_count();
  const bool are_few = threads > 1 && grains <= kForThread * threads * kGroup;
  std::size_t most = kGroup, apart = 1;
  if (threads > 1) apart = grains <= kPaged ? kPageApart : kApart;
  if (are_few) {
    const std::size_t groups = threads * (grains / (threads * kGroup) + 1);
    most = (grains + groups - 1) / groups;
    reserve_joined(grains);
  }
  groups_.clear();
  parts_.clear();
  std::size_t before = 0, held = 0;  // grains before the next group, and of its pieces
  const auto close = [&] {
    if (held == 0) return;
    before = next_multiple(before, apart);
    pieces_.size() == 1 ? take(pieces_.front(), before) : join(pieces_, before);
    before += held + 1;
    held = 0;
    pieces_.clear();
  };
  for (std::size_t k = 0; k <= threads; ++k) {
    const std::size_t stretch = (k + threads) % (threads + 1);  // first those between
    const std::vector<std::uint32_t>& ends = shares_[stretch].grain_start;
    for (std::size_t first = 0, last = 1; last < ends.size(); ++last) {
      const std::size_t own = ends[last] - ends[first];
      if (held + own < most && last + 1 < ends.size()) continue;
      pieces_.push_back({stretch, first, last});
      held += own;
      first = last;
      if (held >= most) close();
    }
    if (!are_few) close();
  }
  close();
  grain_places_ = next_multiple(before, apart);  // what lies behind belongs to another thread
}

/// A group of islands of one share, where they lie.
void GrainIslands::take(const Piece& piece, std::size_t before) {
  const Share& share = shares_[piece.stretch];
  groups_.push_back({grains_of(piece), pairs_of(piece), before, -share.grain_start[piece.first]});
  parts_.push_back({groups_.back().grains, before, piece.stretch});
}

/// For so many grains; groups point to them.
void GrainIslands::reserve_joined(std::size_t grains) {
  std::size_t pairs = 0;
  for (const Share& share : shares_) pairs += share.pairs.size();
  joined_grains_.clear();
  joined_grains_.reserve(grains);
  joined_pairs_.clear();
  joined_pairs_.reserve(pairs);
}

/// A group of islands of several shares, which are brought together.
void GrainIslands::join(std::span<const Piece> pieces, std::size_t before) {
  const std::size_t grains_before = joined_grains_.size(), pairs_before = joined_pairs_.size();
  std::uint32_t count = 0;
  for (const Piece& piece : pieces) {
    const std::span<const std::uint32_t> grains = grains_of(piece), pairs = pairs_of(piece);
    parts_.push_back({grains, before + count, piece.stretch});
    for (const std::uint32_t grain : grains) place_[grain] = count++;
    joined_grains_.insert(joined_grains_.end(), grains.begin(), grains.end());
    joined_pairs_.insert(joined_pairs_.end(), pairs.begin(), pairs.end());
  }
  groups_.push_back({std::span(joined_grains_).subspan(grains_before),
                     std::span(joined_pairs_).subspan(pairs_before), before, 0});
}

std::span<const std::uint32_t> GrainIslands::grains_of(const Piece& piece) const {
  const Share& share = shares_[piece.stretch];
  const std::uint32_t begin = share.grain_start[piece.first];
  return std::span(share.grains).subspan(begin, share.grain_start[piece.last] - begin);
}

std::span<const std::uint32_t> GrainIslands::pairs_of(const Piece& piece) const {
  const Share& share = shares_[piece.stretch];
  const std::uint32_t begin = share.pair_start[piece.first];
  return std::span(share.pairs).subspan(begin, share.pair_start[piece.last] - begin);
}

}  // namespace slipcheck
