#include "studies/stability/rest_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "watched_runs.h"

namespace slipcheck {
namespace {

using namespace test;

/// Rolls at 0.2 m/s and rests half-way through 1 s.
PreparedScene rolls_to_rest(const std::string& substrate = "{}") {
  return prepared(plain_scene(
      "  - {name: a, material: ball, sphere: {radius: 0.01}, mass: 1, position: [0, 0], velocity: "
      "[0.2, 0], spin: rolling}\n",
      "friction: 0.5, rolling: 0.04", "{until: 1}", "", substrate));
}

TEST(RestWatch, ABodyThatRestsMayNotCreep) {
  const PreparedScene scene = rolls_to_rest();
  const ReferencePath path(scene);
  // v/(μ_r g) = 0.5 s, where rolling friction takes μ_r g from the speed (K 16).
  ASSERT_NEAR(path.rests_from(0), 0.5, 1.01 / 256);
  for (const double way : {0.0099, 0.0101}) {
    OutcomeWatch watch(path, {}, 0.1);
    watch.begin(0, path.states().front());
    BodyState s = path.states().back()[0];
    watch.take(0.6, frame_of({s}));
    s.position.x() += 0.01 * way;
    watch.take(0.7, frame_of({s}));
    EXPECT_NEAR(watch.phases()[0].creep, way, 1e-12);
    EXPECT_EQ(outcome_of(watch), way < 0.01 ? Outcome::accurate : Outcome::drifting);
  }
}

TEST(RestWatch, StoppingLateIsNoCreepWithinHalfOfTheRest) {
  const PreparedScene scene = rolls_to_rest();
  const ReferencePath path(scene);
  // Half of the rest is over at 0.75 s; a tenth of the scene's speed is 0.02 m/s, and what moves
  // faster has taken another course.
  const auto outcome = [&](double stop, double speed) {
    OutcomeWatch watch(path, {}, 0.01);
    BodyState s = path.states().front()[0];
    watch.begin(0, {&s, 1});
    s.velocity = Vector3(speed, 0, 0);
    s.angular_velocity.setZero();
    for (int n = 1; n <= 100; ++n) {
      if (0.01 * n < stop)
        s.position.x() += 0.01 * speed;
      else
        s.velocity.setZero();
      watch.take(0.01 * n, frame_of({s}));
    }
    return outcome_of(watch);
  };
  EXPECT_EQ(outcome(0.7, 0.01), Outcome::accurate);
  EXPECT_EQ(outcome(0.8, 0.01), Outcome::drifting);
  EXPECT_EQ(outcome(2, 0.0199), Outcome::drifting);
  EXPECT_EQ(outcome(2, 0.0201), Outcome::accurate);
}

TEST(RestWatch, ABodyThatIsHitDoesNotCreep) {
  // Its first frame after the blow is already far away; then it lies still again.
  const PreparedScene scene = rolls_to_rest();
  const ReferencePath path(scene);
  OutcomeWatch watch(path, {}, 0.1);
  watch.begin(0, path.states().front());
  BodyState s = path.states().back()[0];
  watch.take(0.6, frame_of({s}));
  s.velocity = Vector3(0.0201, 0, 0);
  s.position.x() += 0.005;
  watch.take(0.7, frame_of({s}));
  s.velocity.setZero();
  watch.take(0.8, frame_of({s}));
  EXPECT_EQ(outcome_of(watch), Outcome::accurate);
  s.position.x() += 0.005;
  watch.take(0.9, frame_of({s}));
  EXPECT_EQ(outcome_of(watch), Outcome::drifting);
}

TEST(RestWatch, RestIsOverTheSubstrate) {
  // On a belt of 0.3 m/s the ball that stays where the belt takes it rests; one that stays behind
  // creeps.
  const PreparedScene scene =
      prepared(plain_scene(ball("a", "[0, 0]", "[0.3, 0, 0]"), "friction: 0.5, rolling: 0.04",
                           "{until: 1}", "", "{motion: {kind: constant, velocity: [0.3, 0]}}"));
  const ReferencePath path(scene);
  EXPECT_EQ(path.rests_from(0), 0);
  for (const double speed : {0.3, 0.2}) {
    OutcomeWatch watch(path, {}, 0.1);
    BodyState s = path.states().front()[0];
    watch.begin(0, {&s, 1});
    s.position.x() += 0.1 * speed;
    watch.take(0.1, frame_of({s}));
    EXPECT_EQ(outcome_of(watch), speed == 0.3 ? Outcome::accurate : Outcome::drifting);
  }
}

}  // namespace
}  // namespace slipcheck
