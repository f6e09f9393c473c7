#include "reference/steps/grain_neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

namespace slipcheck {
namespace {

/// Cells of at least `width` along one axis.
struct Axis {
  double low = 0, per_cell = 1;
  std::uint32_t cells = 1;

  Axis(const std::vector<double>& places, double length, double width) {
    double extent = length;
    if (length <= 0 && !places.empty()) {
      const auto [least, largest] = std::minmax_element(places.begin(), places.end());
      low = *least;
      extent = *largest - low;
    }
    // More cells than grains are of no use where these lie far apart.
    const double most = std::max(1.0, 2 * std::sqrt(static_cast<double>(places.size())) + 4);
    cells = static_cast<std::uint32_t>(std::clamp(std::floor(extent / width), 1.0, most));
    per_cell = extent > 0 ? cells / extent : 0;
  }
  std::uint32_t cell_of(double place) const {
    const double cell = (place - low) * per_cell;
    return cell > 0 ? std::min(static_cast<std::uint32_t>(cell), cells - 1) : 0;
  }
};

}  // namespace

const std::vector<std::uint32_t>& GrainNeighbours::sort(const GrainArrays& grains,
                                                        const GrainPlane& plane, double width,
                                                        ThreadTeam& team) {
  const Axis x(grains.x, plane.length_x, width), y(grains.y, plane.length_y, width);
  columns_ = x.cells;
  rows_ = y.cells;
  const std::size_t n = grains.size(), cells = std::size_t{columns_} * rows_;
  cell_.resize(n);
  start_.resize(cells + 1);
  start_[0] = 0;
  order_.resize(n);
  sorted_.resize(team.size());
  team.run(team.size(), [&](std::size_t k) {
    Sorted& own = sorted_[k];
    own.grains = GrainStretch::share(n, k, team);
    own.cells = GrainStretch::share(cells, k, team);
    for (std::uint32_t i = own.grains.begin; i < own.grains.end; ++i)
      cell_[i] = y.cell_of(grains.y[i]) * columns_ + x.cell_of(grains.x[i]);
    count(own);
  });
  team.run(team.size(), [&](std::size_t k) { place(k); });
  return order_;
}

/// How many of a thread's grains are in each of its cells. Few have left these since they were
/// sorted.
void GrainNeighbours::count(Sorted& own) {
  const GrainStretch grains = own.grains, cells = own.cells;
  const std::uint32_t* const cell_of = cell_.data();
  std::uint32_t* const ends = start_.data() + 1;  // of each cell
  std::fill(ends + cells.begin, ends + cells.end, 0);
  own.gone.clear();
  for (std::uint32_t i = grains.begin; i < grains.end; ++i) {
    if (cells.has(cell_of[i]))
      ++ends[cell_of[i]];
    else
      own.gone.push_back(i);
  }
}

/// Puts what thread k's cells have into the order, in each as it lay before.
void GrainNeighbours::place(std::size_t k) {
  const GrainStretch grains = sorted_[k].grains, cells = sorted_[k].cells;
  const std::uint32_t* const cell_of = cell_.data();
  std::uint32_t* const ends = start_.data() + 1;
  std::uint32_t* const order = order_.data();
  std::uint32_t next = grains.begin;  // grains in cells before those, if none were gone
  for (std::size_t of = 0; of < sorted_.size(); ++of)
    for (const std::uint32_t i : sorted_[of].gone) {
      if (of < k) --next;
      if (cell_of[i] < cells.begin) ++next;
      if (cells.has(cell_of[i])) ++ends[cell_of[i]];
    }
  for (std::uint32_t cell = cells.begin; cell < cells.end; ++cell)
    next += std::exchange(ends[cell], next);
  // Each grain that a cell takes moves its end on.
  const auto take = [=](std::uint32_t i) {
    if (cells.has(cell_of[i])) order[ends[cell_of[i]]++] = i;
  };
  for (std::size_t of = 0; of < sorted_.size(); ++of) {
    if (of != k)
      std::ranges::for_each(sorted_[of].gone, take);
    else
      for (std::uint32_t i = grains.begin; i < grains.end; ++i) take(i);
  }
}

std::uint32_t GrainNeighbours::sorted(std::uint32_t i) const {
  std::uint32_t k = start_[cell_[i]];
  while (order_[k] != i) ++k;
  return k;
}

std::uint32_t GrainNeighbours::place_of(std::uint32_t i, std::uint32_t j,
                                        std::uint16_t wall) const {
  const auto [begin, end] = std::equal_range(first_.begin(), first_.end(), i);
  const auto second = second_.begin();
  const auto at =
      std::lower_bound(second + (begin - first_.begin()), second + (end - first_.begin()), j);
  auto place = static_cast<std::uint32_t>(at - second);
  while (wall != this->wall(place)) ++place;  // of the walls of one grain
  return place;
}

class GrainNeighbours::Beside {
 public:
  Beside(const GrainNeighbours& cells, const GrainPlane& plane)
      : start_(cells.start_),
        columns_(cells.columns_),
        rows_(cells.rows_),
        // A cell of few columns or rows would meet itself around the plane.
        is_round_x_(plane.length_x > 0 && columns_ > 2),
        is_round_y_(plane.length_y > 0 && rows_ > 2) {}

  /// Whether find() tells none beside the cell around the plane: what is near is so as it lies.
  bool is_inside(std::uint32_t row, std::uint32_t column) const {
    return row > 0 && column > 0 && column + 1 < columns_;
  }

