#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "reference/events/huge_pages.h"
#include "reference/events/prefetch.h"

namespace slipcheck {

/// Square-meshed cells over an unbounded plane, folded onto a finite number of them, so that bodies
/// in neighbouring cells are found at once. Bodies that only meet by the folding are looked at for
/// nothing, unless the plane repeats itself with the fold: then they are seen across the border.
class CellGrid {
 public:
  /// Of a body in a neighbouring cell: what to add to its position so that it is near.
  struct Shift {
    double x = 0, y = 0;  ///< [m]
  };

  /// A body near another one.
  struct Near {
    std::uint32_t body;
    std::uint32_t cell;  ///< of the nine around the other: an index of Around::shift
  };
  /// The bodies near one, in memory that is used again for the next: of n bodies at most n − 1, and
  /// behind them whatever was written without asking.
  struct Around {
    explicit Around(std::size_t n) : near(n + kInCell) {}
    std::span<const Near> bodies() const { return {near.data(), count}; }

    std::vector<Near> near;
    std::size_t count = 0;
    std::array<Shift, 9> shift{};
    bool is_shifted = false;  ///< any of these is not zero
  };

  /// Cells of width_x by width_y [m] for n bodies, folded after nx and ny in [4, 65536) cells;
  /// periodic: the plane repeats itself there.
  CellGrid(std::size_t n, double width_x, double width_y, std::uint32_t nx, std::uint32_t ny,
           bool periodic_x, bool periodic_y)
      : width_x_(width_x),
        width_y_(width_y),
        nx_(nx),
        ny_(ny),
        period_{periodic_x ? width_x * nx : 0, periodic_y ? width_y * ny : 0},
        cells_(static_cast<std::size_t>(nx) * ny),
        nodes_(n) {}

  double width_x() const { return width_x_; }
  double width_y() const { return width_y_; }
  std::uint32_t cells_x() const { return nx_; }
  std::uint32_t cells_y() const { return ny_; }
  const Shift& period() const { return period_; }  ///< [m]; 0 where the plane does not repeat
  // The folded cell that a body is in.
  std::uint32_t x_of(std::uint32_t body) const { return nodes_[body].x; }
  std::uint32_t y_of(std::uint32_t body) const { return nodes_[body].y; }

  /// The unfolded cell that a coordinate lies in.
  static std::int32_t cell_of(double coordinate, double width) {
    return static_cast<std::int32_t>(std::floor(coordinate / width));
  }

  /// How often the fold after n cells lies below an unfolded one.
  static std::int32_t folds_below(std::int32_t cell, std::uint32_t n) {
    const auto m = static_cast<std::int32_t>(n);
    return cell >= 0 ? cell / m : -((-cell + m - 1) / m);
  }

  void insert(std::uint32_t body, std::int32_t ix, std::int32_t iy) {
    nodes_[body].x = fold(ix, nx_);
    nodes_[body].y = fold(iy, ny_);
    link(body);
  }
  /// By one cell (−1, 0, 1) in each direction.
  void move(std::uint32_t body, int dx, int dy) {
    unlink(body);
    Node& node = nodes_[body];
    node.x = static_cast<std::uint16_t>(step(node.x, dx, nx_));
    node.y = static_cast<std::uint16_t>(step(node.y, dy, ny_));
    link(body);
  }

  // Into the caches: the cell that a body is in, by number; and the cells around it, once it has
  // moved by (dx, dy).
  void prefetch(std::uint32_t i) const { slipcheck::prefetch(&nodes_[i]); }
  void prefetch_cells(std::uint32_t i, int dx, int dy) const {
    const Node& node = nodes_[i];
    const std::uint32_t x = step(node.x, dx, nx_), y = step(node.y, dy, ny_);
    for (int v = -1; v <= 1; ++v) {
      const Cell* row = &cells_[cell_at(0, step(y, v, ny_))];
      slipcheck::prefetch(row + step(x, -1, nx_));
      slipcheck::prefetch(row + step(x, +1, nx_));
    }
  }
  /// f(j) for most bodies that i will look at after such a move, and for i, without order; (0, 0)
  /// stands for all around it.
  template <class F>
  void for_most_near(std::uint32_t i, int dx, int dy, F f) const {
    const Node& node = nodes_[i];
    const std::uint32_t x = step(node.x, dx, nx_), y = step(node.y, dy, ny_);
    for (int v = dy > 0 ? 1 : -1; v <= (dy < 0 ? -1 : 1); ++v)
      for (int u = dx > 0 ? 1 : -1; u <= (dx < 0 ? -1 : 1); ++u) {
        const Cell& cell = cells_[cell_at(step(x, u, nx_), step(y, v, ny_))];
        // A coin toss again: no branch.
        for (std::size_t k = 0; k < 2; ++k) f(cell.body[k] == kNone ? i : cell.body[k]);
      }
  }

