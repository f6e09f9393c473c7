#include "harness/observe/box_observer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "../support/extremes.h"
#include "series.h"

namespace slipcheck {
namespace {

constexpr double kGravity = 9.81;
constexpr double kDiameter = 1e-3;

/// Spheres of 1 mm and 1 mg in a box; a floor of 100 Hz.
Scene box_scene(std::size_t count, double width, double frequency = 100) {
  Scene scene;
  scene.gravity = kGravity;
  scene.bodies.assign(count, Sphere{kDiameter / 2, 1e-6, 0.4});
  scene.initial.assign(count, BodyState{});
  scene.material.assign(count, 0);
  scene.box.emplace();
  scene.box->width = width;
  scene.box->floor = {5e-4, frequency};
  return scene;
}

/// One body at height z with an upward velocity v and a spin w.
Frame frame_of(double z, double v = 0, double w = 0) {
  Frame frame;
  frame.bodies.resize(1);
  frame.bodies[0].position = {5e-3, 0, z};
  frame.bodies[0].velocity = {0, 0, v};
  frame.bodies[0].angular_velocity = {0, w, 0};
  return frame;
}

Frame touching(std::vector<Touch> touches) {
  Frame frame;
  frame.bodies.resize(3);
  frame.touches = std::move(touches);
  return frame;
}

TEST(RestingHeight, IsLudings) {
  // L (14) with n_b = 9, n_h = 5, n_r = 5.
  const double by_hand = (9 * ((1 - 0.8660254037844386) * 5 + 0.8660254037844386 * 25) +
                          5 * (1 + std::numbers::sqrt3 * 5)) /
                         100 * kDiameter;
  EXPECT_NEAR(resting_height(box_scene(50, 10 * kDiameter)), by_hand, 1e-15);
  EXPECT_NEAR(by_hand, 2.492 * kDiameter, 0.0005 * kDiameter);
}

TEST(RestingHeight, IsThatOfTheLattice) {
  // Bodies put one after the other onto the sites of rows of nine.
  for (std::size_t count : {1u, 8u, 9u, 10u, 27u, 40u, 60u, 90u, 95u}) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i)
      sum += kDiameter * (0.5 + std::numbers::sqrt3 / 2 * static_cast<double>(i / 9));
    for (double width : {9.5, 9.9, 10.0, 10.4})
      EXPECT_NEAR(resting_height(box_scene(count, width * kDiameter)),
                  sum / static_cast<double>(count), 1e-14)
          << count << " " << width;
  }
}

TEST(RestingHeight, OfANarrowColumn) {
  // Bodies lean on alternate walls, 0.3 d0 apart across the box; straight above each other in 1 d0.
  EXPECT_NEAR(resting_height(box_scene(3, 1.3 * kDiameter)),
              kDiameter * (0.5 + std::sqrt(1 - 0.09)), 1e-11);
  EXPECT_NEAR(resting_height(box_scene(2, kDiameter)), kDiameter, 1e-11);
}

TEST(BoxObserver, SeesHeightAndEnergiesAsLudingDefinesThem) {
  Scene scene = box_scene(2, 10 * kDiameter);
  scene.bodies[1].mass = 3e-6;
  BoxObserver observer(scene, {});
  Frame frame;
  frame.bodies.resize(2);
  frame.bodies[0].position = {1e-3, 0, 4e-3};
  frame.bodies[0].velocity = {0.3, 0, -0.4};
  frame.bodies[1].position = {3e-3, 0, 2e-3};
  frame.bodies[1].angular_velocity = {0, -100, 0};
  observer.take(0, frame);
  observer.take(0.01, frame);
  ASSERT_EQ(observer.series().time.size(), 1u);
  // (1 · 4 + 3 · 2)/4 mm over the half diameter of both at rest on the floor.
  EXPECT_NEAR(observer.series().height[0], 2.5e-3 - 0.5e-3, 1e-17);
  EXPECT_NEAR(observer.series().kinetic_energy[0], 0.5 * 1e-6 * 0.25 / 2, 1e-20);
  EXPECT_NEAR(observer.series().rotational_energy[0], 0.5 * 0.4 * 3e-6 * 0.25e-6 * 1e4 / 2, 1e-22);
}

