// What an engine's frames tell of the end of a slide and of a landing: frames of exact paths, and
// of solvers that stop a body inside a step.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../scenes.h"
#include "../support/extremes.h"
#include "engine/remote_engine.h"
#include "harness/observe/observer.h"
#include "reference/events/event_solver.h"

namespace slipcheck {
namespace {

constexpr double kMu = 0.1, kG = 9.81, kR = 0.002;

/// A ball that slides along x at `v`, so fast that its lowest point has the slip `u` [m/s].
Frame sliding(double x, double v, double u) {
  Frame frame;
  frame.bodies = {test::rolling_at(x, 0, v - u, 0)};
  frame.bodies[0].velocity.x() = v;
  frame.touches = {{0, kSubstrate, 1}};
  return frame;
}

struct Slide {
  BodyObservables seen;
  int frames = 0;            ///< until the observer takes it for rolling
  int rolls_from = 0;        ///< the first frame without slip
  double rolling_speed = 0;  ///< from there on [m/s]
};

/// The slip `u0` [m/s] falls step by step by μ_k g (1+A) h times what `factor` gives for the step,
/// and at most to zero.
template <class Factor>
Slide slide(double u0, double h, const Factor& factor) {
  const Scene scene = test::steel_scene(1);
  Observer observer(scene, h, 1);
  double x = 0, v = 1, u = u0;
  observer.take(0, sliding(x, v, u));
  Slide result;
  for (int n = 1; result.frames == 0 || result.rolls_from == 0; ++n) {
    const double lost = std::min(u, 3.5 * kMu * kG * h * factor(n));
    u -= lost;
    v -= lost / 3.5;
    x += v * h;
    if (u == 0 && result.rolls_from == 0) result.rolls_from = n;
    if (result.frames > 0) continue;
    observer.take(n * h, sliding(x, v, u));
    if (observer.anything_slides_or_flies()) continue;
    result.frames = n;
    result.seen = observer.finish(observer.last_slide_end()).bodies[0];
  }
  result.rolling_speed = v;
  return result;
}

TEST(ObserverOfASlide, EndsWhereTheSlipDoesHoweverItFallsIntoTheStep) {
  for (const double h : {1.0 / 240, 1e-3, 0.5e-3}) {
    for (int k = 1; k < 100; ++k) {
      const double steps = 7 + k / 100.0;
      const double u0 = steps * 3.5 * kMu * kG * h;
      const Slide found = slide(u0, h, [](int) { return 1.0; });
      // Constant friction takes the slip in u0/((1+A) μ g), and 2/7 of it from the velocity.
      EXPECT_NEAR(found.seen.sliding_time, steps * h, 1e-12 * steps * h) << steps;
      EXPECT_NEAR(found.seen.rolling_velocity.x(), 1 - u0 / 3.5, 1e-14) << steps;
      EXPECT_EQ(found.frames, found.rolls_from) << steps;
    }
  }
}

TEST(ObserverOfASlide, EndsInOneOfTheStepsThatAnEngineMakesOfAStep) {
  // Four frames a step: half of what friction takes in the whole step is two of them.
  const Scene scene = test::steel_scene(1);
  const double h = 1.0 / 240, brake = 3.5 * kMu * kG * h / 4;
  for (int k = 0; k < 100; ++k) {
    const double parts = 21 + k / 25.0;
    Observer observer(scene, h, 1);
    for (int n = 0; n <= 30; ++n) {
      const double lost = std::min<double>(n, parts) * brake;
      observer.take(n * h / 4, sliding(n * h / 4, 1 - lost / 3.5, parts * brake - lost));
    }
    EXPECT_FALSE(observer.anything_slides_or_flies());
    const BodyObservables seen = observer.finish(observer.last_slide_end()).bodies[0];
    EXPECT_NEAR(seen.sliding_time, parts * h / 4, 1e-12) << parts;
    EXPECT_NEAR(seen.rolling_velocity.x(), 1 - parts * brake / 3.5, 1e-14) << parts;
  }
}

TEST(ObserverOfASlide, NeitherDropsSlipNorGoesPastAFrameThatRolls) {
  // A normal force that is not the same in all steps, as of a ball that jitters. What a solver may
  // leave in the step that ends a slide, a hundredth of what friction takes, is not waited for.
  std::mt19937 random(7);
  std::uniform_real_distribution<> jitter(0.6, 1.4), any(3, 9);
  const double h = 1e-3, brake = kMu * kG * h;
  for (int k = 0; k < 500; ++k) {
    const Slide found = slide(any(random) * 3.5 * brake, h, [&](int) { return jitter(random); });
    EXPECT_NEAR(found.seen.rolling_velocity.x(), found.rolling_speed, 0.014 * brake);
    EXPECT_GE(found.frames, found.rolls_from - 1);
    EXPECT_LE(found.frames, found.rolls_from);
    EXPECT_GT(found.seen.sliding_time, (found.frames - 1) * h);
    EXPECT_LE(found.seen.sliding_time, found.rolls_from * h * (1 + 1e-12));
  }
}

TEST(ObserverOfASlide, WhatAnEngineLeavesInEachStepIsNoSlide) {
  // Less than half of what friction takes, and for ever: the slide has ended in the first such
  // step.
  const double h = 1e-3, brake = 3.5 * kMu * kG * h;
  const Scene scene = test::steel_scene(1);
  Observer observer(scene, h, 1);
  for (int n = 0; n <= 12; ++n)
    observer.take(n * h, sliding(n * h, 1, std::max((8.5 - n) * brake, 0.3 * brake)));
  EXPECT_FALSE(observer.anything_slides_or_flies());
  EXPECT_NEAR(observer.finish(12 * h).bodies[0].sliding_time, 8.5 * h, 1e-12);
}

/// A ball that is thrown at 0.2 m/s without spin from 9 cm over a plane that returns 0.6 of its
/// speed, as an engine shows it: a touch in the step in which it lands.
class Thrown {
 public:
  Thrown() {
    scene = test::steel_scene(1);
    scene.substrate[0].restitution = 0.6;
    scene.substrate[0].static_friction = scene.substrate[0].kinetic_friction = 0.3;
    scene.initial[0].position.z() = kR + 0.09;
    scene.initial[0].velocity.x() = 0.2;
  }
  /// The observer once it takes the ball for rolling; `ended` is then that time [s].
  Observer watch(double h, double start, double& ended) const {
    EventSolver solver(scene, scene.initial);
    Observer observer(scene, h, speed_scale(scene, scene.initial));
    Frame frame;
    frame.bodies = scene.initial;
    observer.take(0, frame);
    double falls = 0;
    for (int n = 0; n * h < 2; ++n) {
      ended = start + n * h;
      solver.run(until_time(ended), nullptr);
      frame.bodies = solver.states();
      const BodyState& now = frame.bodies[0];
      const bool lies = now.position.z() <= kR * (1 + 1e-12);
      const bool bounced = now.velocity.z() > falls - kG * h + 1e-9;
      falls = now.velocity.z();
      frame.touches.clear();
      if (n > 0 && (lies || bounced)) frame.touches.push_back({0, kSubstrate, 1});
      observer.take(ended, frame);
      if (!observer.anything_slides_or_flies()) return observer;
    }
    ADD_FAILURE() << "never rolls";
    return observer;
  }

