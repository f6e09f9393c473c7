#include "reference/steps/grain_neighbours.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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
                                                        const GrainPlane& plane, double width) {
  const Axis x(grains.x, plane.length_x, width), y(grains.y, plane.length_y, width);
  columns_ = x.cells;
  rows_ = y.cells;
  const std::size_t n = grains.size();
  cell_.resize(n);
  start_.assign(std::size_t{columns_} * rows_ + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    cell_[i] = y.cell_of(grains.y[i]) * columns_ + x.cell_of(grains.x[i]);
    ++start_[cell_[i] + 1];
  }
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  order_.resize(n);
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  for (std::uint32_t i = 0; i < n; ++i) order_[next[cell_[i]]++] = i;
  return order_;
}

void GrainNeighbours::find(const GrainArrays& grains, const GrainPlane& plane, double skin,
                           ThreadTeam& team) {
  found_.resize(team.size());
  const std::size_t shares = found_.size();
  team.run(shares, [&](std::size_t k) {
    find_in(grains, plane, skin, static_cast<std::int64_t>(rows_ * k / shares),
            static_cast<std::int64_t>(rows_ * (k + 1) / shares), found_[k]);
  });
  first_.clear();
  second_.clear();
  for (const Found& found : found_) {
    first_.insert(first_.end(), found.first.begin(), found.first.end());
    second_.insert(second_.end(), found.second.begin(), found.second.end());
  }
}

std::uint32_t GrainNeighbours::place_of(std::uint32_t i, std::uint32_t j) const {
  const auto [begin, end] = std::equal_range(first_.begin(), first_.end(), i);
  const auto second = second_.begin();
  const auto at =
      std::lower_bound(second + (begin - first_.begin()), second + (end - first_.begin()), j);
  return static_cast<std::uint32_t>(at - second);
}

void GrainNeighbours::find_in(const GrainArrays& grains, const GrainPlane& plane, double skin,
                              std::int64_t first_row, std::int64_t last_row, Found& found) const {
  found.first.clear();
  found.second.clear();
  const double reach = 2 * plane.radius + skin;
  const auto take = [&](std::uint32_t i, std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t j = begin; j < end; ++j) {
      double dx = grains.x[i] - grains.x[j], dy = grains.y[i] - grains.y[j];
      dx -= shift_to_nearest_image(dx, plane.length_x);
      dy -= shift_to_nearest_image(dy, plane.length_y);
      if (dx * dx + dy * dy <= reach * reach) found.beside.push_back(j);
    }
  };
  const auto columns = static_cast<std::int64_t>(columns_), rows = static_cast<std::int64_t>(rows_);
  // A cell of few columns or rows would meet itself around the plane.
  const bool round_x = plane.length_x > 0 && columns > 2;
  const bool round_y = plane.length_y > 0 && rows > 2;
  const bool all_x = columns <= 2, all_y = rows <= 2;
  for (std::int64_t row = first_row; row < last_row; ++row)
    for (std::int64_t column = 0; column < columns; ++column) {
      const std::size_t cell = static_cast<std::size_t>(row * columns + column);
      for (std::uint32_t i = start_[cell]; i < start_[cell + 1]; ++i) {
        found.beside.clear();
        for (std::int64_t r = all_y ? 0 : row - 1; r <= (all_y ? rows - 1 : row + 1); ++r) {
          if (!round_y && (r < 0 || r >= rows)) continue;
          const std::int64_t row_beside = (r + rows) % rows * columns;
          for (std::int64_t c = all_x ? 0 : column - 1; c <= (all_x ? columns - 1 : column + 1);
               ++c) {
            if (!round_x && (c < 0 || c >= columns)) continue;
            const auto other = static_cast<std::size_t>(row_beside + (c + columns) % columns);
            if (other < cell) continue;
            take(i, other == cell ? i + 1 : start_[other], start_[other + 1]);
          }
        }
        std::sort(found.beside.begin(), found.beside.end());
        found.first.insert(found.first.end(), found.beside.size(), i);
        found.second.insert(found.second.end(), found.beside.begin(), found.beside.end());
      }
    }
}

}  // namespace slipcheck
