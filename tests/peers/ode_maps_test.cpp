// What the maps of coefficients come to in ODE, against closed forms. A row of dWorldStep is solved
// exactly, so that what is left is the step's and rounding.

#include "../bullet_backend/same_bits.h"
#include "peer_run.h"

namespace slipcheck::test {
namespace {

const std::string kOde = "ode";

TEST(OdeMaps, SlidingIsBrakedByMuG) {
  const Scene scene = scene_of(steel_ball(0.01), {sliding_ball(2)}, ground_with_friction(0.3));
  const auto frames = run_peer(kOde, scene, "default", 1000, 50);
  // CFM 1e-10 against 1/m of 30 1/kg.
  EXPECT_NEAR((2 - frames.back().bodies[0].velocity.x()) / (0.3 * kGravity * 0.05), 1, 1e-9);
}

TEST(OdeMaps, OnDiagonalsAxesBrakeRootTwoTimesAsMuchAndTheSlipsDirectionDoesNot) {
  BodyState state = sliding_ball(2);
  state.velocity = 2 * direction(45);
  const Scene scene = scene_of(steel_ball(0.01), {state}, ground_with_friction(0.3));
  for (const auto& [profile, factor] : {std::pair("default", std::sqrt(2)), {"physical", 1.0}}) {
    const auto frames = run_peer(kOde, scene, profile, 1000, 50);
    const double lost = 2 - frames.back().bodies[0].velocity.norm();
    EXPECT_NEAR(lost / (0.3 * kGravity * 0.05), factor, 1e-9) << profile;
  }
}

TEST(OdeMaps, RollingIsBrakedByMuRG) {
  EXPECT_NEAR(rolling_ratio(kOde, "default", 0), 1, 1e-6);
  EXPECT_NEAR(rolling_ratio(kOde, "default", 45), std::sqrt(2), 1e-6);
  for (const double degrees : {0.0, 22.5, 45.0})
    EXPECT_NEAR(rolling_ratio(kOde, "physical", degrees), 1, 1e-6) << degrees;
  EXPECT_NEAR(rolling_ratio(kOde, "physical", 30, {{"stepper", "quick_step"}}), 1, 1e-2);
}

TEST(OdeMaps, ASpinIsBrakedByItsDrillingLength) {
  const double length = 2e-4;
  const auto frames = run_peer(kOde, spinning_top(length, 50), "default", 1000, 200);
  const double lost = 50 - frames.back().bodies[0].angular_velocity.z();
  EXPECT_NEAR(lost / (length * kGravity / (0.4 * 0.01 * 0.01) * 0.2), 1, 1e-9);
}

TEST(OdeMaps, ARestitutionIsExactInEveryPhaseAndSoIsALaw) {
  for (const double phase : {0.01, 0.4, 0.99}) {
    EXPECT_NEAR(head_on_restitution(kOde, "default", 0.8, 0.3, phase, 240), 0.8, 1e-7);
    for (const double speed : {0.05, 0.5, 2.0})
      EXPECT_NEAR(head_on_restitution(kOde, "default", PowerLawRestitution{0.9, 0.1, 0.01}, speed,
                                      phase, 1000),
                  0.9 * std::pow(speed / 0.01, -0.1), 1e-7);
  }
}

TEST(OdeMaps, ARestitutionBelowTheErrorReductionIsThePush) {
  // Overlap (1 − φ) v dt, of which erp = 0.2 is pushed out in a step: v_n' = max(e v, 0.2 (1 − φ)
  // v).
  EXPECT_NEAR(head_on_restitution(kOde, "default", 0.05, 0.3, 0.25, 240), 0.15, 1e-7);
  EXPECT_NEAR(head_on_restitution(kOde, "default", 0.05, 0.3, 0.9, 240), 0.05, 1e-7);
}

TEST(OdeMaps, ABeltCarriesABallUpToTwoSeventhsOfItsSpeed) {
  for (const char* profile : {"default", "physical"}) {
    const auto frames = run_peer(kOde, belt(0.7), profile, 1000, 400);
    EXPECT_NEAR(frames.back().bodies[0].velocity.x(), 0.2, 1e-7) << profile;
    EXPECT_NEAR(frames.back().bodies[0].angular_velocity.y(), (0.2 - 0.7) / 0.01, 1e-4) << profile;
  }
}

TEST(OdeMaps, StaticFrictionHoldsWhereKineticWouldNot) {
  SubstrateContact ground = ground_with_friction(0.1);
  ground.static_friction = 0.5;
  Scene scene = scene_of(steel_ball(0.01), {sliding_ball(0)}, ground);
  // Rolls down without slip up to 7/2 μ_s g, K (18): 2/7 of the pull is friction.
  scene.downhill = Vector2(1.0 * kGravity, 0);
  const auto held = run_peer(kOde, scene, "physical", 1000, 50);
  EXPECT_LT(slip_velocity(held.back().bodies[0], 0.01).norm(), 1e-6);
  const auto slipping = run_peer(kOde, scene, "default", 1000, 50);
  EXPECT_GT(slip_velocity(slipping.back().bodies[0], 0.01).norm(), 0.1);
}

TEST(OdeMaps, ABallInAShakenBoxStaysInItsPlane) {
  Scene scene = scene_of(steel_ball(0.01), {sliding_ball(0)}, {});
  Box& box = scene.box.emplace();
  box.width = 0.1;
  box.floor = {0.002, 20};
  box.moving_walls = true;
  box.on_floor = box.on_wall = box.on_lid = {PairContact{0.8, 0.3, 0}};
  scene.initial[0].position = Vector3(0.03, 0, 0.05);
  scene.initial[0].velocity = Vector3(1, 0, 0);
  const auto frames = run_peer(kOde, scene, "default", 1000, 2000);
  double highest = 0, widest = 0;
  for (const Frame& frame : frames) {
    const BodyState& ball = frame.bodies[0];
    ASSERT_EQ(ball.position.y(), 0);
    ASSERT_EQ(ball.angular_velocity.x(), 0);
    ASSERT_EQ(ball.angular_velocity.z(), 0);
    ASSERT_GT(ball.position.z(), 0.005);
    highest = std::max(highest, ball.position.z());
    widest = std::max(widest, ball.position.x());
  }
  EXPECT_GT(highest, 0.012) << "the floor throws it";
  EXPECT_LT(widest, 0.0925) << "a step beyond the wall at most";
}

TEST(OdeMaps, AFreshStartIsTheSameBitForBit) {
  const Scene scene = bundled_scene("ten-ball-break");
  for (const char* stepper : {"step", "quick_step"}) {
    RemoteEngine worker(peer_executable(kOde));
    const Settings settings = {{"stepper", stepper}};
    const auto first = run(worker, scene, settings, 240, 120);
    expect_same_bits(run(worker, scene, settings, 240, 120), first);
  }
}

/// The bundled scene's body at its end, after so many seconds at 1 kHz.
BodyState solid_end(const std::string& scene, double seconds) {
  return run_peer(kOde, bundled_scene(scene), "physical", 1000,
                  static_cast<std::size_t>(1000 * seconds))
      .back()
      .bodies[0];
}

TEST(OdeMaps, ACylinderRollsWithTwoThirdsAndABlockSlipsWhereItShould) {
  const double theta = 20 * std::numbers::pi / 180;
  const double a = 2.0 / 3 * kGravity * std::sin(theta);
  EXPECT_NEAR(-solid_end("cylinder-rolls", 1).velocity.y() / a, 1, 1e-3);
  // A step of the velocity it has after the step: v dt/2 too short.
  const double way = 4 / (2 * 0.3 * kGravity);
  EXPECT_NEAR(solid_end("block-stops", 2).position.x(), way, 1.1 * 2 * 1e-3 / 2);
}

/// v = g (sin θ − μ_k cos θ) t. Below what friction takes in a step, μ_k g cos θ dt, its slip
/// counts as none and it has its static friction: it comes to that by g (sin θ − μ_s cos θ) and
/// lags.
TEST(OdeMaps, ABlockSlipsDownASlopeThatIsTooSteep) {
  const double theta = 30 * std::numbers::pi / 180, dt = 1e-3;
  const double slow = kGravity * (std::sin(theta) - 0.5 * std::cos(theta));
  const double fast = kGravity * (std::sin(theta) - 0.4 * std::cos(theta));
  const double lag = 0.4 * kGravity * std::cos(theta) * dt * (fast / slow - 1);
  const BodyState end = solid_end("block-on-ramp-slips", 1);
  EXPECT_NEAR(end.velocity.norm(), fast, lag + fast * dt);
  EXPECT_LT(lag + fast * dt, 0.005 * fast);
}

TEST(OdeMaps, WhatItLacksIsSaid) {
  RemoteEngine worker(peer_executable(kOde));
  const Scene scene = rolling_ball(0.02, 0.5, 0);
  const Applied naive = worker.configure(scene, peer_profile(kOde, "naive"), 1e-3);
  EXPECT_TRUE(lists(naive, "the limit of friction (without dContactApprox1"));
  EXPECT_TRUE(lists(naive, "rolling friction (mu_r in the place of a length)"));
  const Applied physical = worker.configure(scene, peer_profile(kOde, "physical"), 1e-3);
  EXPECT_TRUE(physical.not_represented.empty());
  Scene periodic = scene;
  periodic.periodic = Vector2(1, 1);
  EXPECT_THROW(worker.configure(periodic, {}, 1e-3), Refused);
}

}  // namespace
}  // namespace slipcheck::test
