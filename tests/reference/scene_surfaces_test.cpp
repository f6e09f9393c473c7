#include <gtest/gtest.h>

#include <cmath>

#include "bundled_scenes.h"

// What the bundled scenes with surfaces beside the substrate were made for, as their reference
// shows it. Numbers of the files are repeated here in SI.

namespace slipcheck {
namespace {

using test::play;
using test::Played;

constexpr double kG = 9.80665;

/// The nose at 37 mm of a ball with R = 30.75 mm touches it at sin θ = (37 − 30.75)/(R + 1 mm)
/// over its centre, so that it comes to within R cos θ + (1 mm) cos θ of the nose's axis.
TEST(SurfaceScene, CushionsAreTouchedAboveTheCentre) {
  const Scenario scenario = test::bundled("three-cushion-shot");
  const ContactScene scene = make_contact_scene(scenario);
  const ReferenceSolver solver(scene, scenario.compare.reference);
  struct Hits final : FrameSink {
    void take(double, const Frame& frame) override {
      for (const Touch& touch : frame.touches)
        if (touch.second <= surface_touch(0)) at.push_back(frame.bodies[0].position);
    }
    std::vector<Vector3> at;
  } hits;
  ASSERT_TRUE(solver.run(run_end(scenario), &hits).reached);
  ASSERT_GE(hits.at.size(), 3u);
  const double radius = 0.03075, nose = 1e-3, over = 0.037 - radius;
  const double off = std::sqrt(std::pow(radius + nose, 2) - over * over);
  for (const Vector3& at : hits.at) {
    const double beside = std::min({at.x(), 2.84 - at.x(), at.y(), 1.42 - at.y()});
    EXPECT_NEAR(beside, off, 1e-12);
  }
}

/// Down the slope by 5/7 g sin θ, and from its edge along a parabola to the plate.
TEST(SurfaceScene, MarbleRollsFliesAndComesToRollOnTheBelt) {
  const Played marble = play("marble-run");
  ASSERT_TRUE(marble.run.reached) << marble.run.reason;
  const ContactScene& scene = marble.scene;
  const double theta = std::atan2(0.15, 0.5), R = 0.008, mu_r = 0.002;
  const double accelerated = 5.0 / 7 * kG * std::sin(theta) - mu_r * kG * std::cos(theta);
  const Vector3 start = scene.hard.initial[0].position;
  const Vector3 down(std::cos(theta), 0, -std::sin(theta)), up(std::sin(theta), 0, std::cos(theta));
  const double way = (Vector3(0.5, 0, 0.15) + R * up - start).dot(down);
  const double at_edge = std::sqrt(2 * accelerated * way);
  const Vector3 place = start + way * down, speed = at_edge * down;
  const double height = place.z() - (0.1 + R);
  const double fall = (speed.z() + std::sqrt(speed.z() * speed.z() + 2 * kG * height)) / kG;
  const ReferenceSolver solver(scene, Compare::Reference::automatic);
  EXPECT_NEAR(solver.first_contact(2), at_edge / accelerated + fall, 1e-11);
  // On the belt, which comes to meet it at 0.5 m/s, it rolls in the end.
  EXPECT_NEAR(marble["marble.final_position.z"], R, 1e-15);
  EXPECT_NEAR(marble["marble.final_angular_velocity.y"] * R,
              marble["marble.final_velocity.x"] + 0.5, 1e-12);
}

/// v = (v1 + v2)/2, Ω = −(v1 − v2)/(2 R): what rolls on both. The springs have come to rest by a
/// factor e^−20 or more.
TEST(SurfaceScene, BallBetweenBeltsRollsOnBoth) {
  const Played ball = play("ball-between-belts");
  ASSERT_TRUE(ball.run.reached) << ball.run.reason;
  EXPECT_NEAR(ball["ball.final_velocity.x"], 0.2, 1e-8);
  EXPECT_NEAR(ball["ball.final_angular_velocity.y"], -0.8 / (2 * 0.02), 1e-6);
}

}  // namespace
}  // namespace slipcheck
