// Planes that repeat themselves: what meets across an edge is what meets within.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "bullet_run.h"

namespace slipcheck {
namespace {

constexpr double kCell = 0.1;  // [m]

/// Two that roll towards each other off their line, where the edges of a cell are or not.
Scene oblique_pair(const Vector3& place_of_second, bool repeats) {
  Scene scene = scene_of(steel_ball(kRadius),
                         {rolling_towards(kRadius, 0.3, 215), rolling_towards(kRadius, 0.3, 35)},
                         ground_with_friction(0.1), PairContact{0.9, 0.2, 0});
  scene.initial[0].position += Vector3(0.0023, 0.0017, 0);
  scene.initial[1].position += Vector3(-0.0022, -0.0012, 0) + place_of_second;
  if (repeats) scene.periodic = {kCell, kCell};
  return scene;
}

struct PeriodicCase {
  const char* name;
  Settings settings;
};

class BulletPeriodic : public testing::TestWithParam<PeriodicCase> {};

TEST_P(BulletPeriodic, AnImageIsHitAsTheBallItself) {
  RemoteEngine engine(bullet_executable("double"));
  const double rate = 2000;
  const std::size_t steps = 200;
  const Settings settings = GetParam().settings;
  const auto open = run(engine, oblique_pair(Vector3::Zero(), false), settings, rate, steps);
  ASSERT_LT(
      (open.back().bodies[0].velocity - open.front().bodies[0].velocity).dot(Vector3(-1, 0, 0)),
      -0.1)
      << "they have not met";
  // Beyond one edge, and round a corner, far away.
  for (const Vector3& away :
       {Vector3(kCell, 0, 0), Vector3(0, -kCell, 0), Vector3(3 * kCell, -2 * kCell, 0)}) {
    const auto across = run(engine, oblique_pair(away, true), settings, rate, steps);
    ASSERT_EQ(across.size(), open.size());
    bool has_touched = false;
    for (std::size_t n = 0; n < open.size(); ++n) {
      for (std::size_t i = 0; i < 2; ++i) {
        const BodyState &a = open[n].bodies[i], &b = across[n].bodies[i];
        // Rounding of places of 0.3 m, over a contact's stiffness: some 1e-15 m of 4 mm in a
        // normal.
        ASSERT_LT((a.velocity - b.velocity).norm(), 1e-9) << GetParam().name << " frame " << n;
        ASSERT_LT(kRadius * (a.angular_velocity - b.angular_velocity).norm(), 1e-9);
        ASSERT_LT((a.position + (i == 1 ? away : Vector3(Vector3::Zero())) - b.position).norm(),
                  1e-10);
      }
      ASSERT_EQ(open[n].touches.size(), across[n].touches.size()) << n;
      for (std::size_t k = 0; k < open[n].touches.size(); ++k) {
        const Touch &a = open[n].touches[k], &b = across[n].touches[k];
        EXPECT_EQ(a.first, b.first);
        EXPECT_EQ(a.second, b.second);
        has_touched |= b.second == 1;
      }
    }
    EXPECT_TRUE(has_touched);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BulletPeriodic,
    testing::Values(PeriodicCase{"default", kDefault},
                    PeriodicCase{"physical", shipped("physical")},
                    PeriodicCase{"tuned", shipped("tuned")},
                    PeriodicCase{"rigid", with(kDefault, {{"body", "rigid"}})},
                    PeriodicCase{"multibody", with(kDefault, {{"body", "multibody"}})},
                    PeriodicCase{"dantzig", with(kDefault, {{"solver", "dantzig"}})},
                    PeriodicCase{"splits",
                                 with(shipped("physical"), {{"splits_at_contacts", 8.0}})}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(BulletPeriodicGas, KeepsItsMomentum) {
  // No friction and no gravity: what two exchange is all that there is.
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> speed(-0.3, 0.3);
  std::vector<BodyState> states;
  for (int k = 0; k < 36; ++k) {
    BodyState state;
    state.position = Vector3(0.006 * (k % 6) + 0.001, 0.006 * (k / 6) + 0.001, kRadius);
    state.velocity = Vector3(speed(generator), speed(generator), 0);
    states.push_back(state);
  }
  Scene scene = scene_of(steel_ball(kRadius), states, {}, PairContact{1.0, 0.0, 0});
  scene.gravity = 0;
  scene.periodic = {0.036, 0.036};
  const auto sums = [&](const std::vector<BodyState>& bodies) {
    std::pair<Vector3, double> sum{Vector3::Zero(), 0};
    for (const BodyState& body : bodies) {
      sum.first += body.velocity;
      sum.second += body.velocity.squaredNorm();
    }
    return sum;
  };
  RemoteEngine engine(bullet_executable("double"));
  const auto frames = run(engine, scene, shipped("physical"), 2000, 600);
  const auto [momentum, energy] = sums(states);
  std::size_t across = 0;
  for (const Frame& frame : frames) {
    const auto [now, left] = sums(frame.bodies);
    ASSERT_LT((now - momentum).norm(), 1e-12 * std::sqrt(36 * energy));
    for (const Touch& touch : frame.touches) {
      if (touch.second < 0) continue;
      const Vector3 apart = frame.bodies[std::size_t(touch.first)].position -
                            frame.bodies[std::size_t(touch.second)].position;
      if (apart.norm() > 0.018) ++across;
    }
  }
  EXPECT_GT(across, 20u);
  // Nobody is in anybody at the end.
  const auto& last = frames.back().bodies;
  for (std::size_t i = 0; i < last.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vector3 apart = scene.to_nearest_image(last[i].position - last[j].position);
      EXPECT_GT(apart.norm(), 2 * kRadius * (1 - 0.15));  // 0.6 m/s in a step of 0.5 ms: 0.15 R
    }
}

}  // namespace
}  // namespace slipcheck
