#include "reference/near_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "all_near.h"
#include "reference/overlaps.h"
#include "soft_scenes.h"

namespace slipcheck {
namespace {

/// Radii from 1/ratio to 1, as many of each size on a logarithmic scale, in a box of these lengths.
std::vector<NearSphere> random_spheres(std::size_t n, double ratio, const Vector3& lengths,
                                       unsigned seed) {
  std::mt19937 dice(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<NearSphere> spheres(n);
  for (NearSphere& sphere : spheres) {
    sphere.radius = std::pow(ratio, -unit(dice));
    for (int k = 0; k < 3; ++k) sphere.position[k] = lengths[k] * unit(dice);
  }
  return spheres;
}

TEST(NearPairs, AreThoseOfAllPairsForUnlikeRadii) {
  for (const double ratio : {1.0, 3.0, 100.0})
    for (const double skin : {0.0, 0.3}) {
      const auto spheres = random_spheres(700, ratio, {24, 20, 16}, 7);
      const auto expected = all_near(spheres, skin, Vector2::Zero());
      ASSERT_GT(expected.size(), 20u) << ratio;
      EXPECT_EQ(near_pairs(spheres, skin), expected) << ratio << ' ' << skin;
    }
}

TEST(NearPairs, SeeAcrossTheEdgesOfAPeriodicPlane) {
  for (const double ratio : {1.0, 3.0})
    for (const Vector2& periodic : {Vector2(24, 20), Vector2(8, 0), Vector2(0, 9.7)}) {
      auto spheres = random_spheres(600, ratio, {24, 20, 6}, 3);
      // Positions are not folded into the cell.
      for (std::size_t i = 0; i < spheres.size(); i += 5)
        for (int k = 0; k < 2; ++k)
          spheres[i].position[k] += periodic[k] * (static_cast<double>(i % 7) - 3);
      const auto expected = all_near(spheres, 0.4, periodic);
      ASSERT_GT(expected.size(), 100u);
      EXPECT_EQ(near_pairs(spheres, 0.4, periodic), expected)
          << ratio << ' ' << periodic.transpose();
    }
}

TEST(NearPairs, AreFoundWhereverBodiesLie) {
  // Two of a heap that have flown far away, and all in a row.
  auto spheres = random_spheres(300, 2, {10, 10, 10}, 5);
  spheres[10].position = {1e9, -3e7, 2};
  spheres[200].position = {1e9 + 1, -3e7, 2};
  EXPECT_EQ(near_pairs(spheres, 0.1), all_near(spheres, 0.1, Vector2::Zero()));
  EXPECT_EQ(near_pairs(std::vector<NearSphere>(1), 0.1), std::vector<NearPair>{});
  const auto row = random_spheres(400, 3, {500, 0, 0}, 6);
  EXPECT_EQ(near_pairs(row, 0.1), all_near(row, 0.1, Vector2::Zero()));
}

TEST(NearPairs, InSharesAreTheSameWithoutAListOfAll) {
  for (const Vector2& periodic : {Vector2(0, 0), Vector2(40, 0)}) {
    const auto spheres = random_spheres(9000, 3, {40, 40, 40}, 11);
    std::vector<NearPair> found;
    std::size_t shares = 0, most = 0;
    near_pairs_in_shares(spheres, 0.2, periodic, [&](std::span<const NearPair> pairs) {
      found.insert(found.end(), pairs.begin(), pairs.end());
      ++shares;
      most = std::max(most, pairs.size());
    });
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, all_near(spheres, 0.2, periodic));
    EXPECT_GT(shares, 4u);
    EXPECT_LT(most, found.size() / 2);
  }
  near_pairs_in_shares(std::vector<NearSphere>(1), 0.1, Vector2::Zero(),
                       [](std::span<const NearPair>) { ADD_FAILURE() << "one has no pairs"; });
}

TEST(NearPairs, AreTheSameOnAnyNumberOfThreads) {
  const auto spheres = random_spheres(9000, 3, {40, 40, 40}, 9);
  const auto alone = near_pairs(spheres, 0.2);
  for (const std::size_t threads : {2, 3, 8}) {
    ThreadTeam team(threads);
    EXPECT_EQ(near_pairs(spheres, 0.2, Vector2::Zero(), &team), alone) << threads;
  }
}

TEST(Overlaps, HoldTheEnergyOfTheirSpringsAcrossAnEdge) {
  Scene scene = test::steel_scene(3);
  scene.periodic = {0.05, 0.05};
  const double d = 2 * scene.bodies[0].radius, depth = 1e-5;
  // Two over an edge of the cell and, each in an image of its own, over a corner.
  scene.initial[0].position = {0.001, 0.02, scene.bodies[0].radius};
  scene.initial[1].position = {0.001 - d + depth + 0.05, 0.02 + 0.1, scene.bodies[0].radius};
  scene.initial[2].position = {0.001, 0.02 + d, scene.bodies[0].radius};  // touches the first
  const ContactScene contacts = test::soft(scene);
  const double stiffness = std::get<LinearForce>(contacts.soft[0]->normal).stiffness;
  EXPECT_NEAR(elastic_energy(contacts, scene.initial), 0.5 * stiffness * depth * depth,
              1e-9 * stiffness * depth * depth);
  std::size_t count = 0;
  for_each_overlap(contacts, scene.initial, [&](const Overlap& at) {
    if (at.depth < 1e-12) return;  // round-off of what touches
    ++count;
    EXPECT_EQ(at.first, 0u);
    EXPECT_EQ(at.second, 1u);
    EXPECT_NEAR(at.depth, depth, 1e-15);
    EXPECT_NEAR(at.apart.x(), at.distance, 1e-15);
  });
  EXPECT_EQ(count, 1u);
  EXPECT_EQ(elastic_energy(with_hard_contacts(scene), scene.initial), 0);
}

}  // namespace
}  // namespace slipcheck
