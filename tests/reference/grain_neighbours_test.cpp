#include "reference/steps/grain_neighbours.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <vector>

#include "all_near.h"

namespace slipcheck {
namespace {

constexpr double kRadius = 0.5, kSkin = 0.3, kWidth = 2 * kRadius + kSkin;

/// In a rectangle; equal places on its edges among them.
GrainArrays random_grains(std::size_t n, double length_x, double length_y) {
  std::mt19937 dice(5);
  std::uniform_real_distribution<double> unit(0, 1);
  GrainArrays grains;
  grains.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    grains.x[i] = i % 9 == 0 ? 0 : length_x * unit(dice);
    grains.y[i] = i % 7 == 0 ? 0 : length_y * unit(dice);
  }
  return grains;
}

/// In the order of their cells.
GrainArrays sorted(const GrainArrays& grains, const std::vector<std::uint32_t>& order) {
  GrainArrays result;
  result.resize(grains.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    result.x[k] = grains.x[order[k]];
    result.y[k] = grains.y[order[k]];
  }
  return result;
}

std::vector<NearSphere> spheres_at(const GrainArrays& grains) {
  std::vector<NearSphere> spheres;
  for (std::size_t i = 0; i < grains.size(); ++i)
    spheres.push_back({{grains.x[i], grains.y[i], 0}, kRadius});
  return spheres;
}

/// 0: it does not repeat itself that way.
GrainPlane periodic_plane(double length_x, double length_y) {
  GrainPlane plane;
  plane.radius = kRadius;
  plane.length_x = length_x;
  plane.length_y = length_y;
  return plane;
}

/// Grains in no order, most of which are in cells of another thread's, and those in their order.
TEST(GrainNeighbours, LieAlikeWhoeverSortsThem) {
  const double x = 7.1 * kWidth, y = 5.1 * kWidth;
  const GrainPlane plane = periodic_plane(x, y);
  GrainArrays grains = random_grains(200, x, y);
  for (int turn = 0; turn < 2; ++turn) {
    ThreadTeam alone(1);
    GrainNeighbours expected;
    const std::vector<std::uint32_t>& order = expected.sort(grains, plane, kWidth, alone);
    for (const std::size_t threads : {2, 3, 8}) {
      ThreadTeam team(threads);
      GrainNeighbours neighbours;
      EXPECT_EQ(neighbours.sort(grains, plane, kWidth, team), order) << threads << " threads";
    }
    grains = sorted(grains, order);
  }
}

/// From one column or row of cells to many, as which the plane repeats in a direction or does not.
TEST(GrainNeighbours, AreThoseOfAllPairsWhateverTheCells) {
  for (const double columns : {1.0, 2.0, 3.0, 4.0, 11.0})
    for (const double rows : {1.0, 2.0, 3.0, 9.0})
      for (const auto& [repeats_x, repeats_y] :
           {std::pair(true, true), {true, false}, {false, true}, {false, false}})
        for (const std::size_t threads : {1, 3}) {
          const double x = 1.01 * columns * kWidth, y = 1.01 * rows * kWidth;
          const GrainPlane plane = periodic_plane(repeats_x ? x : 0, repeats_y ? y : 0);
          const auto n = static_cast<std::size_t>(20 + columns * rows);
          const GrainArrays grains = random_grains(n, x, y);
          ThreadTeam team(threads);
          GrainNeighbours neighbours;
          const std::vector<std::uint32_t>& order = neighbours.sort(grains, plane, kWidth, team);
          ASSERT_EQ(std::set(order.begin(), order.end()).size(), n);
          const GrainArrays in_order = sorted(grains, order);
          neighbours.find(in_order, plane, kSkin, team);
          std::vector<NearPair> found;
          for (std::size_t k = 0; k < neighbours.first().size(); ++k)
            found.push_back({neighbours.first()[k], neighbours.second()[k]});
          const auto expected =
              all_near(spheres_at(in_order), kSkin, {plane.length_x, plane.length_y});
          ASSERT_GT(expected.size(), n / 2);
          EXPECT_EQ(found, expected) << columns << " × " << rows << ", repeats: " << repeats_x
                                     << repeats_y << ", threads: " << threads;
          for (std::uint32_t k = 0; k < found.size(); ++k)
            ASSERT_EQ(neighbours.place_of(found[k].first, found[k].second), k);
        }
}

}  // namespace
}  // namespace slipcheck
