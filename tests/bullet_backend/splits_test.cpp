// Steps that end where bodies touch (splits_at_contacts): what the frames inside a step are, and
// what they make of collisions.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bullet_box.h"

namespace slipcheck {
namespace {

constexpr double kMu = 0.1;

/// Two steel balls that roll at each other along a heading with `speed` together, `steps` from
/// touching.
Scene head_on(double speed, double heading, double steps, double rate, double e) {
  PairContact pair;
  pair.restitution = e;
  const double place = kRadius + 0.5 * steps * speed / rate;
  return scene_of(steel_ball(kRadius),
                  {rolling_towards(kRadius, 0.5 * speed, heading, -place),
                   rolling_towards(kRadius, -0.5 * speed, heading, place)},
                  ground_with_friction(kMu), pair);
}

class BulletSplits : public ::testing::TestWithParam<const char*> {
 protected:
  Settings splitting() const {
    return with(shipped("physical"), {{"body", GetParam()}, {"splits_at_contacts", 8.0}});
  }
  RemoteEngine engine_{bullet_executable("double")};
};

TEST_P(BulletSplits, BallsPartWithTheirRestitutionInEveryPhase) {
  const double e = 0.9, speed = 0.3;
  for (const double rate : {60.0, 240.0, 16000.0}) {
    for (int k = 0; k < 16; ++k) {
      const double steps = 2 + (k + 0.5) / 16;
      const Scene scene = head_on(speed, 22.5, steps, rate, e);
      const auto frames = run(engine_, scene, splitting(), rate, 5);
      const auto hit = std::ranges::find_if(frames, touch_each_other);
      ASSERT_NE(hit, frames.end());
      const Vector3 n = direction(22.5);
      const double parting = n.dot(hit->bodies[1].velocity - hit->bodies[0].velocity);
      EXPECT_NEAR(parting / speed, e, 1e-9) << rate << " Hz, " << steps;
      // Friction on the plane acts for a millionth of the step, and does not turn them yet: the
      // spin is that from before.
      const double rubbed = 2 * kMu * kGravity * 1e-6 / rate;  // [m/s]
      for (std::size_t i : {0u, 1u}) {
        const Vector3 change =
            kRadius * (hit->bodies[i].angular_velocity - scene.initial[i].angular_velocity);
        EXPECT_LT(change.norm(), 2.5 * rubbed + 1e-12) << rate << " Hz, " << steps;
      }
      // The touch is where they touch.
      const double gap = (hit->bodies[1].position - hit->bodies[0].position).norm() - 2 * kRadius;
      EXPECT_NEAR(gap, 0, 1e-4 * kRadius);
    }
  }
}

TEST_P(BulletSplits, SinglePrecisionIsAsGoodAsItsRounding) {
  const double e = 0.9, speed = 0.3;
  RemoteEngine single(bullet_executable("single"));
  for (const double rate : {60.0, 240.0, 4000.0}) {
    for (int k = 0; k < 16; ++k) {
      const Scene scene = head_on(speed, 22.5, 2 + (k + 0.5) / 16, rate, e);
      const auto frames = run(single, scene, splitting(), rate, 5);
      const auto hit = std::ranges::find_if(frames, touch_each_other);
      ASSERT_NE(hit, frames.end());
      const double parting = direction(22.5).dot(hit->bodies[1].velocity - hit->bodies[0].velocity);
      // Friction on the plane acts for 5e-7 s, the shortest step that Bullet takes here.
      EXPECT_NEAR(parting / speed, e, 1e-5) << rate << " Hz, " << k;
    }
  }
}

TEST_P(BulletSplits, UnequalBallsPartByTheMomentumLaw) {
  const double e = 0.7, rate = 240;
  for (const double phase : {0.05, 0.5, 0.95}) {
    Scene scene = head_on(0.3, 0, 2 + phase, rate, e);
    scene.bodies[1].mass *= 3;
    const double m0 = scene.bodies[0].mass, m1 = scene.bodies[1].mass;
    const auto frames = run(engine_, scene, splitting(), rate, 5);
    const auto hit = std::ranges::find_if(frames, touch_each_other);
    ASSERT_NE(hit, frames.end());
    const double impulse = (1 + e) * 0.3 * m0 * m1 / (m0 + m1);
    const double tolerance = 4 * kMu * kGravity * 1e-6 / rate;  // friction's, as above [m/s]
    EXPECT_NEAR(hit->bodies[0].velocity.x(), 0.15 - impulse / m0, tolerance);
    EXPECT_NEAR(hit->bodies[1].velocity.x(), -0.15 + impulse / m1, tolerance);
    const auto touch = std::ranges::find_if(
        hit->touches, [](const Touch& each) { return each.second != kSubstrate; });
    EXPECT_NEAR(touch->normal_impulse / impulse, 1, 1e-6);
  }
}

TEST_P(BulletSplits, AnObliqueHitGoesAlongTheLineOfCentresAtTheTouch) {
  // In the air, b = distance of the paths, at 16 phases: n at the touch makes sin α = b/2R with the
  // velocity; without friction each keeps what is across n and swaps (1 + e)/2 of what is along it.
  const double e = 0.8, speed = 0.5, rate = 240;
  PairContact pair;
  pair.restitution = e;
  for (const double sine : {0.0, 0.5, 0.9}) {
    const double cosine = std::sqrt(1 - sine * sine);
    const Vector3 n(cosine, sine, 0);
    for (int k = 0; k < 16; ++k) {
      BodyState left, right;
      left.position = Vector3(0, 0, 1);
      right.position = left.position + 2 * kRadius * n;
      left.position.x() -= (2 + (k + 0.5) / 16) * speed / rate;
      left.velocity = Vector3(speed, 0, 0);
      const Scene scene = scene_of(steel_ball(kRadius), {left, right}, {}, pair);
      const auto frames = run(engine_, scene, splitting(), rate, 5);
      const auto hit = std::ranges::find_if(frames, touch_each_other);
      ASSERT_NE(hit, frames.end());
      const Vector3 given = 0.5 * (1 + e) * speed * cosine * n;
      const Vector3 struck = hit->bodies[1].velocity, striker = hit->bodies[0].velocity;
      // They overlap by up to the tolerance, 1e-4 R, which turns n by as much over tan α.
      const double tolerance = 2e-4 * speed;
      EXPECT_NEAR(struck.x(), given.x(), tolerance) << "sin α = " << sine << ", " << k;
      EXPECT_NEAR(struck.y(), given.y(), tolerance) << "sin α = " << sine << ", " << k;
      EXPECT_NEAR(striker.x(), speed - given.x(), tolerance);
      EXPECT_NEAR(striker.y(), -given.y(), tolerance);
    }
  }
}

TEST_P(BulletSplits, FramesInsideAStepAreInOrderAndEachGoesOnFromTheLast) {
  const double rate = 240;
  const std::size_t steps = 40;
  const Scene scene = head_on(0.3, 45, 2.3, rate, 0.9);
  const auto frames = run(engine_, scene, splitting(), rate, steps);
  std::size_t whole = 0;
  double before = 0;  // part of the step that has passed
  std::vector<BodyState> last = scene.initial;
  for (const Frame& frame : frames) {
    ASSERT_GT(frame.part, before);
    ASSERT_LE(frame.part, 1);
    // Bullet moves with the velocity that it has just found: x' = x + v' h.
    for (std::size_t i : {0u, 1u}) {
      const Vector3 way = (frame.part - before) / rate * frame.bodies[i].velocity;
      ASSERT_LT((frame.bodies[i].position - last[i].position - way).norm(), 1e-14);
    }
    last = frame.bodies;
    whole += frame.part == 1;
    before = frame.part == 1 ? 0 : frame.part;
  }
  EXPECT_EQ(before, 0);
  EXPECT_EQ(whole, steps);
  EXPECT_GT(frames.size(), steps);      // the collision made some
  EXPECT_LE(frames.size(), steps + 8);  // but rolling makes none
}

TEST_P(BulletSplits, ALateClockDoesNotSwallowTheImpact) {
  // A millionth of a step at 16 kHz is below the rounding of a clock that stands at 1e6 s.
  const double rate = 16000, e = 0.9, speed = 0.3;
  const Scene scene = head_on(speed, 0, 2.5, rate, e);
  engine_.configure(scene, splitting(), 1 / rate);
  engine_.start(scene.initial, 1e6);
  std::vector<Frame> frames;
  engine_.advance(5, [&](const Frame& frame) { frames.push_back(frame); });
  const auto hit = std::ranges::find_if(frames, touch_each_other);
  ASSERT_NE(hit, frames.end());
  EXPECT_NEAR((hit->bodies[1].velocity - hit->bodies[0].velocity).x() / speed, e, 1e-9);
}

TEST_P(BulletSplits, ADroppedBallComesBackWithItsRestitution) {
  SubstrateContact ground = ground_with_friction(kMu);
  const double e = 0.8;
  ground.restitution = e;
  for (const double rate : {60.0, 240.0, 1000.0}) {
    for (int k = 0; k < 8; ++k) {
      BodyState start;
      const double height = 0.1 + 0.0013 * k;
      start.position = Vector3(0, 0, kRadius + height);
      const Scene scene = scene_of(steel_ball(kRadius), {start}, ground);
      const auto frames =
          run(engine_, scene, splitting(), rate, static_cast<std::size_t>(0.2 * rate));
      const auto hit =
          std::ranges::find_if(frames, [](const Frame& frame) { return !frame.touches.empty(); });
      ASSERT_NE(hit, frames.end());
      ASSERT_NE(hit, frames.begin());
      const double down = -(hit - 1)->bodies[0].velocity.z();
      // Semi-implicit Euler is g t dt/2 further down than the parabola, and so lands up to g dt
      // slower.
      const double exact = std::sqrt(2 * kGravity * height);
      EXPECT_LT(down, exact) << height;
      EXPECT_GT(down, exact - kGravity / rate) << height;
      EXPECT_NEAR(hit->bodies[0].velocity.z() / down, e, 1e-9) << rate << " Hz, " << height;
    }
  }
}

TEST_P(BulletSplits, ASmallTargetIsHitHoweverFarABallGoesInAStep) {
  const double e = 0.9, speed = 5, rate = 240;  // 21 mm in a step, five diameters
  PairContact pair;
  pair.restitution = e;
  int missed_without = 0;
  for (int k = 0; k < 16; ++k) {
    const double place = 2 * kRadius + (2 + (k + 0.5) / 16) * speed / rate;
    const Scene scene =
        scene_of(steel_ball(kRadius),
                 {rolling_along_x(kRadius, -place, speed), rolling_along_x(kRadius, 0, 0)},
                 ground_with_friction(kMu), pair);
    const auto struck_with = [&](double splits) {
      const auto frames =
          run(engine_, scene, with(splitting(), {{"splits_at_contacts", splits}}), rate, 5);
      const auto hit = std::ranges::find_if(frames, touch_each_other);
      return hit == frames.end() ? 0 : hit->bodies[1].velocity.x();
    };
    EXPECT_NEAR(struck_with(8) / speed, 0.5 * (1 + e), 1e-6) << k;
    missed_without += struck_with(0) == 0;
  }
  EXPECT_GE(missed_without, 8);
}

TEST_P(BulletSplits, AShakenFloorIsMetWhereAndWhenItIs) {
  // Without gravity the ball comes down with 0.5 m/s onto z_f(t): the touch is the first root of
  // z0 − 0.5 t − R = z_f(t), and v' = V + e (V + 0.5) there.
  const double e = 0.9, rate = 1000, down = 0.5;
  for (int k = 0; k < 16; ++k) {
    Scene scene = box_of(steel_ball(kRadius), {in_plane(0.1, 0.006 + 0.0004 * k, 0, -down)});
    scene.box->floor = {0.002, 25};  // V = 0.31 m/s, A ω² = 49 m/s²
    scene.box->on_floor[0].restitution = e;
    const ShakenFloor& floor = scene.box->floor;
    double before = 0, after = 0.1;
    for (double t = 0; t < 0.1; t += 1e-4) {  // the floor is slower than the ball: one root only
      const double gap = scene.initial[0].position.z() - down * t - kRadius - floor.height(t);
      if (gap < 0) {
        after = t;
        break;
      }
      before = t;
    }
    for (int half = 0; half < 60; ++half) {
      const double t = 0.5 * (before + after);
      const double gap = scene.initial[0].position.z() - down * t - kRadius - floor.height(t);
      (gap > 0 ? before : after) = t;
    }
    const double velocity = floor.velocity(before);
    const auto frames = run(engine_, scene, splitting(), rate, 40);
    const auto hit =
        std::ranges::find_if(frames, [](const Frame& frame) { return !frame.touches.empty(); });
    ASSERT_NE(hit, frames.end());
    // A gap of 1e-4 R counts as touching: 1e-6 s at the slowest approach, in which (1 + e) V
    // changes by 1e-4 m/s.
    EXPECT_NEAR(hit->bodies[0].velocity.z(), velocity + e * (velocity + down), 1.5e-4) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, BulletSplits, ::testing::Values("rigid", "multibody"),
                         [](const auto& param) { return std::string(param.param); });

}  // namespace
}  // namespace slipcheck
