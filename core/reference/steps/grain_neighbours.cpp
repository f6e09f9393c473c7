#include "reference/steps/grain_neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>
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
  team.run_shares(n, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      cell_[i] = y.cell_of(grains.y[i]) * columns_ + x.cell_of(grains.x[i]);
  });
  start_.resize(cells + 1);
  start_[0] = 0;
  order_.resize(n);
  // Each thread looks at all grains for those of its cells.
  team.run_shares(cells, [&](std::size_t, std::size_t first, std::size_t last) {
    sort_in(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last));
  });
  return order_;
}

void GrainNeighbours::sort_in(std::uint32_t first, std::uint32_t last) {
  std::uint32_t* const ends = start_.data() + 1;  // of each cell
  std::fill(ends + first, ends + last, 0);
  std::uint32_t next = 0;
  for (const std::uint32_t cell : cell_) {
    if (cell - first < last - first) ++ends[cell];
    next += cell < first ? 1 : 0;
  }
  for (std::uint32_t cell = first; cell < last; ++cell) next += std::exchange(ends[cell], next);
  // Each grain that a cell takes moves its end on.
  for (std::uint32_t i = 0; i < cell_.size(); ++i)
    if (cell_[i] - first < last - first) order_[ends[cell_[i]]++] = i;
}

std::uint32_t GrainNeighbours::sorted(std::uint32_t i) const {
  std::uint32_t k = start_[cell_[i]];
  while (order_[k] != i) ++k;
  return k;
}

void GrainNeighbours::find(const GrainArrays& grains, const GrainPlane& plane, double skin,
                           ThreadTeam& team) {
  found_.resize(team.size());
  team.run_shares(rows_, [&](std::size_t own, std::size_t first, std::size_t last) {
    find_in(grains, plane, skin, static_cast<std::uint32_t>(first),
            static_cast<std::uint32_t>(last), found_[own]);
  });
  std::ptrdiff_t all = 0;
  for (Found& found : found_) {
    found.before = all;
    all += found.count;
  }
  first_.resize(static_cast<std::size_t>(all));
  second_.resize(static_cast<std::size_t>(all));
  team.run(found_.size(), [&](std::size_t own) {
    const Found& found = found_[own];
    std::copy_n(found.first.begin(), found.count, first_.begin() + found.before);
    std::copy_n(found.second.begin(), found.count, second_.begin() + found.before);
  });
}

std::uint32_t GrainNeighbours::place_of(std::uint32_t i, std::uint32_t j) const {
  const auto [begin, end] = std::equal_range(first_.begin(), first_.end(), i);
  const auto second = second_.begin();
  const auto at =
      std::lower_bound(second + (begin - first_.begin()), second + (end - first_.begin()), j);
  return static_cast<std::uint32_t>(at - second);
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

  /// The cell itself and those beside it that come later in the order: each pair is found once.
  std::span<Stretch> find(std::uint32_t row, std::uint32_t column) {
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
  std::array<Stretch, 6> found_;
  std::size_t count_ = 0;
};

void GrainNeighbours::find_in(const GrainArrays& grains, const GrainPlane& plane, double skin,
                              std::uint32_t first_row, std::uint32_t last_row, Found& found) const {
  const double reach = 2 * plane.radius + skin;
  const double* x = grains.x.data();
  const double* y = grains.y.data();
  Beside cells(*this, plane);
  std::size_t count = 0;
  for (std::uint32_t row = first_row; row < last_row; ++row)
    for (std::uint32_t column = 0; column < columns_; ++column) {
      const std::size_t cell = std::size_t{row} * columns_ + column;
      const std::uint32_t begin = start_[cell], end = start_[cell + 1];
      if (begin == end) continue;
      const std::span<Stretch> beside = cells.find(row, column);
      std::size_t most = count;
      for (const Stretch& s : beside) most += std::size_t{end - begin} * (s.end - s.begin);
      if (found.first.size() < most) {
        found.first.resize(2 * most);
        found.second.resize(2 * most);
      }
      for (std::uint32_t i = begin; i < end; ++i) {
        beside.front().begin = i + 1;
        // Each is written down, and stays where it is near: no branch that nobody foresees.
        for (const Stretch& s : beside)
          for (std::uint32_t j = s.begin; j < s.end; ++j) {
            double dx = x[i] - x[j], dy = y[i] - y[j];
            dx -= shift_to_nearest_image(dx, plane.length_x);
            dy -= shift_to_nearest_image(dy, plane.length_y);
            found.first[count] = i;
            found.second[count] = j;
            count += dx * dx + dy * dy <= reach * reach ? 1 : 0;
          }
      }
    }
  found.count = static_cast<std::ptrdiff_t>(count);
}

}  // namespace slipcheck
