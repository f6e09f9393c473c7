// What the maps of coefficients come to in MuJoCo, against closed forms. Its contacts are springs,
// so that what is left is their softness.

#include "../bullet_backend/same_bits.h"
#include "peer_backends/mujoco/restitution_spring.h"
#include "peer_run.h"

namespace slipcheck::test {
namespace {

const std::string kMujoco = "mujoco";

TEST(RestitutionSpring, ReboundsAsAnIntegrationOfItsForceDoes) {
  for (const double e : {0.05, 0.3, 0.8, 0.99}) {
    const double duration = 1e-2;
    const mujoco::Spring spring = mujoco::spring_of(e, duration);
    // Midpoint rule, from contact until the force would pull. Error ~ (ω dt)².
    double overlap = 0, v = 1, t = 0;
    const double dt = 1e-7;
    const auto force = [&](double x, double u) {
      return -spring.stiffness * x - spring.damping * u;
    };
    while (force(overlap, v) < 0 || t < dt) {
      const double middle = v + dt / 2 * force(overlap, v);
      const double x_middle = overlap + dt / 2 * v;
      v += dt * force(x_middle, middle);
      overlap += dt * middle;
      t += dt;
    }
    EXPECT_NEAR(-v, e, 1e-4) << e;
    EXPECT_NEAR(t, duration, 1e-5) << e;
  }
}

TEST(MujocoMaps, SlidingIsBrakedByMuG) {
  const Scene scene = scene_of(steel_ball(0.01), {sliding_ball(2)}, ground_with_friction(0.3));
  const auto frames = run_peer(kMujoco, scene, "physical", 1000, 200);
  // The contact carries the weight only on average: it begins without overlap.
  EXPECT_NEAR((2 - frames.back().bodies[0].velocity.x()) / (0.3 * kGravity * 0.2), 1, 0.05);
}

TEST(MujocoMaps, RollingIsBrakedByMuRGInAConeAndLessInAPyramid) {
  for (const double degrees : {0.0, 22.5, 45.0})
    EXPECT_NEAR(rolling_ratio(kMujoco, "physical", degrees), 1, 0.02) << degrees;
  EXPECT_LT(rolling_ratio(kMujoco, "default", 0), 0.9);
}

TEST(MujocoMaps, ASpringReboundsInEveryPhase) {
  // 16 steps a contact: its damper acts on the velocity before the step, by part of ω dt = π/16.
  for (const double e : {0.5, 0.8, 0.95})
    for (const double phase : {0.01, 0.4, 0.99})
      EXPECT_NEAR(head_on_restitution(kMujoco, "physical", e, 0.3, phase, 240), e, 0.03);
}

TEST(MujocoMaps, AsItShipsNothingBounces) {
  EXPECT_LT(head_on_restitution(kMujoco, "default", 0.9, 0.3, 0.5, 1000, {}), 0.2);
  RemoteEngine worker(peer_executable(kMujoco), kPatient);
  EXPECT_TRUE(lists(worker.configure(bundled_scene("symmetric-30cms"), {}, 1e-3), "restitution"));
}

TEST(MujocoMaps, ABeltCarriesABallUpToTwoSeventhsOfItsSpeed) {
  for (const char* profile : {"default", "physical"}) {
    const auto frames = run_peer(kMujoco, belt(0.7), profile, 1000, 800);
    EXPECT_NEAR(frames.back().bodies[0].velocity.x(), 0.2, 0.005) << profile;
  }
}

TEST(MujocoMaps, ABallInAShakenBoxStaysInItsPlane) {
  Scene scene = scene_of(steel_ball(0.01), {sliding_ball(0)}, {});
  Box& box = scene.box.emplace();
  box.width = 0.1;
  box.floor = {0.002, 20};
  box.moving_walls = true;
  box.on_floor = box.on_wall = box.on_lid = {PairContact{0.8, 0.3, 0}};
  scene.initial[0].position = Vector3(0.03, 0, 0.05);
  scene.initial[0].velocity = Vector3(1, 0, 0);
  const auto frames = run_peer(kMujoco, scene, "physical", 1000, 2000);
  double highest = 0, widest = 0;
  for (std::size_t n = 1000; n < frames.size(); ++n) {
    const BodyState& ball = frames[n].bodies[0];
    ASSERT_EQ(ball.position.y(), 0);
    ASSERT_GT(ball.position.z(), 0);
    highest = std::max(highest, ball.position.z());
    widest = std::max(widest, ball.position.x());
  }
  EXPECT_GT(highest, 0.012) << "the floor throws it";
  EXPECT_LT(widest, 0.0925);
}

TEST(MujocoMaps, AFreshStartIsTheSameBitForBit) {
  const Scene scene = bundled_scene("ten-ball-break");
  RemoteEngine worker(peer_executable(kMujoco), kPatient);
  const Settings settings = peer_profile(kMujoco, "default");
  const auto first = run(worker, scene, settings, 240, 120);
  expect_same_bits(run(worker, scene, settings, 240, 120), first);
}

TEST(MujocoMaps, WhatItLacksIsSaid) {
  RemoteEngine worker(peer_executable(kMujoco), kPatient);
  const Scene scene = rolling_ball(0.02, 0.5, 0);
  EXPECT_TRUE(lists(worker.configure(scene, peer_profile(kMujoco, "naive"), 1e-3),
                    "rolling friction (condim leaves it out)"));
  EXPECT_FALSE(lists(worker.configure(scene, peer_profile(kMujoco, "physical"), 1e-3),
                     "rolling friction ("));
}

/// The bundled scene's body at its end, after so many seconds at 1 kHz.
BodyState solid_end(const std::string& scene, double seconds) {
  return run_peer(kMujoco, bundled_scene(scene), "physical", 1000,
                  static_cast<std::size_t>(1000 * seconds))
      .back()
      .bodies[0];
}

TEST(MujocoMaps, ACylinderRollsWithTwoThirdsAndABlockStopsAfterVSquaredOverTwoMuG) {
  const double a = 2.0 / 3 * kGravity * std::sin(20 * std::numbers::pi / 180);
  EXPECT_NEAR(-solid_end("cylinder-rolls", 1).velocity.y() / a, 1, 0.01);
  EXPECT_NEAR(solid_end("block-stops", 2).position.x() / (4 / (2 * 0.3 * kGravity)), 1, 0.01);
}

TEST(MujocoMaps, WhatItCannotRunIsRefusedAndWhatItGivesUpIsNoResult) {
  RemoteEngine worker(peer_executable(kMujoco), kPatient);
  const Scene dust = scene_of(steel_ball(1e-6), {rolling_along_x(1e-6, 0, 1)}, {});
  EXPECT_THROW(worker.configure(dust, {}, 1e-3), Refused);
  // MuJoCo resets a state beyond 1e10 to where it began.
  const Scene beyond = scene_of(steel_ball(0.01), {sliding_ball(1e11)}, {});
  EXPECT_THROW(run(worker, beyond, {}, 1000, 3), WorkerFailure);
}

}  // namespace
}  // namespace slipcheck::test
