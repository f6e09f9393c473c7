#include "reference/near_pairs.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace slipcheck {
namespace {

/// Spheres that one thread looks at in a row.
constexpr std::size_t kShare = 2048;
/// Radii from the largest down to 2^−kLevels of it have cells of their own.
constexpr std::size_t kLevels = 16;

Vector3 to_nearest_image(Vector3 apart, const Vector2& periodic) {
  for (int k = 0; k < 2; ++k)
    if (periodic[k] > 0) apart[k] -= periodic[k] * std::round(apart[k] / periodic[k]);
  return apart;
}

/// Of all spheres, in each direction.
struct Extent {
  Vector3 low = Vector3::Zero(), length = Vector3::Zero();
  Vector3 period = Vector3::Zero();  ///< 0: none
};

/// Cells of equal width along one direction, folded after `count` of them.
struct CellAxis {
  double low = 0, per_cell = 1;
  std::int64_t count = 1;
  bool has_neighbours = true;  ///< one cell on either side, neither the same

  std::int64_t cell_of(double x) const {
    // Beyond these cells, where 2^62 ends, distance tells all the same.
    constexpr double kMost = 4e18;
    const double cell = std::clamp(std::floor((x - low) * per_cell), -kMost, kMost);
    const auto whole = static_cast<std::int64_t>(cell) % count;
    return whole < 0 ? whole + count : whole;
  }
};

/// How many cells each direction has, of two for each of n spheres at most, and three at least.
std::array<CellAxis, 3> axes_of(const Extent& extent, double width, std::size_t n) {
  std::array<CellAxis, 3> axes;
  const double most = std::max(64.0, 2 * static_cast<double>(n));
  Vector3 wanted;
  for (int k = 0; k < 3; ++k) {
    const double room = extent.period[k] > 0 ? std::floor(extent.period[k] / width)
                                             : std::floor(extent.length[k] / width) + 1;
    wanted[k] = std::clamp(room, extent.period[k] > 0 ? 1.0 : 3.0, 1e9);
  }
  while (wanted.prod() > most && wanted.maxCoeff() > 4) {
    Eigen::Index longest = 0;
    wanted.maxCoeff(&longest);
    wanted[longest] = std::ceil(0.5 * wanted[longest]);
  }
  for (int k = 0; k < 3; ++k) {
    CellAxis& axis = axes[static_cast<std::size_t>(k)];
    axis.count = static_cast<std::int64_t>(wanted[k]);
    axis.has_neighbours = axis.count >= 3;
    if (!axis.has_neighbours) axis.count = 1;
    axis.low = extent.period[k] > 0 ? 0 : extent.low[k];
    axis.per_cell =
        extent.period[k] > 0 ? static_cast<double>(axis.count) / extent.period[k] : 1 / width;
  }
  return axes;
}

/// The spheres of one level, sorted by cells.
class Level {
 public:
  Level(const NearSpheres& spheres, std::vector<std::uint32_t> members, const Extent& extent,
        double skin)
      : members_(std::move(members)) {
    double largest = 0;
    for (const std::uint32_t i : members_) largest = std::max(largest, spheres[i].radius);
    axes_ = axes_of(extent, 2 * largest + skin, members_.size());
    const auto cells = static_cast<std::size_t>(axes_[0].count * axes_[1].count * axes_[2].count);
    start_.assign(cells + 2, 0);
    std::vector<std::uint32_t> cell(members_.size()), sorted(members_.size());
    for (std::size_t k = 0; k < members_.size(); ++k) {
      cell[k] = static_cast<std::uint32_t>(cell_of(spheres[members_[k]].position));
      ++start_[cell[k] + 2];
    }
    // start_[c + 1] is where cell c begins, and as its spheres are put there comes to where it
    // ends.
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    sorted_.resize(members_.size());
    for (std::size_t k = 0; k < members_.size(); ++k) {
      const std::uint32_t place = start_[cell[k] + 1]++;
      sorted[place] = members_[k];
      sorted_[place] = spheres[members_[k]];
    }
    members_ = std::move(sorted);
  }

  std::size_t size() const { return sorted_.size(); }
  std::uint32_t body(std::size_t place) const { return members_[place]; }
  const NearSphere& sphere(std::size_t place) const { return sorted_[place]; }

