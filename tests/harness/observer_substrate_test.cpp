// What the observer makes of a substrate that moves or is tilted: frames of exact paths.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "../scenes.h"
#include "harness/observe/observer.h"

namespace slipcheck {
namespace {

constexpr double kG = 9.81, kMu = 0.1, kR = 0.002, kA = 2.5;

Frame on_plane(const BodyState& state) { return {{state}, {{0, kSubstrate, 1}}}; }

/// An engine's frames of a path.
Observer watched(const Scene& scene, double scale, double step, double end,
                 const std::function<BodyState(double)>& path) {
  Observer observer(scene, step, scale);
  observer.take(0, on_plane(path(0)));
  for (int n = 1; n * step <= end; ++n) observer.take(n * step, on_plane(path(n * step)));
  return observer;
}

BodyState state_of(double x, double v, double rim) {
  BodyState state;
  state.position = {x, 0, kR};
  state.velocity = {v, 0, 0};
  state.angular_velocity = rolling_angular_velocity({rim, 0, 0}, kR);
  return state;
}

/// A sphere at rest that is put on a belt of speed V: the belt drags it with μ g, which turns it
/// too, until after t^s = V/((1+A) μ g) it rolls on the belt, at V/(1+A).
BodyState put_on_belt(double V, double t) {
  const double a = kMu * kG, t_s = V / ((1 + kA) * a);
  const double slid = std::min(t, t_s), rolled = std::max(0.0, t - t_s);
  const double v = a * slid;
  // u = v − rim − V with the rim's speed turning against the motion.
  return state_of(0.5 * a * slid * slid + v * rolled, v, -kA * a * slid);
}

TEST(ObserverOnABelt, SlipAndSlidingAreRelativeToIt) {
  const double V = 0.4;
  Scene scene = test::steel_scene(1);
  scene.motion = SubstrateMotion::constant({V, 0});
  const double a = kMu * kG, t_s = V / ((1 + kA) * a);
  for (double step : {0.013, 0.0007}) {
    const Observables seen =
        watched(scene, V, step, 0.3, [&](double t) { return put_on_belt(V, t); }).finish(0.3);
    const BodyObservables& body = seen.bodies[0];
    // The slip falls in a straight line.
    EXPECT_NEAR(body.sliding_time, t_s, 1e-12);
    // Over the belt; linear between two frames of a parabola: ¼ of a h².
    EXPECT_NEAR(body.sliding_distance, V * t_s - 0.5 * a * t_s * t_s, 0.25 * a * step * step);
    // Velocities are those of the laboratory.
    EXPECT_NEAR(body.rolling_velocity.x(), V / (1 + kA), 1e-14);
    EXPECT_NEAR(body.final_velocity.x(), V / (1 + kA), 1e-14);
    EXPECT_TRUE(std::isnan(body.stopping_time));
  }
}

TEST(ObserverOnABelt, ABodyRestsThatMovesWithIt) {
  const double V = 0.4, w = 0.1, mu_r = 0.02, a = mu_r * kG;
  Scene scene = test::steel_scene(1);
  scene.substrate[0].rolling = RollingFriction(mu_r);
  scene.motion = SubstrateMotion::constant({V, 0});
  const auto path = [&](double t) {
    const double braked = std::min(t, w / a);
    return state_of(V * t + w * braked - 0.5 * a * braked * braked, V + w - a * braked,
                    w - a * braked);
  };
  const double step = 0.007;
  const Observer observer = watched(scene, V + w, step, 1, path);
  EXPECT_TRUE(observer.everything_rests());
  const BodyObservables body = observer.finish(1).bodies[0];
  EXPECT_EQ(body.sliding_time, 0);
  EXPECT_NEAR(body.stopping_time, w / a, 1e-12);
  EXPECT_NEAR(body.stopping_distance, w * w / (2 * a), a * step * step);
  EXPECT_NEAR(body.final_velocity.x(), V, 1e-15);
}

TEST(ObserverOnABelt, AKinkOfTheMotionStartsASlide) {
  // At rest until 0.1 s, then V. The reference shows the last instant before the kink and the kink.
  const double V = 0.2, kink = 0.1, t_s = V / ((1 + kA) * kMu * kG);
  Scene scene = test::steel_scene(1);
  scene.motion = SubstrateMotion::table({{kink, {0, 0}}, {9, {V * 8.9, 0}}});
  Observer observer(scene, 0, V);
  observer.take(0, on_plane(put_on_belt(V, 0)));
  observer.take(std::nextafter(kink, 0), on_plane(put_on_belt(V, 0)));
  EXPECT_FALSE(observer.anything_slides_or_flies());
  observer.take(kink, on_plane(put_on_belt(V, 0)));
  EXPECT_TRUE(observer.anything_slides_or_flies());
  BodyState rolls = put_on_belt(V, t_s);
  rolls.angular_velocity = rolling_angular_velocity(rolls.velocity - Vector3(V, 0, 0), kR);
  observer.take(kink + t_s, on_plane(rolls));
  const BodyObservables body = observer.finish(kink + t_s).bodies[0];
  EXPECT_NEAR(body.sliding_time, t_s, 1e-15);
  EXPECT_NEAR(observer.last_slide_end(), kink + t_s, 1e-15);
  EXPECT_NEAR(body.sliding_distance, V * t_s - 0.5 * kMu * kG * t_s * t_s, 1e-15);
}

TEST(ObserverOnAShaker, RollingWithTwoSeventhsOfItsAccelerationIsNoSliding) {
  // K (15): a = a_S/(1+A), so the body follows with x_S/(1+A).
  Scene scene = test::steel_scene(1);
  scene.motion = SubstrateMotion::oscillation({0.001, 0}, 5, 0);
  const auto path = [&](double t) {
    const double x = scene.motion.position(t).x(), v = scene.motion.velocity(t).x();
    return state_of(x / (1 + kA), v / (1 + kA), v / (1 + kA) - v);
  };
  const double scale = scene.motion.largest_speed();
  for (double step : {0.0, 0.001}) {
    const double interval = step > 0 ? step : 0.001;
    Observer observer(scene, step, scale);
    for (int n = 0; n < 1000; ++n) {
      observer.take(n * interval, on_plane(path(n * interval)));
      // It has the substrate's velocity now and then, but never stays with it.
      EXPECT_FALSE(observer.everything_rests());
      EXPECT_FALSE(observer.anything_slides_or_flies());
    }
    EXPECT_EQ(observer.finish(1).bodies[0].sliding_time, 0);
  }
}

/// A slope on which a sphere that rolls is pulled by (5/7) a_G along x.
Scene slope(double a_G, double mu_r) {
  Scene scene = test::steel_scene(1);
  scene.downhill = {a_G, 0};
  scene.substrate[0].rolling = RollingFriction(mu_r);
  return scene;
}

TEST(ObserverOnASlope, WhereABodyTurnsRoundItDoesNotRest) {
  // Uphill at 0.2 m/s, then down again; at the turn a frame shows no speed at all.
  const double a_G = 0.7, a = a_G * kA / (1 + kA), turn = 0.2 / a;
  const Scene scene = slope(a_G, 0);
  const auto path = [&](double t) {
    return state_of(-0.2 * t + 0.5 * a * t * t, -0.2 + a * t, -0.2 + a * t);
  };
  for (double step : {0.0, turn / 20}) {
    Observer observer(scene, step, 0.2);
    for (int n = 0; n <= 40; ++n) {
      observer.take(n * turn / 20, on_plane(path(n * turn / 20)));
      EXPECT_FALSE(observer.everything_rests());
    }
    EXPECT_TRUE(std::isnan(observer.finish(2 * turn).bodies[0].stopping_time));
  }
}

TEST(ObserverOnASlope, RollingFrictionThatHoldsTheBodyStopsIt) {
  // Uphill: gravity and rolling friction both brake.
  const double a_G = 0.14, mu_r = 0.02, a = a_G * kA / (1 + kA) + mu_r * kG, stop = 0.2 / a;
  const Scene scene = slope(a_G, mu_r);
  const auto path = [&](double t) {
    const double s = std::min(t, stop);
    return state_of(-0.2 * s + 0.5 * a * s * s, -0.2 + a * s, -0.2 + a * s);
  };
  const double step = stop / 20.3;
  const Observer observer = watched(scene, 0.2, step, 1.5 * stop, path);
  EXPECT_TRUE(observer.everything_rests());
  const BodyObservables body = observer.finish(1.5 * stop).bodies[0];
  EXPECT_NEAR(body.stopping_time, stop, 1e-12);
  EXPECT_NEAR(body.stopping_distance, 0.04 / (2 * a), a * step * step);
  // What cannot hold it lets it go at once.
  const Scene steep = slope(0.4, mu_r);
  Observer rolls_away(steep, 0, 0.2);
  rolls_away.take(0, on_plane(state_of(0, 0, 0)));
  EXPECT_FALSE(rolls_away.everything_rests());
}

TEST(ObserverOnASlope, FindsTheEndOfASlideInsideAStep) {
  // Downhill without spin: v̇ = a_G − μ g, u̇ = a_G − (1+A) μ g.
  const double a_G = 0.5, v0 = 0.3, fall = (1 + kA) * kMu * kG - a_G, t_s = v0 / fall;
  const Scene scene = slope(a_G, 0);
  const auto path = [&](double t) {
    const double s = std::min(t, t_s), r = std::max(0.0, t - t_s);
    const double v = v0 + (a_G - kMu * kG) * s + a_G * kA / (1 + kA) * r;
    return state_of(0, v, t < t_s ? kA * kMu * kG * s : v);
  };
  for (double step : {0.009, 0.0011}) {
    const BodyObservables body = watched(scene, v0, step, 0.3, path).finish(0.3).bodies[0];
    EXPECT_NEAR(body.sliding_time, t_s, 1e-12) << step;
  }
}

TEST(ObserverOfCoupledDrilling, SlipThatDiesOutHasEndedAtAMillionthOfTheScenesSpeed) {
  Scene scene = test::steel_scene(1);
  BodyState slow = state_of(0, 0.1 + 0.9e-6 * 0.3, 0.1),
            faster = state_of(0, 0.1 + 1.1e-6 * 0.3, 0.1);
  for (BodyState* state : {&slow, &faster}) state->angular_velocity.z() = 10;
  const auto slides_at_last = [&](const BodyState& last) {
    Observer observer(scene, 0, 0.3);
    observer.take(0, on_plane(state_of(0, 0.3, 0)));
    observer.take(0.1, on_plane(last));
    return observer.anything_slides_or_flies();
  };
  EXPECT_TRUE(slides_at_last(slow));
  scene.substrate[0].coupled_radius = 1e-4;
  EXPECT_FALSE(slides_at_last(slow));
  EXPECT_TRUE(slides_at_last(faster));
}

}  // namespace
}  // namespace slipcheck
