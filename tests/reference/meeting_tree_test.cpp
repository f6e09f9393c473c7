#include "reference/meeting_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "physics/numbers.h"
#include "reference/events/event_solver.h"
#include "reference/events/path_collision.h"
#include "soft_scenes.h"

namespace slipcheck {
namespace {

double touch(const StraightSphere& a, const StraightSphere& b, double horizon) {
  return time_to_touch(a.position - b.position, a.velocity - b.velocity, Vector3::Zero(),
                       a.radius + b.radius, horizon);
}

/// On a plane, of unlike radii, without overlap in the rows and columns of a lattice.
std::vector<StraightSphere> cloud(std::size_t side, double speed, double outwards, unsigned seed) {
  std::mt19937 dice(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<StraightSphere> spheres;
  for (std::size_t i = 0; i < side; ++i)
    for (std::size_t j = 0; j < side; ++j) {
      StraightSphere& one = spheres.emplace_back();
      one.radius = 0.2 + 0.1 * unit(dice);
      one.position = {static_cast<double>(i) + 0.15 * unit(dice),
                      static_cast<double>(j) + 0.15 * unit(dice), one.radius};
      const double middle = 0.5 * static_cast<double>(side - 1);
      one.velocity = outwards * (one.position - Vector3(middle, middle, one.radius)) +
                     speed * Vector3(unit(dice), unit(dice), 0);
    }
  return spheres;
}

TEST(MeetingTree, FindsTheFirstOfAllPairs) {
  std::size_t met = 0, parted = 0;
  for (unsigned seed = 1; seed <= 60; ++seed)
    for (const double outwards : {0.0, 0.3, 1.0})
      for (const double limit : {0.3, 3.0, kNever}) {
        const std::vector<StraightSphere> spheres = cloud(6, 0.2, outwards, seed);
        double first = kNever;
        for (std::size_t j = 0; j < spheres.size(); ++j)
          for (std::size_t i = 0; i < j; ++i)
            first = std::min(first, touch(spheres[i], spheres[j], limit));
        const double found = MeetingTree(spheres, false)
                                 .first(limit, [&](std::size_t i, std::size_t j, double horizon) {
                                   EXPECT_LT(i, j);
                                   return touch(spheres[i], spheres[j], horizon);
                                 });
        EXPECT_EQ(found, first) << seed << ' ' << outwards << ' ' << limit;
        ++(first < kNever ? met : parted);
      }
  EXPECT_GT(met, 50u);
  EXPECT_GT(parted, 50u);
}

/// A row as fast as the one before it comes to it where that one may stop.
TEST(MeetingTree, KnowsThatTheyMayStop) {
  std::vector<StraightSphere> rows;
  for (const double x : {0.0, 900.0})
    for (int k = 0; k < 20; ++k) rows.push_back({{x, 3.0 * k, 1}, {100, 0, 0}, 1});
  for (const bool may_stop : {false, true}) {
    bool asked = false;
    MeetingTree(rows, may_stop).first(20, [&](std::size_t i, std::size_t j, double) {
      asked |= i < 20 && j >= 20;
      return kNever;
    });
    EXPECT_EQ(asked, may_stop);
  }
}

/// Of 10⁴ that fly apart hardly any two are looked at, and of 10⁴ that do not those that are near.
TEST(MeetingTree, LooksAtFew) {
  for (const double outwards : {1.0, 0.0}) {
    const std::vector<StraightSphere> spheres = cloud(100, 0.2, outwards, 3);
    std::size_t looks = 0;
    const double found =
        MeetingTree(spheres, false).first(1e6, [&](std::size_t i, std::size_t j, double horizon) {
          ++looks;
          return touch(spheres[i], spheres[j], horizon);
        });
    EXPECT_EQ(found < kNever, outwards == 0);
    EXPECT_LT(looks, 200 * spheres.size()) << outwards;  // all pairs: 5000
  }
}

/// With cells a gas on an unbounded plane ends when it does over all pairs.
TEST(MeetingTree, EndsARunOfManyRollingBalls) {
  struct Case {
    double rolling, downhill;
  };
  for (const auto& [rolling, downhill] : {Case{0, 0}, Case{2e-3, 0}, Case{0, 0.5}}) {
    Scene scene = test::steel_scene(100);
    scene.downhill = {downhill, 0};
    std::mt19937 dice(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    scene.pairs = {{0.8, 0.0, -1.0}};
    scene.substrate[0].rolling = RollingFriction(rolling);
    for (std::size_t i = 0; i < 100; ++i) {
      scene.initial[i].position = {0.006 * static_cast<double>(i % 10),
                                   0.006 * static_cast<double>(i / 10), scene.bodies[i].radius};
      scene.initial[i].velocity = {0.1 * unit(dice), 0.1 * unit(dice), 0};
    }
    for (const auto until : {Run::Until::rolling, Run::Until::rest}) {
      if (rolling == 0 && until == Run::Until::rest) continue;
      const auto solve = [&](std::size_t most_without_cells) {
        EventSolver solver(scene, scene.initial, {.most_without_cells = most_without_cells});
        return solver.run({until, 0, 1e4}, nullptr);
      };
      const SolvedRun pairs = solve(100), cells = solve(24);
      EXPECT_TRUE(pairs.reached && cells.reached) << pairs.reason << cells.reason;
      EXPECT_GT(pairs.collisions, 20u);
      EXPECT_EQ(pairs.collisions, cells.collisions);
      EXPECT_NEAR(pairs.end_time, cells.end_time, 1e-6 * pairs.end_time);
    }
  }
}

}  // namespace
}  // namespace slipcheck
