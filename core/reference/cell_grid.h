#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

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

  /// Cells of width_x by width_y [m] for n bodies, folded after nx and ny in [4, 65536) cells;
  /// periodic: the plane repeats itself there.
  CellGrid(std::size_t n, double width_x, double width_y, std::uint32_t nx, std::uint32_t ny,
           bool periodic_x, bool periodic_y)
      : width_x_(width_x),
        width_y_(width_y),
        nx_(nx),
        ny_(ny),
        period_{periodic_x ? width_x * nx : 0, periodic_y ? width_y * ny : 0},
        head_(static_cast<std::size_t>(nx) * ny, kNone),
        nodes_(n) {}

  double width_x() const { return width_x_; }
  double width_y() const { return width_y_; }
  std::uint32_t cells_x() const { return nx_; }
  std::uint32_t cells_y() const { return ny_; }
  const Shift& period() const { return period_; }  ///< [m]; 0 where the plane does not repeat

  /// The unfolded cell that a coordinate lies in.
  static std::int32_t cell_of(double coordinate, double width) {
    return static_cast<std::int32_t>(std::floor(coordinate / width));
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

  /// f(j, shift) for every other body in the cell of i and the eight around it.
  template <class F>
  void for_each_near(std::uint32_t i, F f) const {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) visit(i, dx, dy, f);
  }
  /// The same in the three cells that have come near by a move by (dx, dy), one of which is 0.
  template <class F>
  void for_each_newly_near(std::uint32_t i, int dx, int dy, F f) const {
    for (int k = -1; k <= 1; ++k) visit(i, dx == 0 ? k : dx, dy == 0 ? k : dy, f);
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// Small, so that the nodes of neighbours, which are close in number too, share cache lines.
  struct Node {
    std::uint32_t after = kNone;
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
  std::size_t cell(std::uint32_t x, std::uint32_t y) const {
    return static_cast<std::size_t>(y) * nx_ + x;
  }

  template <class F>
  void visit(std::uint32_t i, int dx, int dy, F& f) const {
    const Node& node = nodes_[i];
    const std::uint32_t x = step(node.x, dx, nx_), y = step(node.y, dy, ny_);
    Shift shift;
    if (dx != 0 && static_cast<int>(x) - static_cast<int>(node.x) != dx) shift.x = dx * period_.x;
    if (dy != 0 && static_cast<int>(y) - static_cast<int>(node.y) != dy) shift.y = dy * period_.y;
    for (std::uint32_t j = head_[cell(x, y)]; j != kNone; j = nodes_[j].after)
      if (j != i) f(j, shift);
  }
  void link(std::uint32_t body) {
    Node& node = nodes_[body];
    std::uint32_t& head = head_[cell(node.x, node.y)];
    node.after = head;
    head = body;
  }
  void unlink(std::uint32_t body) {
    const Node& node = nodes_[body];
    // There are few bodies in a cell.
    std::uint32_t* link = &head_[cell(node.x, node.y)];
    while (*link != body) link = &nodes_[*link].after;
    *link = node.after;
  }

  double width_x_, width_y_;
  std::uint32_t nx_, ny_;
  Shift period_;
  std::vector<std::uint32_t> head_;
  std::vector<Node> nodes_;
};

}  // namespace slipcheck
