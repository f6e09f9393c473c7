#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace slipcheck {

/// Hands impulses on among bodies that touch: of these pairs of them always the one that approaches
/// fastest collides, until its closing speed `approach` is no larger than `least`, both of a pair
/// and in [m/s], the latter of the number of collisions before too. A row hands a blow on from end
/// to end. Gives up after `most` collisions.
template <class Pair, class Approach, class Least, class Collide>
void collide_fastest_first(const std::vector<Pair>& pairs, Approach approach, Least least,
                           Collide collide, std::size_t most) {
  if (pairs.empty()) return;
  for (std::size_t turn = 0; turn < most; ++turn) {
    const Pair fastest = *std::ranges::max_element(pairs, {}, approach);
    if (!(approach(fastest) > least(fastest, turn))) return;
    collide(fastest[0], fastest[1]);
  }
}

/// Largest relative velocity, of pairs that collide at one instant: until the fastest would part no
/// slower than it meets. `slowest` gives the least speed at which a pair is made to part [m/s]. The
/// limit is for a cluster without rest.
template <class Approach, class Slowest, class Collide>
void collide_cluster(std::vector<std::array<std::uint32_t, 2>>& pairs, Approach approach,
                     Slowest slowest, Collide collide) {
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  const auto least = [&](const auto& pair, std::size_t turn) {
    return turn > 0 ? slowest(pair) : 0;
  };
  collide_fastest_first(pairs, approach, least, collide, 1000 * pairs.size());
}

}  // namespace slipcheck