  /// The cell itself and those beside it that come later in the order: each pair is found once.
  std::span<GrainStretch> find(std::uint32_t row, std::uint32_t column) {
    count_ = 0;
    column_ = column;
    const std::uint32_t last = columns_ - 1;
    add(row, column, std::min(column + 1, last));
    if (is_round_x_ && column == 0) add(row, last, last);
    if (row + 1 < rows_) add_row(row + 1);
    if (is_round_y_ && row == 0) add_row(rows_ - 1);
    return {found_.data(), count_};
  }

 private:
  void add_row(std::uint32_t row) {
    const std::uint32_t last = columns_ - 1;
    if (is_round_x_ && column_ == last) add(row, 0, 0);
    add(row, column_ > 0 ? column_ - 1 : 0, std::min(column_ + 1, last));
    if (is_round_x_ && column_ == 0) add(row, last, last);
  }
  void add(std::uint32_t row, std::uint32_t first, std::uint32_t last) {
    const std::size_t before = std::size_t{row} * columns_;
    found_[count_++] = {start_[before + first], start_[before + last + 1]};
  }

  std::span<const std::uint32_t> start_;
  std::uint32_t columns_, rows_;
  bool is_round_x_, is_round_y_;
  std::uint32_t column_ = 0;
  std::array<GrainStretch, 6> found_;
  std::size_t count_ = 0;
};

template <class Reach>
void GrainNeighbours::find_in(const GrainArrays& grains, const GrainPlane& plane, double skin,
                              const Reach& reach, std::uint32_t first_row, std::uint32_t last_row,
                              Found& found) const {
  const double* x = grains.x.data();
  const double* y = grains.y.data();
  Beside cells(*this, plane);
  std::size_t count = 0;
  // Each is written down, and stays where it is near: no branch that nobody foresees.
  const auto look = [&](std::uint32_t i, const GrainStretch& others, auto around) {
    std::uint32_t* const first = found.first.data();
    std::uint32_t* const second = found.second.data();
    for (std::uint32_t j = others.begin; j < others.end; ++j) {
      double dx = x[i] - x[j], dy = y[i] - y[j];
      if constexpr (around) {
        dx -= shift_to_nearest_image(dx, plane.length_x);
        dy -= shift_to_nearest_image(dy, plane.length_y);
      }
      const double within = reach(i, j);
      first[count] = i;
      second[count] = j;
      count += dx * dx + dy * dy <= within * within ? 1 : 0;
    }
  };
  for (std::uint32_t row = first_row; row < last_row; ++row)
    for (std::uint32_t column = 0; column < columns_; ++column) {
      const std::size_t cell = std::size_t{row} * columns_ + column;
      const std::uint32_t begin = start_[cell], end = start_[cell + 1];
      if (begin == end) continue;
      const std::span<GrainStretch> beside = cells.find(row, column);
      std::size_t most = count + std::size_t{end - begin} * plane.walls.size();
      for (const GrainStretch& s : beside) most += std::size_t{end - begin} * (s.end - s.begin);
      if (found.first.size() < most) {
        found.first.resize(2 * most);
        found.second.resize(2 * most);
        if (!plane.walls.empty()) found.wall.resize(2 * most, GrainPair::kNoWall);
      }
      const bool inside = cells.is_inside(row, column);
      for (std::uint32_t i = begin; i < end; ++i) {
        beside.front().begin = i + 1;
        for (std::size_t w = 0; w < plane.walls.size(); ++w) {
          if (plane.walls[w].distance(x[i], y[i]) > grains.radius[i] + skin) continue;
          found.first[count] = found.second[count] = i;
          found.wall[count++] = static_cast<std::uint16_t>(w);
        }
        for (const GrainStretch& others : beside)
          inside ? look(i, others, std::false_type()) : look(i, others, std::true_type());
      }
    }
  found.count = static_cast<std::ptrdiff_t>(count);
}

void GrainNeighbours::find(const GrainArrays& grains, const GrainPlane& plane, double skin,
                           ThreadTeam& team) {
  found_.resize(team.size());
  const auto find_within = [&](auto reach) {
    team.run_shares(rows_, [&](std::size_t own, std::size_t first, std::size_t last) {
      find_in(grains, plane, skin, reach, static_cast<std::uint32_t>(first),
              static_cast<std::uint32_t>(last), found_[own]);
    });
  };
  const double* const R = grains.radius.data();
  if (grains.radius.empty()) {
    find_within([all = 2 * plane.radius + skin](auto, auto) { return all; });
  } else if (!grains.z.empty()) {
    find_within([=](std::size_t i, std::size_t j) { return R[i] + R[j] + skin; });
  } else {  // as level_reach(), with a root of each grain for one of each pair
    std::vector<double> roots(grains.radius);
    for (double& each : roots) each = std::sqrt(2 * each);
    find_within([root = roots.data(), skin](std::size_t i, std::size_t j) {
      return root[i] * root[j] + skin;
    });
  }
  std::ptrdiff_t all = 0;
  for (Found& found : found_) {
    found.before = all;
    all += found.count;
  }
  const auto hold = [&](auto& values, bool any = true) {
    if (values.capacity() < static_cast<std::size_t>(all)) values.clear();  // no more than needed
    values.resize(any ? static_cast<std::size_t>(all) : 0);
  };
  hold(first_);
  hold(second_);
  hold(wall_, !plane.walls.empty());
  team.run(found_.size(), [&](std::size_t own) {
    const Found& found = found_[own];
    std::copy_n(found.first.begin(), found.count, first_.begin() + found.before);
    std::copy_n(found.second.begin(), found.count, second_.begin() + found.before);
    if (!wall_.empty()) std::copy_n(found.wall.begin(), found.count, wall_.begin() + found.before);
  });
  found_.clear();
}

}  // namespace slipcheck
