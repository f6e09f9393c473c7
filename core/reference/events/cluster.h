#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace slipcheck {

/// Largest relative velocity: of the pairs that collide at one instant always the one that
/// approaches fastest goes first, until it would part no slower than it meets. `approach` gives a
/// pair's closing speed and `slowest` the least at which it is made to part [m/s]; `collide` lets
/// two bodies exchange their impulse. A row hands a blow on from end to end; the limit is for a
/// cluster without rest.
template <class Approach, class Slowest, class Collide>
void collide_cluster(std::vector<std::array<std::uint32_t, 2>>& pairs, Approach approach,
                     Slowest slowest, Collide collide) {
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (std::size_t turn = 0; turn < 1000 * pairs.size(); ++turn) {
    const auto fastest = *std::ranges::max_element(pairs, {}, approach);
    if (approach(fastest) <= (turn > 0 ? slowest(fastest) : 0)) return;
    collide(fastest[0], fastest[1]);
  }
}

}  // namespace slipcheck
