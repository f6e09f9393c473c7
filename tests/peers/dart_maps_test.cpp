// What the maps of coefficients come to in DART, against closed forms.

#include "../bullet_backend/same_bits.h"
#include "peer_run.h"

namespace slipcheck::test {
namespace {

const std::string kDart = "dart";

TEST(DartMaps, SlidingIsBrakedByMuGAndOnDiagonalsRootTwoTimesAsMuch) {
  for (const auto& [degrees, factor] : {std::pair(0.0, 1.0), {45.0, std::sqrt(2)}}) {
    BodyState state = sliding_ball(2);
    state.velocity = 2 * direction(degrees);
    const Scene scene = scene_of(steel_ball(0.01), {state}, ground_with_friction(0.3));
    const auto frames = run_peer(kDart, scene, "physical", 1000, 50);
    const double lost = 2 - frames.back().bodies[0].velocity.norm();
    EXPECT_NEAR(lost / (0.3 * kGravity * 0.05), factor, 1e-6) << degrees;  // CFM 1e-9
  }
}

TEST(DartMaps, EachTwoHaveTheirOwnRestitutionInEveryPhase) {
  for (const double phase : {0.01, 0.4, 0.99})
    EXPECT_NEAR(head_on_restitution(kDart, "physical", 0.8, 0.3, phase, 240), 0.8, 1e-6);
}

TEST(DartMaps, BelowAReboundOfATenthOfALengthUnitPerSecondThereIsNone) {
  const Settings shipped = {{"collision_detector", "dart"}, {"max_error_reduction_velocity", 0.0}};
  // e v = 0.104 and 0.096 m/s. CFM 1e-5.
  EXPECT_NEAR(head_on_restitution(kDart, "default", 0.8, 0.13, 0.5, 240, shipped), 0.8, 1e-4);
  EXPECT_NEAR(head_on_restitution(kDart, "default", 0.8, 0.12, 0.5, 240, shipped), 0, 1e-4);
  EXPECT_NEAR(head_on_restitution(kDart, "physical", 0.8, 0.12, 0.5, 240), 0.8, 1e-6);
}

TEST(DartMaps, AReboundOffThePlaneIsThatOfTheSpeedAfterTheStepsGravity) {
  const double rate = 240, e = 0.8;
  SubstrateContact ground;
  ground.restitution = e;
  BodyState state;
  state.position = Vector3(0, 0, 0.0099);
  state.velocity = Vector3(0, 0, -1);
  const auto frames =
      run_peer(kDart, scene_of(steel_ball(0.01), {state}, ground), "physical", rate, 1);
  EXPECT_NEAR(frames[0].bodies[0].velocity.z(), e * (1 + kGravity / rate), 1e-6);
  ASSERT_EQ(frames[0].touches.size(), 1u);
  const double change = frames[0].bodies[0].velocity.z() + 1 + kGravity / rate;
  EXPECT_NEAR(frames[0].touches[0].normal_impulse / (steel_ball(0.01).mass * change), 1, 1e-9);
}

TEST(DartMaps, AFlyingBallMovesStraightOnHoweverItSpins) {
  // A FreeJoint counts velocities in the body's axes, which turn.
  const double rate = 240, v = 0.5;
  BodyState state = rolling_along_x(0.01, 0, v);
  state.position.z() = 1;
  Scene scene = scene_of(steel_ball(0.01), {state}, {});
  scene.gravity = 0;
  const BodyState last = run_peer(kDart, scene, "physical", rate, 240).back().bodies[0];
  EXPECT_NEAR(last.position.x(), v, 1e-12);
  EXPECT_NEAR(last.position.z(), 1, 1e-12);
  EXPECT_NEAR(last.angular_velocity.y(), v / 0.01, 1e-10);
}

TEST(DartMaps, ABeltCarriesABallUpToTwoSeventhsOfItsSpeed) {
  const auto frames = run_peer(kDart, belt(0.7), "physical", 1000, 400);
  EXPECT_NEAR(frames.back().bodies[0].velocity.x(), 0.2, 1e-6);
}

TEST(DartMaps, AFreshStartIsTheSameBitForBit) {
  const Scene scene = bundled_scene("ten-ball-break");
  RemoteEngine worker(peer_executable(kDart), kPatient);
  const Settings settings = peer_profile(kDart, "physical");
  const auto first = run(worker, scene, settings, 240, 120);
  expect_same_bits(run(worker, scene, settings, 240, 120), first);
}

TEST(DartMaps, WhatItLacksIsSaid) {
  RemoteEngine worker(peer_executable(kDart), kPatient);
  EXPECT_TRUE(lists(worker.configure(rolling_ball(0.02, 0.5, 0), {}, 1e-3), "rolling friction"));
  EXPECT_TRUE(lists(worker.configure(spinning_top(1e-4, 5), {}, 1e-3), "drilling friction"));
  EXPECT_TRUE(lists(worker.configure(bundled_scene("symmetric-30cms"), {}, 1e-3),
                    "restitution below 0.1 m/s"));
  EXPECT_THROW(worker.configure(bundled_scene("box-one-ball"), {}, 1e-3), Refused);
}

TEST(DartMaps, ABlockStopsAfterVSquaredOverTwoMuG) {
  const auto end = run_peer("dart", bundled_scene("block-stops"), "physical", 1000, 1000);
  // Half of the speed that friction takes in a step, over the whole way: 0.15 %.
  EXPECT_NEAR(end.back().bodies[0].position.x() / (4 / (2 * 0.3 * kGravity)), 1, 2e-3);
}

}  // namespace
}  // namespace slipcheck::test