TEST(BoxObserver, SamplesEachPeriodOnceAfterTheDiscardedOnes) {
  const Scene scene = box_scene(1, 10 * kDiameter);
  BoxObserver observer(scene, {.discard = 20});
  // Steps of a third of a period, whose sums are rounded; some instants come twice.
  for (int n = 0; n <= 300; ++n) {
    const double t = n * (0.01 / 3);
    observer.take(t, frame_of(1e-3 + t));
    if (n % 3 == 0) observer.take(t, frame_of(1));
  }
  const BoxSeries& seen = observer.series();
  ASSERT_EQ(seen.time.size(), 80u);
  for (std::size_t k = 0; k < 80; ++k) {
    EXPECT_DOUBLE_EQ(seen.time[k], static_cast<double>(21 + k) * 0.01);
    // Frames at most 1e-9 of a period off.
    EXPECT_NEAR(seen.height[k], 0.5e-3 + seen.time[k], 1e-11);
  }
  EXPECT_EQ(observer.finish().samples, 80u);
  EXPECT_EQ(observer.finish().discarded, 20u);
}

TEST(BoxObserver, FallsBetweenFramesWithAnErrorOfSecondOrder) {
  // A throw up from the floor with 1 m/s, seen at phase zeros that lie between frames.
  const Scene scene = box_scene(1, 10 * kDiameter);
  for (double step : {1.0 / 240, 1.0 / 777, 1.0 / 6147.3}) {
    BoxObserver observer(scene, {});
    for (int n = 0; n * step < 0.2; ++n) {
      const double t = n * step;
      observer.take(t, frame_of(0.5e-3 + t - 0.5 * kGravity * t * t, 1 - kGravity * t));
    }
    const BoxSeries& seen = observer.series();
    ASSERT_GE(seen.time.size(), 18u);
    double worst = 0;
    for (std::size_t k = 0; k < seen.time.size(); ++k) {
      const double t = seen.time[k], v = 1 - kGravity * t;
      const double off = seen.height[k] - (t - 0.5 * kGravity * t * t);
      worst = test::largest_of(worst, std::abs(off));
      // A parabola lies over its chord by at most g h²/8; K is a parabola of second derivative m
      // g².
      EXPECT_LE(std::abs(off), kGravity * step * step / 8 + 1e-12);
      EXPECT_NEAR(seen.kinetic_energy[k], 0.5e-6 * v * v,
                  1e-6 * kGravity * kGravity * step * step / 8 + 1e-18);
    }
    // The bound is reached where a phase zero falls into the middle of a step.
    EXPECT_GT(worst, 0.5 * kGravity * step * step / 8) << step;
  }
}

TEST(BoxObserver, ANewTouchOfTwoBodiesIsACollision) {
  const Scene scene = box_scene(3, 10 * kDiameter);
  BoxObserver observer(scene, {.discard = 1});
  observer.take(0, touching({}));
  observer.take(0.005, touching({{0, 1, 1}}));  // before the samples begin
  observer.take(0.010, touching({{0, 1, 1}}));
  // One goes on, one is new, listed at two points; the floor is no body.
  observer.take(0.015, touching({{1, 2, 1}, {0, 1, 1}, {1, 2, 1}, {0, kSubstrate, 1}}));
  observer.take(0.020, touching({}));
  observer.take(0.025, touching({{0, 1, 1}, {0, 2, 1}}));
  observer.take(0.030, touching({{0, 2, 1}, {1, 2, 1}}));
  ASSERT_EQ(observer.series().collision_rate.size(), 2u);
  EXPECT_NEAR(observer.series().collision_rate[0], 1 / 0.01, 1e-9);
  EXPECT_NEAR(observer.series().collision_rate[1], 3 / 0.01, 1e-9);
}

