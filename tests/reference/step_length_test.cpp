#include "reference/steps/step_length.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "step_scenes.h"

namespace slipcheck {
namespace {

SoftContact spring(double stiffness) {
  return {LinearForce{stiffness, 0}, ContactEnd::zero_overlap, {}};
}

/// Three balls of 3, 1 and 2 kg of one material and one of 5 kg of another, one of which moves.
ContactScene four_balls() {
  Scene hard = test::steel_scene(4);
  hard.material = {0, 0, 0, 1};
  for (std::size_t i = 0; i < 4; ++i) hard.bodies[i].mass = std::array{3.0, 1.0, 2.0, 5.0}[i];
  hard.substrate.push_back(hard.substrate[0]);
  hard.pairs.assign(4, hard.pairs[0]);
  hard.initial.resize(4, test::rolling_at(0, 0, 0, 0));
  for (std::size_t i = 0; i < 4; ++i)
    hard.initial[i] = test::rolling_at(static_cast<double>(i), 0, i == 0 ? 0.1 : 0, 0);
  ContactScene scene = with_hard_contacts(std::move(hard));
  return scene;
}

// Half a period of a spring between two bodies: π √(m_eff/k), m_eff = m_1 m_2/(m_1 + m_2). The
// integration is good to 1e-6.
double half_period(double mass, double stiffness) { return M_PI * std::sqrt(mass / stiffness); }

TEST(StepLength, TheTwoLightestOfAMaterialCollideFastest) {
  ContactScene scene = four_balls();
  scene.soft[0] = spring(1e4);
  EXPECT_NEAR(shortest_collision(scene) / half_period(2.0 / 3, 1e4), 1, 1e-5);
}

TEST(StepLength, OfTwoMaterialsTheLightestOfEachDo) {
  ContactScene scene = four_balls();
  scene.soft[0] = spring(1e4);
  scene.soft[1] = scene.soft[2] = spring(1e6);
  EXPECT_NEAR(shortest_collision(scene) / half_period(5.0 / 6, 1e6), 1, 1e-5);
}

TEST(StepLength, OneBodyOfAMaterialHasNobodyToMeet) {
  ContactScene scene = four_balls();
  scene.soft[3] = spring(1e8);
  EXPECT_TRUE(std::isinf(shortest_collision(scene)));
}

TEST(StepLength, WhereNothingMovesNothingCollides) {
  ContactScene scene = four_balls();
  scene.soft[0] = spring(1e4);
  scene.hard.gravity = 0;
  for (BodyState& state : scene.hard.initial)
    state.velocity = state.angular_velocity = Vector3::Zero();
  EXPECT_TRUE(std::isinf(shortest_collision(scene)));
}

}  // namespace
}  // namespace slipcheck