  /// Calls take(begin, end) with the places of all in the cells around that of `x`.
  template <class Take>
  void around(const Vector3& x, const Take& take) const {
    const auto [cx, cy, cz] = cells_of(x);
    for_each(axes_[0], cx, -1, [&](std::int64_t ix) {
      for_each(axes_[1], cy, -1, [&](std::int64_t iy) { rows(ix, iy, cz, -1, take); });
    });
  }

  /// The same with those behind its own place and in half of the cells: each pair comes once.
  template <class Take>
  void behind(std::size_t place, const Vector3& x, const Take& take) const {
    const auto [cx, cy, cz] = cells_of(x);
    const std::size_t own = index(cx, cy, cz);
    take(static_cast<std::uint32_t>(place + 1), start_[own + 1]);
    rows(cx, cy, cz, 1, take);
    if (axes_[1].has_neighbours) rows(cx, wrapped(cy + 1, axes_[1]), cz, -1, take);
    if (!axes_[0].has_neighbours) return;
    for_each(axes_[1], cy, -1,
             [&](std::int64_t iy) { rows(wrapped(cx + 1, axes_[0]), iy, cz, -1, take); });
  }

 private:
  static std::int64_t wrapped(std::int64_t cell, const CellAxis& axis) {
    return cell < 0 ? cell + axis.count : cell >= axis.count ? cell - axis.count : cell;
  }
  /// The cells from `first` (−1 or 1) to 1 beside the given one.
  template <class Visit>
  static void for_each(const CellAxis& axis, std::int64_t cell, int first, const Visit& visit) {
    if (!axis.has_neighbours) {
      if (first <= 0) visit(0);
      return;
    }
    for (int d = first; d <= 1; ++d) visit(wrapped(cell + d, axis));
  }
  /// Cells along z that follow each other are one range.
  template <class Take>
  void rows(std::int64_t ix, std::int64_t iy, std::int64_t cz, int first, const Take& take) const {
    const std::size_t row = index(ix, iy, 0);
    const auto last = axes_[2].count - 1;
    if (axes_[2].has_neighbours && cz + first >= 0 && cz + 1 <= last) {
      take(start_[row + static_cast<std::size_t>(cz + first)],
           start_[row + static_cast<std::size_t>(cz + 2)]);
      return;
    }
    for_each(axes_[2], cz, first, [&](std::int64_t iz) {
      const std::size_t cell = row + static_cast<std::size_t>(iz);
      take(start_[cell], start_[cell + 1]);
    });
  }

  std::array<std::int64_t, 3> cells_of(const Vector3& x) const {
    return {axes_[0].cell_of(x[0]), axes_[1].cell_of(x[1]), axes_[2].cell_of(x[2])};
  }
  std::size_t index(std::int64_t ix, std::int64_t iy, std::int64_t iz) const {
    return static_cast<std::size_t>((ix * axes_[1].count + iy) * axes_[2].count + iz);
  }
  std::size_t cell_of(const Vector3& x) const {
    const auto [cx, cy, cz] = cells_of(x);
    return index(cx, cy, cz);
  }

  std::array<CellAxis, 3> axes_;
  std::vector<std::uint32_t> members_;  ///< by place
  std::vector<NearSphere> sorted_;
  std::vector<std::uint32_t> start_;  ///< the first place of each cell, and the end
};

/// From the largest radii down; none is empty.
std::vector<Level> levels_of(const NearSpheres& spheres, const Extent& extent, double skin) {
  double largest = 0;
  for (std::size_t i = 0; i < spheres.size(); ++i) largest = std::max(largest, spheres[i].radius);
  std::array<std::vector<std::uint32_t>, kLevels> members;
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    const int halvings = std::ilogb(largest / spheres[i].radius);
    members[static_cast<std::size_t>(std::clamp(halvings, 0, static_cast<int>(kLevels) - 1))]
        .push_back(i);
  }
  std::vector<Level> levels;
  for (std::vector<std::uint32_t>& each : members)
    if (!each.empty()) levels.emplace_back(spheres, std::move(each), extent, skin);
  return levels;
}