TEST(BoxObserver, FramesThatCountCollisionsAreBelieved) {
  const Scene scene = box_scene(1, 10 * kDiameter);
  BoxObserver observer(scene, {});
  Frame frame = frame_of(1e-3);
  frame.collisions = 1000;
  for (int n = 0; n <= 64; ++n) {
    observer.take(n / 100.0, frame);
    *frame.collisions += n % 2 == 0 ? 3 : 5;
  }
  // 32 intervals of 3 and 32 of 5 in 0.01 s each.
  EXPECT_NEAR(observer.finish().collision_rate.mean, 400, 1e-9);
}

TEST(BoxObserver, ALateStartBeginsWithTheNextPhaseZero) {
  const Scene scene = box_scene(1, 10 * kDiameter);
  BoxObserver observer(scene, {.discard = 1});
  for (double t : {0.025, 0.035, 0.045}) observer.take(t, frame_of(t));
  ASSERT_EQ(observer.series().time.size(), 1u);
  EXPECT_DOUBLE_EQ(observer.series().time[0], 0.04);
  EXPECT_EQ(observer.finish().discarded, 3u);
}

TEST(BoxObserver, DropsWhatIsNotSteadyWhereAsked) {
  const Scene scene = box_scene(1, 10 * kDiameter);
  // H relaxes by 20 mm within 30 periods onto noise of 1 mm; so do the energies.
  const auto noise = test::correlated(2000, 0.5, 1);
  BoxObserver all(scene, {.discard = 10});
  BoxObserver steady(scene, {.discard = 10, .until_steady = true});
  for (int n = 0; n < 2000; ++n) {
    const double x = noise[static_cast<std::size_t>(n)] + 20 * std::exp(-n / 30.0);
    const Frame frame = frame_of(1e-3 * (10 + x), std::sqrt(10 + x), 100 * std::sqrt(10 + x));
    all.take(n / 100.0, frame);
    steady.take(n / 100.0, frame);
  }
  EXPECT_FALSE(all.finish().steady);
  EXPECT_EQ(all.finish().discarded, 10u);
  const BoxObservables seen = steady.finish();
  EXPECT_TRUE(seen.steady);
  // After 50 periods 20 e^(−5/3) = 3.8 of the noise is left, after 150 0.13.
  EXPECT_GT(seen.discarded, 50u);
  EXPECT_LT(seen.discarded, 400u);
  EXPECT_EQ(seen.samples + seen.discarded, 1999u);
  // Errors of the blocked means, √3 mm/√n = 0.04 mm: four of them.
  EXPECT_NEAR(seen.height.mean, 9.5e-3, 4 * seen.height.standard_error);
  EXPECT_NEAR(seen.height.standard_error, 1e-3 * std::sqrt(3.0 / 1800), 0.3 * 0.04e-3);
  EXPECT_NEAR(seen.kinetic_energy.mean, 0.5e-6 * 10, 4 * seen.kinetic_energy.standard_error);
  EXPECT_EQ(steady.series().time.size(), 1989u);
}

TEST(BoxObserver, AStillFloorNeedsAnInterval) {
  const Scene scene = box_scene(1, 10 * kDiameter, 0);
  BoxObserver observer(scene, {.interval = 0.5});
  for (int n = 0; n <= 10; ++n) observer.take(0.25 * n, frame_of(1e-3));
  EXPECT_EQ(observer.series().time, (std::vector<double>{0.5, 1, 1.5, 2, 2.5}));
  try {
    BoxObserver none(scene, {});
    FAIL() << "accepted";
  } catch (const std::invalid_argument& fault) {
    EXPECT_STREQ(fault.what(),
                 "a box whose floor has no frequency is sampled at an interval > 0, got 0 s");
  }
}

TEST(BoxObserver, NothingSeenIsNotObserved) {
  const Scene scene = box_scene(1, 10 * kDiameter);
  const BoxObservables seen = BoxObserver(scene, {.discard = 5, .until_steady = true}).finish();
  EXPECT_EQ(seen.samples, 0u);
  EXPECT_EQ(seen.discarded, 5u);
  EXPECT_FALSE(seen.steady);
  EXPECT_TRUE(std::isnan(seen.height.mean));
}

}  // namespace
}  // namespace slipcheck
