#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reference/piles/pile_body.h"

namespace slipcheck {

/// Two bodies that may touch soon; first < second.
struct PilePair {
  std::uint32_t first = 0, second = 0;
  auto operator<=>(const PilePair&) const = default;
};

/// All pairs of bodies whose surfaces are nearer than `skin` [m], in order: in cells of the largest
/// diameter, so that the cost goes with the number of bodies that are near each other.
std::vector<PilePair> near_pairs(std::span<const PileBody> bodies, double skin);

}  // namespace slipcheck
