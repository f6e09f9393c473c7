#include "reference/events/cell_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace slipcheck {
namespace {

/// Bodies on a torus of cells, with a record of their own of who is in which cell.
struct CellWalk {
  static constexpr std::uint32_t kAcross = 5, kAlong = 6;

  CellWalk(std::size_t n, bool periodic)
      : grid(n, 2.0, 3.0, kAcross, kAlong, periodic, periodic), x(n), y(n) {
    for (std::uint32_t i = 0; i < n; ++i) {
      x[i] = static_cast<int>(random() % kAcross);
      y[i] = static_cast<int>(random() % kAlong);
      grid.insert(i, x[i], y[i]);
    }
  }
  static int folded(int i, std::uint32_t n) {
    const int m = static_cast<int>(n);
    return ((i % m) + m) % m;
  }
  void move(std::uint32_t i, int dx, int dy) {
    grid.move(i, dx, dy);
    x[i] = folded(x[i] + dx, kAcross);
    y[i] = folded(y[i] + dy, kAlong);
  }

  std::mt19937_64 random{11};
  CellGrid grid;
  std::vector<int> x, y;
};

struct Seen {
  std::uint32_t body;
  double x, y;
  auto operator<=>(const Seen&) const = default;
};

/// Who is near by looking at everybody, with the periods [m] that bring it there.
std::vector<Seen> near_by_search(const CellWalk& walk, std::uint32_t i, bool periodic) {
  std::vector<Seen> seen;
  for (std::uint32_t j = 0; j < walk.x.size(); ++j)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = walk.x[i] + dx, y = walk.y[i] + dy;
        const int at_x = CellWalk::folded(x, CellWalk::kAcross);
        const int at_y = CellWalk::folded(y, CellWalk::kAlong);
        if (j == i || walk.x[j] != at_x || walk.y[j] != at_y) continue;
        seen.push_back({j, periodic ? 2.0 * (x - at_x) : 0, periodic ? 3.0 * (y - at_y) : 0});
      }
  return seen;
}

std::vector<Seen> as_seen(const CellGrid::Around& around) {
  std::vector<Seen> seen;
  for (const auto& [j, cell] : around.bodies())
    seen.push_back({j, around.shift[cell].x, around.shift[cell].y});
  return seen;
}

/// From almost empty cells to such as hold many more than find a place in the cell itself.
TEST(CellGrid, FindsThoseAroundHoweverManyAreInACell) {
  for (const bool periodic : {false, true}) {
    for (const std::size_t n : {2, 20, 60, 300}) {
      CellWalk walk(n, periodic);
      CellGrid::Around around(n);
      for (int k = 0; k < 2000; ++k) {
        const auto i = static_cast<std::uint32_t>(walk.random() % n);
        const int step = walk.random() % 2 == 0 ? 1 : -1;
        const bool across = walk.random() % 2 == 0;
        walk.move(i, across ? step : 0, across ? 0 : step);

        std::vector<Seen> expected = near_by_search(walk, i, periodic), visited;
        walk.grid.for_each_near(i, [&](std::uint32_t j, const CellGrid::Shift& shift) {
          visited.push_back({j, shift.x, shift.y});
        });
        walk.grid.find_near(i, around);
        ASSERT_EQ(as_seen(around), visited) << "the order too";
        std::ranges::sort(expected);
        std::ranges::sort(visited);
        ASSERT_EQ(visited, expected);

        visited.clear();
        walk.grid.for_each_newly_near(i, across ? step : 0, across ? 0 : step,
                                      [&](std::uint32_t j, const CellGrid::Shift& shift) {
                                        visited.push_back({j, shift.x, shift.y});
                                      });
        walk.grid.find_newly_near(i, across ? step : 0, across ? 0 : step, around);
        ASSERT_EQ(as_seen(around), visited);
        for (const Seen& seen : visited)
          ASSERT_NE(std::ranges::find(expected, seen), expected.end());
      }
    }
  }
}

/// Of bodies in one cell the last that came is seen first, as bodies that leave and come back show.
TEST(CellGrid, ShowsTheLatestFirst) {
  CellWalk walk(8, false);
  for (std::uint32_t i = 0; i < 8; ++i)
    while (walk.x[i] != 2 || walk.y[i] != 2) {
      const bool across = walk.x[i] != 2;
      walk.move(i, across ? 1 : 0, across ? 0 : 1);
    }
  std::vector<std::uint32_t> latest;  // who came last, first
  for (const std::uint32_t i : {5u, 0u, 3u, 7u, 1u, 6u, 2u, 4u, 3u, 0u}) {
    walk.move(i, 1, 0);
    walk.move(i, -1, 0);
    std::erase(latest, i);
    latest.insert(latest.begin(), i);
  }
  std::vector<std::uint32_t> seen;
  walk.grid.for_each_near(4, [&](std::uint32_t j, const CellGrid::Shift&) { seen.push_back(j); });
  std::erase(latest, 4u);
  EXPECT_EQ(seen, latest);
}

}  // namespace
}  // namespace slipcheck
