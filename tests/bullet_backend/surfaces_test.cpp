// Substrates that move and planes that are tilted, told to Bullet in the ways that there are.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "../support/extremes.h"
#include "bullet_run.h"

namespace slipcheck {
namespace {

class BulletSurfaces : public ::testing::TestWithParam<const char*> {
 protected:
  Settings settings(const char* surface_velocity) const {
    return with(shipped("physical"),
                {{"body", GetParam()}, {"surface_velocity", surface_velocity}});
  }
  RemoteEngine engine_{bullet_executable("double")};
};

TEST_P(BulletSurfaces, K24ABallAtRestOnABeltSlidesAndThenRollsWithTwoSeventhsOfIt) {
  const double mu = 0.2;
  Scene scene =
      scene_of(steel_ball(kRadius), {rolling_along_x(kRadius, 0, 0)}, ground_with_friction(mu));
  for (const double heading : {0.0, 22.5, 90.0}) {
    const Vector3 belt = 0.5 * direction(heading);
    scene.motion = SubstrateMotion::constant(belt.head<2>());
    for (const double rate : {240.0, 4000.0}) {
      for (const char* told : {"step_before", "this_step", "step_end"}) {
        std::size_t n = 0;
        for (const Frame& frame :
             run(engine_, scene, settings(told), rate, static_cast<std::size_t>(0.12 * rate))) {
          // Sliding ends at 2 V/(7 μ g) = 72.8 ms.
          const double t = static_cast<double>(++n) / rate;
          const double speed = std::min(mu * kGravity * t, 0.5 * 2 / 7);
          ASSERT_LT((frame.bodies[0].velocity - speed * direction(heading)).norm(), 1e-9)
              << told << ", " << rate << " Hz, " << heading << "°, " << t << " s";
        }
      }
    }
  }
}

TEST_P(BulletSurfaces, K24ARollingBallFollowsAShakerWithTwoSeventhsOfWhatBulletIsTold) {
  // Whatever the friction was: where a step ends without slip on what it takes for V, from rest
  // v = (2/7) V by the angular momentum about the contact.
  const double rate = 240, frequency = 3;
  const Vector2 amplitude(0.003, 0.001);
  Scene scene =
      scene_of(steel_ball(kRadius), {rolling_along_x(kRadius, 0, 0)}, ground_with_friction(2));
  const SubstrateMotion shaker =
      SubstrateMotion::oscillation(amplitude, frequency, std::numbers::pi / 2);  // V(0) = 0
  scene.motion = shaker;
  const auto place = [&](double t) { return shaker.position(t); };
  const double dt = 1 / rate;
  struct Way {
    const char* name;
    std::function<Vector3(double)> velocity;  // as told, of the step that ends at t
  };
  const Way ways[] = {
      {"step_before",
       [&](double t) -> Vector3 { return (place(t - dt) - place(t - 2 * dt)) / dt; }},
      {"this_step", [&](double t) -> Vector3 { return (place(t) - place(t - dt)) / dt; }},
      {"step_end", [&](double t) { return shaker.velocity(t); }}};
  for (const Way& way : ways) {
    std::size_t n = 0;
    for (const Frame& frame : run(engine_, scene, settings(way.name), rate, 240)) {
      const double t = static_cast<double>(++n) * dt;
      ASSERT_LT((frame.bodies[0].velocity - 2.0 / 7 * way.velocity(t)).norm(), 1e-9)
          << way.name << " at " << t;
      ASSERT_NEAR(frame.bodies[0].position.z(), kRadius, 1e-4 * kRadius);
    }
  }
}

TEST_P(BulletSurfaces, AStartInTheMiddleOfAMotionIsByItsClock) {
  Scene scene =
      scene_of(steel_ball(kRadius), {rolling_along_x(kRadius, 0, 0)}, ground_with_friction(2));
  scene.motion = SubstrateMotion::oscillation({0.003, 0}, 3, 0);
  const double start = 0.25 / 3, rate = 1000;  // V(start) = 0
  engine_.configure(scene, settings("step_end"), 1 / rate);
  engine_.start(scene.initial, start);
  std::size_t n = 0;
  engine_.advance(200, [&](const Frame& frame) {
    const double t = start + static_cast<double>(++n) / rate;
    EXPECT_NEAR(frame.bodies[0].velocity.x(), 2.0 / 7 * scene.motion.velocity(t).x(), 1e-9);
  });
}

TEST_P(BulletSurfaces, StaticFrictionHoldsABallOnAShakerThatKineticFrictionWouldNot) {
  // To roll it needs a friction of (2/7) a_S, up to 0.2 g, between μ_k g and μ_s g.
  const double rate = 1000, frequency = 3, omega = 2 * std::numbers::pi * frequency;
  const double amplitude = 0.2 * kGravity * 7 / 2 / (omega * omega);
  SubstrateContact ground = ground_with_friction(0.1);
  BodyState start = rolling_along_x(kRadius, 0, 0);
  const auto after_a_period = [&](double static_friction) {
    ground.static_friction = static_friction;
    Scene scene = scene_of(steel_ball(kRadius), {start}, ground);
    scene.motion = SubstrateMotion::oscillation({amplitude, 0}, frequency, std::numbers::pi / 2);
    double off = 0;  // from rolling [m/s]
    std::size_t n = 0;
    for (const Frame& frame : run(engine_, scene, settings("step_end"), rate, 333)) {
      const double t = static_cast<double>(++n) / rate;
      off = test::largest_of(
          off, std::abs(frame.bodies[0].velocity.x() - 2.0 / 7 * scene.motion.velocity(t).x()));
    }
    return off;
  };
  EXPECT_LT(after_a_period(0.3), 1e-9);
  EXPECT_GT(after_a_period(0.1), 1e-2);
}

TEST_P(BulletSurfaces, ATiltedPlaneIsTheSameAsATiltedGravity) {
  // K (16), (18), (24): a = (5/7) g sin θ − μ_r g cos θ down the slope, along which it rolls.
  const double theta = 0.2, mu_r = 0.02, time = 0.2, rate = 1000;
  SubstrateContact ground = ground_with_friction(0.5);
  ground.rolling = RollingFriction(mu_r);
  const double exact =
      (5.0 / 7 * std::sin(theta) - mu_r * std::cos(theta)) * kGravity * time;  // [m/s]
  for (const double heading : {0.0, 22.5, 90.0}) {
    Scene scene = scene_of(steel_ball(kRadius), {rolling_along_x(kRadius, 0, 0)}, ground);
    scene.gravity = kGravity * std::cos(theta);
    scene.downhill = kGravity * std::sin(theta) * direction(heading).head<2>();
    std::vector<BodyState> ends;
    for (const char* tilt : {"gravity", "plane"}) {
      const auto frames = run(engine_, scene, with(settings("step_end"), {{"tilt", tilt}}), rate,
                              static_cast<std::size_t>(time * rate));
      ends.push_back(frames.back().bodies[0]);
      if (GetParam() == std::string("rigid")) continue;  // its rolling friction has fixed axes
      EXPECT_LT((ends.back().velocity - exact * direction(heading)).norm(), 1e-9 * exact)
          << tilt << ", " << heading << "°";
    }
    if (GetParam() == std::string("rigid") && heading == 22.5) continue;
    EXPECT_LT((ends[1].velocity - ends[0].velocity).norm(), 1e-9 * exact) << heading;
    EXPECT_LT((ends[1].position - ends[0].position).norm(), 1e-9 * exact * time) << heading;
  }
}

TEST_P(BulletSurfaces, ABallBouncesDownATiltedPlaneAsUnderATiltedGravity) {
  const double theta = 0.3, rate = 240;
  SubstrateContact ground = ground_with_friction(0.3);
  ground.restitution = 0.7;
  BodyState start;
  start.position.z() = kRadius + 0.03;
  Scene scene = scene_of(steel_ball(kRadius), {start}, ground);
  scene.gravity = kGravity * std::cos(theta);
  scene.downhill = {0, kGravity * std::sin(theta)};
  const auto frames_with = [&](const char* tilt) {
    return run(engine_, scene,
               with(settings("step_end"), {{"tilt", tilt}, {"splits_at_contacts", 8.0}}), rate,
               100);
  };
  const auto by_gravity = frames_with("gravity"), by_plane = frames_with("plane");
  ASSERT_EQ(by_plane.size(), by_gravity.size());
  ASSERT_GT(by_plane.size(), 102u);  // it bounces
  for (std::size_t n = 0; n < by_plane.size(); ++n) {
    const BodyState &a = by_gravity[n].bodies[0], &b = by_plane[n].bodies[0];
    ASSERT_NEAR(by_plane[n].part, by_gravity[n].part, 1e-9) << n;
    ASSERT_LT((b.position - a.position).norm(), 1e-9) << n;
    ASSERT_LT((b.velocity - a.velocity).norm(), 1e-9) << n;
    ASSERT_LT((b.angular_velocity - a.angular_velocity).norm(), 1e-6) << n;
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, BulletSurfaces, ::testing::Values("rigid", "multibody"),
                         [](const auto& param) { return std::string(param.param); });

TEST(BulletSurfacesSaid, OnlyTheVelocityOfTheStepBeforeIsAmongWhatIsMissing) {
  RemoteEngine engine(bullet_executable("double"));
  Scene scene =
      scene_of(steel_ball(kRadius), {rolling_along_x(kRadius, 0, 0)}, ground_with_friction(0.2));
  scene.motion = SubstrateMotion::constant({0.1, 0});
  const auto missing = [&](const char* told) {
    return texts_of(engine.configure(scene, {{"surface_velocity", told}}, 1e-3).not_represented);
  };
  EXPECT_EQ(missing("step_before"),
            std::vector<std::string>{"the substrate's velocity at the end of a step (it is the "
                                     "mean over the step before)"});
  EXPECT_TRUE(missing("step_end").empty());
}

}  // namespace
}  // namespace slipcheck
