#include "harness/compare/closed_form_values.h"

#include <gtest/gtest.h>

#include "../scenes.h"
#include "hard_run.h"

namespace slipcheck {
namespace {

const std::vector<std::string> kNames = {"i", "j"};

/// Closed forms and the solver come to the same by different ways: within 1e-12 of the value, some
/// thousand roundings, and never further than ten times the solver's own uncertainty says.
void expect_agreement(const Scene& scene, std::size_t least) {
  const RunEnd end{Run::Until::rolling, 0, 100};
  const ReferenceResult result = test::run_hard(scene, end, kNames);
  ASSERT_TRUE(result.run.reached) << result.run.reason;
  EXPECT_GE(result.closed_form.size(), least);
  for (const auto& [name, expected] : result.closed_form)
    EXPECT_NEAR(result.observables.at(name).value, expected, 1e-12 * (std::abs(expected) + 1e-3))
        << name;
}

TEST(ClosedFormValues, AgreeWithTheSolverOnEveryKindOfPair) {
  for (double e : {0.5, 0.7, 0.8, 0.9, 0.95, 1.0}) {
    expect_agreement(test::head_on(0.15, -0.15, e), 20);  // symmetric
    expect_agreement(test::head_on(0.2, -0.1, e), 20);    // asymmetric
    expect_agreement(test::head_on(0.3, 0, e), 20);       // target at rest
    Scene oblique = test::head_on(0.3, 0, e, 0.01);
    oblique.initial[0].position.y() = 0.002;
    expect_agreement(oblique, 20);
    Scene unlike = test::head_on(0.3, -0.05, e);
    unlike.bodies[1].mass *= 3;
    unlike.bodies[1].shape_factor = 2.0 / 3;
    expect_agreement(unlike, 20);
  }
  Scene power = test::head_on(0.15, -0.15, 1);
  power.pairs[0].restitution = PowerLawRestitution{0.9, 0.05, 0.1};
  expect_agreement(power, 20);
}

TEST(ClosedFormValues, AgreeOnOneBody) {
  Scene slide = test::steel_scene(1);
  slide.initial[0].velocity = {0.5, 0.1, 0};
  slide.initial[0].angular_velocity = {10, -20, 0};
  expect_agreement(slide, 4);

  Scene roll = test::steel_scene(1);
  roll.substrate[0].rolling = RollingFriction(0.02);
  roll.substrate[0].drilling_length = 1e-5;
  roll.initial[0] = test::rolling_at(0, 0, 0.3, 0.4);
  roll.initial[0].angular_velocity.z() = 7;
  const ReferenceResult result = test::run_hard(roll, {Run::Until::rest, 0, 100}, {"i"});
  ASSERT_EQ(result.closed_form.size(), 3u);
  for (const auto& [name, expected] : result.closed_form)
    EXPECT_NEAR(result.observables.at(name).value, expected, 1e-12 * expected) << name;
}

TEST(ClosedFormValues, StayAwayFromWhatTheyDoNotCover) {
  Scene rubbing = test::head_on(0.3, 0, 0.9);
  rubbing.pairs[0].friction = 0.1;
  EXPECT_TRUE(closed_form_values(rubbing, kNames).empty());
  Scene parting = test::head_on(-0.1, 0.1, 0.9);
  EXPECT_TRUE(closed_form_values(parting, kNames).empty());
  Scene sliding = test::head_on(0.1, -0.1, 0.9);
  sliding.initial[0].angular_velocity.setZero();
  EXPECT_TRUE(closed_form_values(sliding, kNames).empty());
  EXPECT_TRUE(closed_form_values(test::steel_scene(3), {"a", "b", "c"}).empty());
}

TEST(ClosedFormValues, AreNotShownWhereTheRunEndsBeforeThePairMeets) {
  const Scene scene = test::head_on(0.15, -0.15, 0.9);
  const ReferenceResult before = test::run_hard(scene, until_time(0.01), kNames);
  EXPECT_EQ(before.run.collisions, 0u);
  EXPECT_TRUE(before.closed_form.empty());
  // Met, but still sliding: only what has been seen by then.
  const ReferenceResult sliding = test::run_hard(scene, until_time(0.03), kNames);
  EXPECT_TRUE(sliding.closed_form.contains("i-j.restitution"));
  EXPECT_FALSE(sliding.closed_form.contains("i.sliding_time"));
}

TEST(ClosedFormValues, AreNotShownWhereThePairCollidesAgain) {
  // e_n < 1/A: the spins drive the balls together; the closed form's single collision is not all.
  const ReferenceResult result =
      test::run_hard(test::head_on(0.15, -0.15, 0.3), {Run::Until::rolling, 0, 10}, kNames);
  EXPECT_GT(result.run.collisions, 1u);
  EXPECT_TRUE(result.closed_form.empty());
}

}  // namespace
}  // namespace slipcheck