  Scene scene;
};

TEST(ObserverOfALanding, FlyingIsNotRolling) {
  // Bounces whose duration falls by e each: the last ends (1+e)/(1−e) times the fall after the
  // start. Its angular momentum about the line of contact stays: v = 5/7 of the first.
  const double end = 4 * std::sqrt(2 * 0.09 / kG);
  for (const double rate : {240.0, 480.0, 1000.0, 2000.0}) {
    for (const double phase : {0.03, 0.41, 0.77}) {
      double ended = 0;
      const double h = 1 / rate;
      const Thrown thrown;
      const Observer observer = thrown.watch(h, phase * h, ended);
      const Observables seen = observer.finish(observer.last_slide_end());
      EXPECT_NEAR(seen.bodies[0].rolling_velocity.x(), 0.2 * 5 / 7, 1e-12) << rate;
      // Hops below the speed of a step's fall, g h, are none: those left take 2 h/(1−e).
      EXPECT_GT(ended, end - 5 * h) << rate;
      EXPECT_LT(ended, end + 3 * h) << rate;
      EXPECT_LE(observer.last_slide_end(), ended);
      EXPECT_GT(observer.last_slide_end(), end - 6 * h);
      // It grips at its first touch, and what flies slides not.
      EXPECT_EQ(seen.bodies[0].sliding_time, 0) << rate;
    }
  }
}

TEST(ObserverOfALanding, ABodyThatComesDownRollingEndsItsRunThere) {
  Thrown thrown;
  thrown.scene.initial[0].angular_velocity =
      rolling_angular_velocity(thrown.scene.initial[0].velocity, kR);
  thrown.scene.substrate[0].restitution = 0;
  double ended = 0;
  const Observer observer = thrown.watch(1e-3, 0.4e-3, ended);
  const double lands = std::sqrt(2 * 0.09 / kG);
  EXPECT_NEAR(observer.last_slide_end(), lands, 1e-3);
  EXPECT_NEAR(ended, lands, 2e-3);
  EXPECT_NEAR(observer.finish(ended).bodies[0].rolling_velocity.x(), 0.2, 1e-12);
}

TEST(ObserverOfALanding, ARunsEndIsShownByTheFramesAroundIt) {
  // A ball that slides for 20.5 steps, x = v t − ½ μ g t², and rolls on; then an engine trembles,
  // at last in two frames that are 1e-9 s apart. What follows the end is no part of it.
  const double h = 1e-3, u0 = 20.5 * 3.5 * kMu * kG * h;
  const Scene scene = test::steel_scene(1);
  Observer observer(scene, h, 1);
  double time = 0, x = 0, v = 1, u = u0;
  observer.take(0, sliding(x, v, u));
  const auto step = [&](double dt, double tremble) {
    const double sliding_for = std::min(dt, u / (3.5 * kMu * kG));
    x += v * dt - kMu * kG * sliding_for * (dt - 0.5 * sliding_for);
    v -= kMu * kG * sliding_for;
    u = std::max(0.0, u - 3.5 * kMu * kG * sliding_for);
    time += dt;
    Frame frame = sliding(x, v, u);
    frame.bodies[0].velocity.z() = tremble;
    observer.take(time, frame);
  };
  for (int n = 0; n < 21; ++n) step(h, 0);
  for (int n = 0; n < 8; ++n) step(h, n % 2 ? 1e-3 : -1e-3);
  step(1e-9, 1e-3);
  const double end = observer.last_slide_end();
  EXPECT_NEAR(end, 20.5 * h, 1e-12);
  const BodyObservables seen = observer.finish(end).bodies[0];
  // Positions are linear between frames: off by at most μ g h²/8.
  EXPECT_NEAR(seen.final_position.x(), end - 0.5 * kMu * kG * end * end, kMu * kG * h * h / 8);
  EXPECT_NEAR(seen.final_velocity.x(), 1 - kMu * kG * end, kMu * kG * h);
  EXPECT_EQ(seen.final_velocity.z(), 0);
}

/// Two balls that meet at 30 cm/s in Bullet with its own settings, phase by phase: e_eff is the
/// speed at which the frames part once no frame slips any more, and nothing else.
TEST(ObserverOfBullet, EffectiveRestitutionIsThatOfFramesThatRoll) {
  const double speed = 0.3, rate = 1000;
  double most = 0;
  RemoteEngine engine(SLIPCHECK_BINARY_DIR "/slipcheck-engine-bullet-double");
  for (int k = 0; k < 64; ++k) {
    const Scene scene =
        test::head_on(speed / 2, -speed / 2, 0.9, kR + (3 + (k + 0.5) / 64) * speed / rate / 2);
    engine.configure(scene, {}, 1 / rate);
    engine.start(scene.initial);
    Observer observer(scene, 1 / rate, speed / 2);
    Frame frame;
    frame.bodies = scene.initial;
    frame.touches = {{0, kSubstrate, 1}, {1, kSubstrate, 1}};
    observer.take(0, frame);
    int n = 0;
    double parting = 0;
    engine.advance(150, [&](const Frame& now) {
      observer.take(++n / rate, now);
      parting = now.bodies[1].velocity.x() - now.bodies[0].velocity.x();
    });
    const double effective = observer.finish(n / rate).pairs.at(0).effective_restitution;
    // What a solver leaves in the step that ends a slide, a hundredth of what friction takes from
    // each ball, μ g h and half as much again where the ball jitters.
    EXPECT_NEAR(effective, parting / speed, 2 * 0.015 * kMu * kG / rate / speed) << k;
    most = test::largest_of(most, effective);
  }
  // (5 e_n − 2)/7 of the largest e_n, 0.9 + 0.2 · 127/128: docs/bullet-facts.md.
  EXPECT_NEAR(most, (5 * (0.9 + 0.2 * 127 / 128) - 2) / 7, 2e-3);
}

}  // namespace
}  // namespace slipcheck
