#include "reference/near_pairs.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>

namespace slipcheck {
namespace {

/// Spheres that one thread looks at in a row.
constexpr std::size_t kShare = 2048;
/// Radii from the largest down to 2^−kLevels of it have cells of their own.
constexpr std::size_t kLevels = 16;

Vector3 to_nearest_image(Vector3 apart, const Vector2& periodic) {
  for (int k = 0; k < 2; ++k) {
    if (std::abs(apart[k]) < 0.49 * periodic[k]) continue;  // most
    if (periodic[k] > 0) apart[k] -= periodic[k] * std::round(apart[k] / periodic[k]);
  }
  return apart;
}

/// Spheres of a level that follow each other.
struct Stretch {
  std::uint32_t begin = 0, end = 0;
};

/// Those of cells beside one, along z in one piece or at an edge in three.
class Beside {
 public:
  void clear() { count_ = 0; }
  void add(std::uint32_t begin, std::uint32_t end) { all_[count_++] = {begin, end}; }
  std::span<Stretch> all() { return {all_.data(), count_}; }

 private:
  std::array<Stretch, 27> all_;
  std::size_t count_ = 0;
};

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
    const double cell = (x - low) * per_cell;
    if (cell >= 0 && cell < static_cast<double>(count)) return static_cast<std::int64_t>(cell);
    // Beyond these cells, where 2^62 ends, distance tells all the same.
    constexpr double kMost = 4e18;
    const auto whole =
        static_cast<std::int64_t>(std::clamp(std::floor(cell), -kMost, kMost)) % count;
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

  /// Those of all in the cells around that of `x`.
  std::span<const Stretch> around(const Vector3& x, Beside& found) const {
    const auto [cx, cy, cz] = cells_of(x);
    found.clear();
    for_each(axes_[0], cx, -1, [&](std::int64_t ix) {
      for_each(axes_[1], cy, -1, [&](std::int64_t iy) { add_row(ix, iy, cz, -1, found); });
    });
    return found.all();
  }

  /// Calls visit(own, beside) for the cells of the places first … last − 1, with its places of
  /// these, and a stretch that goes on with the rest of the cell and those of half of the cells
  /// beside it: with what follows it in the first, each pair comes once.
  template <class Visit>
  void for_cells(std::size_t first, std::size_t last, const Visit& visit) const {
    const auto after = std::upper_bound(start_.begin(), start_.end() - 1, first);
    auto cell = static_cast<std::size_t>(after - start_.begin()) - 1;
    const auto rest = static_cast<std::int64_t>(cell);
    std::int64_t cz = rest % axes_[2].count, cy = rest / axes_[2].count % axes_[1].count,
                 cx = rest / axes_[2].count / axes_[1].count;
    Beside found;
    for (; start_[cell] < last; ++cell) {
      const Stretch own = {std::max(start_[cell], static_cast<std::uint32_t>(first)),
                           std::min(start_[cell + 1], static_cast<std::uint32_t>(last))};
      if (own.begin < own.end) {
        found.clear();
        found.add(own.begin, start_[cell + 1]);
        add_behind(cx, cy, cz, found);
        visit(own, found.all());
      }
      if (++cz < axes_[2].count) continue;
      cz = 0;
      if (++cy < axes_[1].count) continue;
      cy = 0;
      ++cx;
    }
  }

 private:
  /// Half of the cells beside one.
  void add_behind(std::int64_t cx, std::int64_t cy, std::int64_t cz, Beside& found) const {
    add_row(cx, cy, cz, 1, found);
    if (axes_[1].has_neighbours) add_row(cx, wrapped(cy + 1, axes_[1]), cz, -1, found);
    if (axes_[0].has_neighbours)
      for_each(axes_[1], cy, -1,
               [&](std::int64_t iy) { add_row(wrapped(cx + 1, axes_[0]), iy, cz, -1, found); });
  }
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
  /// Adds cells along z, those that follow each other as one stretch.
  void add_row(std::int64_t ix, std::int64_t iy, std::int64_t cz, int first, Beside& found) const {
    const std::size_t row = index(ix, iy, 0);
    const auto last = axes_[2].count - 1;
    if (axes_[2].has_neighbours && cz + first >= 0 && cz + 1 <= last) {
      found.add(start_[row + static_cast<std::size_t>(cz + first)],
                start_[row + static_cast<std::size_t>(cz + 2)]);
      return;
    }
    for_each(axes_[2], cz, first, [&](std::int64_t iz) {
      const std::size_t cell = row + static_cast<std::size_t>(iz);
      found.add(start_[cell], start_[cell + 1]);
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
    const double radius = spheres[i].radius;
    const int halvings = radius == largest ? 0 : std::ilogb(largest / radius);
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

  /// Those of one share, in any order; until the thread's next call.
  std::span<const NearPair> find(std::size_t share) const {
    return periodic_.isZero(0) ? find_in<false>(shares_[share]) : find_in<true>(shares_[share]);
  }

 private:
  struct Share {
    std::size_t level, first, last;
  };

  template <bool kRepeats>
  std::span<const NearPair> find_in(const Share& share) const {
    thread_local std::vector<NearPair> found;
    const Level& own = levels_[share.level];
    found.clear();
    const auto look_at = [&](std::size_t p, const Level& others, std::span<const Stretch> beside) {
      const NearSphere sphere = own.sphere(p);
      const std::uint32_t i = own.body(p);
      for (const Stretch& each : beside)
        for (std::uint32_t q = each.begin; q < each.end; ++q) {
          const NearSphere& other = others.sphere(q);
          Vector3 apart = sphere.position - other.position;
          if constexpr (kRepeats) apart = to_nearest_image(apart, periodic_);
          const double reach = sphere.radius + other.radius + skin_;
          if (!(apart.squaredNorm() <= reach * reach)) continue;
          const std::uint32_t j = others.body(q);
          found.push_back({std::min(i, j), std::max(i, j)});
        }
    };
    own.for_cells(share.first, share.last, [&](const Stretch& cell, std::span<Stretch> beside) {
      for (std::uint32_t p = cell.begin; p < cell.end; ++p) {
        beside[0].begin = p + 1;
        look_at(p, own, beside);
      }
    });
    Beside around;
    for (std::size_t coarse = 0; coarse < share.level; ++coarse)
      for (std::size_t p = share.first; p < share.last; ++p)
        look_at(p, levels_[coarse], levels_[coarse].around(own.sphere(p).position, around));
    return found;
  }

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
  const auto look = [&](std::size_t share) {
    const std::span<const NearPair> found = search.find(share);
    parts[share].assign(found.begin(), found.end());
  };
  run_each(team, search.shares(), look);
  return sorted(parts, spheres.size());
}

void near_pairs_in_shares(const NearSpheres& spheres, double skin, const Vector2& periodic,
                          const std::function<void(std::span<const NearPair>)>& take) {
  if (spheres.size() < 2) return;
  const Search search(spheres, skin, periodic);
  for (std::size_t share = 0; share < search.shares(); ++share) take(search.find(share));
}

}  // namespace slipcheck