Extent extent_of(const NearSpheres& spheres, const Vector2& periodic) {
  Extent extent;
  extent.period = {periodic.x(), periodic.y(), 0};
  Vector3 high = extent.low = spheres[0].position;
  for (std::size_t i = 1; i < spheres.size(); ++i) {
    const Vector3 position = spheres[i].position;
    extent.low = extent.low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  extent.length = high - extent.low;
  return extent;
}

/// What is looked for in shares of some bodies.
class Search {
 public:
  Search(const NearSpheres& spheres, double skin, const Vector2& periodic)
      : levels_(levels_of(spheres, extent_of(spheres, periodic), skin)),
        skin_(skin),
        periodic_(periodic) {
    for (std::size_t k = 0; k < levels_.size(); ++k)
      for (std::size_t first = 0; first < levels_[k].size(); first += kShare)
        shares_.push_back({k, first, std::min(first + kShare, levels_[k].size())});
  }

  std::size_t shares() const { return shares_.size(); }

  /// Those of one share, in any order.
  void find(std::size_t share, std::vector<NearPair>& found) const {
    const auto& [level, first, last] = shares_[share];
    const bool repeats = !periodic_.isZero(0);
    for (std::size_t p = first; p < last; ++p) {
      const NearSphere& own = levels_[level].sphere(p);
      const std::uint32_t i = levels_[level].body(p);
      const auto look_at = [&](const Level& others) {
        return [&](std::uint32_t begin, std::uint32_t end) {
          for (std::uint32_t q = begin; q < end; ++q) {
            const NearSphere& other = others.sphere(q);
            Vector3 apart = own.position - other.position;
            if (repeats) apart = to_nearest_image(apart, periodic_);
            const double reach = own.radius + other.radius + skin_;
            if (!(apart.squaredNorm() <= reach * reach)) continue;
            const std::uint32_t j = others.body(q);
            found.push_back({std::min(i, j), std::max(i, j)});
          }
        };
      };
      levels_[level].behind(p, own.position, look_at(levels_[level]));
      for (std::size_t coarse = 0; coarse < level; ++coarse)
        levels_[coarse].around(own.position, look_at(levels_[coarse]));
    }
  }

 private:
  struct Share {
    std::size_t level, first, last;
  };
  std::vector<Level> levels_;
  std::vector<Share> shares_;
  double skin_;
  Vector2 periodic_;
};

/// By first and then second: the first ones by counting.
std::vector<NearPair> sorted(const std::vector<std::vector<NearPair>>& parts, std::size_t bodies) {
  std::vector<std::uint32_t> start(bodies + 1, 0);
  for (const auto& part : parts)
    for (const NearPair& pair : part) ++start[pair.first + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<NearPair> pairs(start.back());
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (const auto& part : parts)
    for (const NearPair& pair : part) pairs[next[pair.first]++] = pair;
  for (std::size_t i = 0; i < bodies; ++i)
    std::sort(pairs.begin() + start[i], pairs.begin() + start[i + 1]);
  return pairs;
}

}  // namespace

double near_skin(double speed, double step, double radius) {
  constexpr double kSteps = 30, kThinnest = 0.1, kThickest = 0.6;
  return std::clamp(kSteps * 2 * speed * step, kThinnest * radius, kThickest * radius);
}

std::vector<NearPair> near_pairs(const NearSpheres& spheres, double skin, const Vector2& periodic,
                                 ThreadTeam* team) {
  if (spheres.size() < 2) return {};
  const Search search(spheres, skin, periodic);
  std::vector<std::vector<NearPair>> parts(search.shares());
  const auto look = [&](std::size_t share) { search.find(share, parts[share]); };
  if (team)
    team->run(search.shares(), look);
  else
    for (std::size_t share = 0; share < search.shares(); ++share) look(share);
  return sorted(parts, spheres.size());
}

void near_pairs_in_shares(const NearSpheres& spheres, double skin, const Vector2& periodic,
                          const std::function<void(std::span<const NearPair>)>& take) {
  if (spheres.size() < 2) return;
  const Search search(spheres, skin, periodic);
  std::vector<NearPair> found;
  for (std::size_t share = 0; share < search.shares(); ++share) {
    found.clear();
    search.find(share, found);
    take(found);
  }
}

}  // namespace slipcheck