  /// f(j, shift) for every other body in the cell of i and the eight around it.
  template <class F>
  void for_each_near(std::uint32_t i, F f) const {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) visit(i, dx, dy, f);
  }
  /// The same bodies in the same order. What is looked up for each cell does not depend on how many
  /// it holds: whether it is empty is a coin toss, and a branch that fails costs more than a look.
  void find_near(std::uint32_t i, Around& around) const {
    const Node& node = nodes_[i];
    set_shifts(node, around);
    Near* end = around.near.data();
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) end = collect(i, dx, dy, end);
    around.count = static_cast<std::size_t>(end - around.near.data());
  }
  /// The same in the three cells that have come near by a move by (dx, dy), one of which is 0.
  template <class F>
  void for_each_newly_near(std::uint32_t i, int dx, int dy, F f) const {
    for (int k = -1; k <= 1; ++k) visit(i, dx == 0 ? k : dx, dy == 0 ? k : dy, f);
  }
  void find_newly_near(std::uint32_t i, int dx, int dy, Around& around) const {
    set_shifts(nodes_[i], around);
    Near* end = around.near.data();
    for (int k = -1; k <= 1; ++k) end = collect(i, dx == 0 ? k : dx, dy == 0 ? k : dy, end);
    around.count = static_cast<std::size_t>(end - around.near.data());
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::size_t kInCell = 3;

  /// The latest that came is first; those that came before the last three are in a list.
  struct alignas(16) Cell {
    std::array<std::uint32_t, kInCell> body{kNone, kNone, kNone};
    std::uint32_t more = kNone;
  };
  /// Small, so that the nodes of neighbours, which are close in number too, share cache lines.
  struct Node {
    std::uint32_t after = kNone;  ///< in the list of its cell
    std::uint16_t x = 0, y = 0;
  };

  static std::uint16_t fold(std::int32_t i, std::uint32_t n) {
    const auto m = static_cast<std::int64_t>(n);
    return static_cast<std::uint16_t>(((i % m) + m) % m);
  }
  static std::uint32_t step(std::uint32_t i, int d, std::uint32_t n) {
    if (d < 0) return i == 0 ? n - 1 : i - 1;
    if (d > 0) return i + 1 == n ? 0 : i + 1;
    return i;
  }
  std::size_t cell_at(std::uint32_t x, std::uint32_t y) const {
    return static_cast<std::size_t>(y) * nx_ + x;
  }

  Shift shift_of(const Node& node, int dx, int dy) const {
    const bool is_x = dx < 0 ? node.x == 0 : dx > 0 && node.x + 1u == nx_;
    const bool is_y = dy < 0 ? node.y == 0 : dy > 0 && node.y + 1u == ny_;
    return {is_x ? dx * period_.x : 0, is_y ? dy * period_.y : 0};
  }
  void set_shifts(const Node& node, Around& around) const {
    if (period_.x == 0 && period_.y == 0) return;
    const bool is_shifted = node.x == 0 || node.x + 1u == nx_ || node.y == 0 || node.y + 1u == ny_;
    if (!is_shifted && !around.is_shifted) return;
    around.is_shifted = is_shifted;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) around.shift[number(dx, dy)] = shift_of(node, dx, dy);
  }
  /// Of the nine cells around.
  static std::uint32_t number(int dx, int dy) {
    return static_cast<std::uint32_t>(3 * (dy + 1) + dx + 1);
  }
  template <class F>
  void visit(std::uint32_t i, int dx, int dy, F& f) const {
    const Node& node = nodes_[i];
    const Cell& cell = cells_[cell_at(step(node.x, dx, nx_), step(node.y, dy, ny_))];
    const Shift shift = shift_of(node, dx, dy);
    for (const std::uint32_t j : cell.body)
      if (j != kNone && j != i) f(j, shift);
    for (std::uint32_t j = cell.more; j != kNone; j = nodes_[j].after)
      if (j != i) f(j, shift);
  }
  Near* collect(std::uint32_t i, int dx, int dy, Near* end) const {
    const Node& node = nodes_[i];
    const Cell& cell = cells_[cell_at(step(node.x, dx, nx_), step(node.y, dy, ny_))];
    for (const std::uint32_t j : cell.body) {
      *end = {j, number(dx, dy)};
      end += static_cast<int>(j != kNone) & static_cast<int>(j != i);
    }
    for (std::uint32_t j = cell.more; j != kNone; j = nodes_[j].after)
      if (j != i) *end++ = {j, number(dx, dy)};
    return end;
  }
  void link(std::uint32_t body) {
    const Node& node = nodes_[body];
    Cell& cell = cells_[cell_at(node.x, node.y)];
    const std::uint32_t last = cell.body.back();
    for (std::size_t k = kInCell - 1; k > 0; --k) cell.body[k] = cell.body[k - 1];
    cell.body.front() = body;
    if (last == kNone) return;
    nodes_[last].after = cell.more;
    cell.more = last;
  }
  void unlink(std::uint32_t body) {
    const Node& node = nodes_[body];
    Cell& cell = cells_[cell_at(node.x, node.y)];
    std::size_t k = 0;
    while (k < kInCell && cell.body[k] != body) ++k;
    if (k == kInCell) {
      std::uint32_t* link = &cell.more;
      while (*link != body) link = &nodes_[*link].after;
      *link = node.after;
      return;
    }
    for (; k + 1 < kInCell; ++k) cell.body[k] = cell.body[k + 1];
    cell.body.back() = cell.more;
    if (cell.more != kNone) cell.more = nodes_[cell.more].after;
  }

  double width_x_, width_y_;
  std::uint32_t nx_, ny_;
  Shift period_;
  std::vector<Cell, HugePages<Cell>> cells_;
  std::vector<Node, HugePages<Node>> nodes_;
};

}  // namespace slipcheck
