#include "reference/piles/pile_neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace slipcheck {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct Placed {
  Cell cell;
  std::uint32_t body;
  auto operator<=>(const Placed&) const = default;
};

Cell cell_of(const Vector3& position, double width) {
  // Beyond these cells, where 2^62 ends, distance tells all the same.
  constexpr double kMost = 4e18;
  Cell cell{};
  for (int k = 0; k < 3; ++k)
    cell[static_cast<std::size_t>(k)] =
        static_cast<std::int64_t>(std::clamp(std::floor(position[k] / width), -kMost, kMost));
  return cell;
}

void take(std::span<const PileBody> bodies, std::uint32_t i, std::uint32_t j, double skin,
          std::vector<PilePair>& found) {
  const double reach = bodies[i].radius + bodies[j].radius + skin;
  if ((bodies[i].position - bodies[j].position).squaredNorm() <= reach * reach)
    found.push_back({std::min(i, j), std::max(i, j)});
}

}  // namespace

std::vector<PilePair> near_pairs(std::span<const PileBody> bodies, double skin) {
  std::vector<PilePair> found;
  double largest = 0;
  for (const PileBody& body : bodies) largest = std::max(largest, body.radius);
  const double width = 2 * largest + skin;
  std::vector<Placed> placed;
  for (std::uint32_t i = 0; i < bodies.size(); ++i)
    placed.push_back({cell_of(bodies[i].position, width), i});
  std::ranges::sort(placed);
  // Each row of three cells along z is one range of the sorted ones; the half of the rows behind a
  // cell, and of its own row what comes after it.
  constexpr std::array<std::array<std::int64_t, 2>, 4> kRows{{{0, 1}, {1, -1}, {1, 0}, {1, 1}}};
  for (std::size_t p = 0; p < placed.size(); ++p) {
    const auto& [cell, i] = placed[p];
    for (std::size_t q = p + 1; q < placed.size(); ++q) {
      const Cell& other = placed[q].cell;
      if (other[0] != cell[0] || other[1] != cell[1] || other[2] > cell[2] + 1) break;
      take(bodies, i, placed[q].body, skin, found);
    }
    for (const auto& [dx, dy] : kRows) {
      const Placed from{{cell[0] + dx, cell[1] + dy, cell[2] - 1}, 0};
      for (auto at = std::ranges::lower_bound(placed, from);
           at != placed.end() && at->cell[0] == from.cell[0] && at->cell[1] == from.cell[1] &&
           at->cell[2] <= cell[2] + 1;
           ++at)
        take(bodies, i, at->body, skin, found);
    }
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace slipcheck
