#include "harness/run/phases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../scenes.h"
#include "reference/reference_solver.h"

namespace slipcheck {
namespace {

TEST(Phases, OneInEachPartOfAStepAndTheSameEveryTime) {
  const double step = 1.0 / 240;
  const auto starts = phase_starts(0.05, step, 64);
  ASSERT_EQ(starts.size(), 64u);
  for (std::size_t k = 0; k < 64; ++k) {
    EXPECT_GE(starts[k], step * static_cast<double>(k) / 64);
    EXPECT_LT(starts[k], step * static_cast<double>(k + 1) / 64);
  }
  EXPECT_EQ(starts, phase_starts(0.05, step, 64));
}

TEST(Phases, NeverStartAfterTheFirstContact) {
  for (double start : phase_starts(0.001, 1.0 / 60, 32)) EXPECT_LT(start, 0.001);
}

TEST(Phases, OneRunWithoutAContact) {
  EXPECT_EQ(phase_starts(std::numeric_limits<double>::infinity(), 0.1, 32),
            std::vector<double>{0.0});
}

TEST(Phases, OneRunWithAContactFromTheStart) {
  EXPECT_EQ(phase_starts(0, 0.1, 32), std::vector<double>{0.0});
}

TEST(Phases, EnginesStartFromTheReferencesExactState) {
  const ContactScene scene = with_hard_contacts(test::head_on(0.15, -0.15, 0.9));
  const auto states = ReferenceSolver(scene, Compare::Reference::automatic).states_at(0.01);
  EXPECT_DOUBLE_EQ(states[0].position.x(), -0.005 + 0.15 * 0.01);
  EXPECT_EQ(states[0].velocity, scene.hard.initial[0].velocity);
}

}  // namespace
}  // namespace slipcheck
