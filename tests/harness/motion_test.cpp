#include "harness/observe/motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <string>

#include "../scenes.h"
#include "../support/bundled.h"
#include "../support/extremes.h"
#include "harness/observe/motion_quantities.h"
#include "harness/observe/motion_recorder.h"
#include "harness/run/reference_motion.h"
#include "harness/run/scene_run.h"
#include "scenario/load.h"

namespace slipcheck {
namespace {

using Pair = std::pair<int, int>;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Balls that go along x at 1 m/s and lie on the substrate.
std::vector<BodyState> moving_balls(std::size_t count, double time) {
  std::vector<BodyState> balls(count);
  for (std::size_t i = 0; i < count; ++i) {
    balls[i].position = {time, 0.01 * static_cast<double>(i), 0.002};
    balls[i].velocity = {1, 0, 0};
  }
  return balls;
}

// --- thinning ------------------------------------------------------------------------------------

TEST(MotionThinning, AShortRunIsKeptWhole) {
  const Scene scene = test::steel_scene(1);
  MotionThinning thinning(scene, 64);
  for (int n = 0; n < 60; ++n) thinning.take(n, moving_balls(1, n), {});
  const auto frames = thinning.finish();
  ASSERT_EQ(frames.size(), 60u);
  for (int n = 0; n < 60; ++n) EXPECT_EQ(frames[static_cast<std::size_t>(n)].time, n);
  EXPECT_TRUE(thinning.finish().empty());
}

TEST(MotionThinning, ALongRunKeepsItsEndsAndEvenSteps) {
  Scene scene = test::steel_scene(1);
  scene.motion = SubstrateMotion::oscillation({0.1, 0}, 0.01, 0.5);
  MotionThinning thinning(scene, 64);
  constexpr int kLast = 12345;
  for (int n = 0; n <= kLast; ++n) thinning.take(n, moving_balls(1, n), {});
  const auto frames = thinning.finish();
  EXPECT_LE(frames.size(), 64u);
  EXPECT_EQ(frames.front().time, 0);
  EXPECT_EQ(frames.back().time, kLast);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const double t = frames[k].time;
    EXPECT_EQ(frames[k].bodies[0].position.x(), t);
    const double displacement = 0.1 * (std::sin(2 * M_PI * 0.01 * t + 0.5) - std::sin(0.5));
    EXPECT_NEAR(frames[k].substrate.x(), displacement, 1e-12);
    // Between 32 and 64 frames: steps are of the power of two that gives so many, 256.
    if (k > 0 && k + 1 < frames.size()) {
      EXPECT_EQ(t - frames[k - 1].time, 256);
    }
  }
}

TEST(MotionThinning, ACollisionKeepsTheFramesAroundIt) {
  const Scene scene = test::steel_scene(2);
  MotionThinning thinning(scene, 64);
  const std::vector<Touch> on_substrate = {{0, kSubstrate, 1}, {1, kSubstrate, 1}};
  std::vector<Touch> collision = on_substrate;
  collision.push_back({0, 1, 1});
  for (int n = 0; n < 10000; ++n)
    thinning.take(n, moving_balls(2, n), n == 5001 || n == 5002 ? collision : on_substrate);
  const auto frames = thinning.finish();
  EXPECT_LE(frames.size(), 64u);
  const auto after = std::ranges::find(frames, 5001.0, &MotionFrame::time);
  ASSERT_NE(after, frames.end());
  EXPECT_EQ(std::prev(after)->time, 5000);
  EXPECT_TRUE(std::ranges::count(after->touches, Pair(0, 1)));
  EXPECT_FALSE(std::ranges::count(std::prev(after)->touches, Pair(0, 1)));
  // It lasts another step, which the next frame tells.
  EXPECT_TRUE(std::ranges::count(std::next(after)->touches, Pair(0, 1)));
}

TEST(MotionThinning, ALandingKeepsTheFramesAroundIt) {
  const Scene scene = test::steel_scene(1);
  MotionThinning thinning(scene, 64);
  for (int n = 0; n < 10000; ++n) {
    std::vector<BodyState> ball = moving_balls(1, n);
    if (n < 7001) ball[0].position.z() += 1;
    std::vector<Touch> touches;
    if (n >= 7001) touches.push_back({0, kSubstrate, 1});
    thinning.take(n, ball, touches);
  }
  const auto frames = thinning.finish();
  const auto after = std::ranges::find(frames, 7001.0, &MotionFrame::time);
  ASSERT_NE(after, frames.end());
  EXPECT_EQ(std::prev(after)->time, 7000);
}

TEST(MotionThinning, EveryTouchIsInTheNextFrameOnce) {
  // Pairs in turn, for three steps out of ten: far more collisions than frames.
  const Scene scene = test::steel_scene(3);
  const Pair pairs[] = {{0, 1}, {0, 2}, {1, 2}, {0, kSubstrate}};
  const auto touches_at = [&](int n) {
    std::vector<Touch> touches;
    if (n % 10 < 3) {
      const Pair& pair = pairs[n / 10 % 4];
      touches.push_back({pair.first, pair.second, 1});
    }
    return touches;
  };
  MotionThinning thinning(scene, 16);
  for (int n = 0; n < 3000; ++n) thinning.take(n, moving_balls(3, n), touches_at(n));
  const auto frames = thinning.finish();
  EXPECT_LE(frames.size(), 16u);
  EXPECT_GE(frames.size(), 8u);
  int next = 0;
  for (const MotionFrame& frame : frames) {
    std::set<Pair> expected;
    for (; next <= frame.time; ++next)
      for (const Touch& touch : touches_at(next)) expected.emplace(touch.first, touch.second);
    EXPECT_EQ(frame.touches, std::vector<Pair>(expected.begin(), expected.end())) << frame.time;
  }
  EXPECT_EQ(next, 3000);
}

TEST(MotionThinning, FramesThatAreNotFiniteArePassedOver) {
  const Scene scene = test::steel_scene(1);
  MotionThinning thinning(scene, 64);
  for (int n = 0; n < 10; ++n) {
    std::vector<BodyState> ball = moving_balls(1, n);
    if (n == 3) ball[0].velocity.x() = kInfinity;
    if (n == 9) ball[0].angular_velocity.z() = kNaN;
    thinning.take(n, ball, {});
  }
  const auto frames = thinning.finish();
  ASSERT_EQ(frames.size(), 8u);
  EXPECT_EQ(frames[3].time, 4);
  EXPECT_EQ(frames.back().time, 8);
}

TEST(MotionThinning, ManyBodiesHaveFewerFrames) {
  EXPECT_EQ(most_frames(2), 64u);
  EXPECT_EQ(most_frames(100), 30u);
  EXPECT_EQ(most_frames(200), 16u);
}

// --- phases --------------------------------------------------------------------------------------

/// Of phases that begin at 0, 1, 2, …
std::vector<RecordedMotion> picked(const std::vector<double>& errors, std::size_t phases) {
  const Scene scene = test::steel_scene(1);
  MotionRecorder recorder(scene);
  for (std::size_t p = 0; p < phases; ++p) {
    const auto time = static_cast<double>(p);
    recorder.begin(time, moving_balls(1, time));
    recorder.take(time + 1, {moving_balls(1, time + 1), {}, 1});
  }
  return recorder.picked(errors);
}

void expect_motion(const RecordedMotion& motion, const char* role, std::size_t phase,
                   double error) {
  EXPECT_EQ(motion.role, role);
  EXPECT_EQ(motion.phase, phase);
  EXPECT_EQ(motion.error, error);
  ASSERT_EQ(motion.frames.size(), 2u);
  EXPECT_EQ(motion.frames.front().time, static_cast<double>(phase));
  EXPECT_EQ(motion.frames.front().touches, (std::vector<Pair>{{0, kSubstrate}}));
}

TEST(MotionRecorder, PicksTheMiddleTheWorstAndTheNearestPhase) {
  const auto motions = picked({4, 0.5, 2, kInfinity, 1}, 5);
  ASSERT_EQ(motions.size(), 3u);
  expect_motion(motions[0], "median", 2, 2);
  expect_motion(motions[1], "worst", 3, kInfinity);
  expect_motion(motions[2], "nearest", 1, 0.5);
}

TEST(MotionRecorder, APhaseIsPickedOnce) {
  const auto two = picked({3, 1}, 2);
  ASSERT_EQ(two.size(), 2u);
  expect_motion(two[0], "median", 1, 1);
  expect_motion(two[1], "worst", 0, 3);
  const auto one = picked({3}, 1);
  ASSERT_EQ(one.size(), 1u);
  expect_motion(one[0], "median", 0, 3);
}

TEST(MotionRecorder, WithoutErrorsTheFirstPhase) {
  for (const auto& errors : {std::vector<double>{kNaN, kNaN}, std::vector<double>{}}) {
    const auto motions = picked(errors, 2);
    ASSERT_EQ(motions.size(), 1u);
    EXPECT_EQ(motions[0].role, "median");
    EXPECT_EQ(motions[0].phase, 0u);
    EXPECT_TRUE(std::isnan(motions[0].error));
  }
  EXPECT_TRUE(picked({}, 0).empty());
}

// --- the reference -------------------------------------------------------------------------------

RecordedMotion motion_of(const Scene& scene, double end) {
  const ContactScene contacts = with_hard_contacts(scene);
  return reference_motion(ReferenceSolver(contacts, Compare::Reference::automatic), end);
}

TEST(ReferenceMotion, OfASlidingBallIsTheClosedForm) {
  Scene scene = test::steel_scene(1);
  const double v0 = 0.5, a = 0.1 * 9.81, rolls_at = 2 * v0 / (7 * a), rolling = 5 * v0 / 7;
  scene.initial[0].velocity = {v0, 0, 0};
  const RecordedMotion motion = motion_of(scene, 2 * rolls_at);
  EXPECT_EQ(motion.role, "reference");
  EXPECT_GE(motion.frames.size(), 100u);
  EXPECT_LE(motion.frames.size(), 128u);
  EXPECT_EQ(motion.frames.front().time, 0);
  EXPECT_EQ(motion.frames.back().time, 2 * rolls_at);
  const auto seen = motion_quantities(scene, motion);
  bool has_event = false;
  for (std::size_t k = 0; k < motion.frames.size(); ++k) {
    const MotionFrame& frame = motion.frames[k];
    const double t = frame.time, slides = std::min(t, rolls_at);
    const double v = v0 - a * slides;
    const double x = v0 * slides - 0.5 * a * slides * slides + rolling * (t - slides);
    EXPECT_NEAR(frame.bodies[0].velocity.x(), v, 1e-14);
    EXPECT_NEAR(frame.bodies[0].position.x(), x, 1e-14);
    EXPECT_EQ(frame.touches, (std::vector<Pair>{{0, kSubstrate}}));
    if (k > 0) {
      EXPECT_GT(t, motion.frames[k - 1].time);
    }
    has_event |= std::abs(t - rolls_at) < 1e-12;
    EXPECT_NEAR(seen.slip[k][0].x(), std::max(0.0, v0 - 3.5 * a * t), 1e-12);
    EXPECT_NEAR(seen.speed[k][0], v, 1e-14);
  }
  EXPECT_TRUE(has_event);
}

TEST(ReferenceMotion, HasTheInstantsAroundACollision) {
  // Both meet after 6 mm at 0.3 m/s, while they roll, and part with e = 0.9.
  const RecordedMotion motion = motion_of(test::head_on(0.15, -0.15, 0.9), 0.08);
  const auto after = std::ranges::find_if(motion.frames, [](const MotionFrame& frame) {
    return std::ranges::count(frame.touches, Pair(0, 1)) > 0;
  });
  ASSERT_NE(after, motion.frames.end());
  const MotionFrame& before = *std::prev(after);
  EXPECT_NEAR(before.time, 0.02 - 0.08e-6, 1e-15);
  EXPECT_NEAR(after->time, 0.02 + 0.08e-6, 1e-15);
  EXPECT_NEAR(before.bodies[0].velocity.x(), 0.15, 1e-15);
  // Friction takes 0.1 g for 8e-8 s.
  EXPECT_NEAR(after->bodies[0].velocity.x(), -0.135, 1e-7);
  EXPECT_NEAR(after->bodies[1].velocity.x(), 0.135, 1e-7);
}

TEST(ReferenceMotion, OfManyBouncesKeepsThoseOfTheLongestFlights) {
  // A ball that falls from 1 m and rebounds with e = 0.95, 50 times and more until the end.
  Scene scene = test::steel_scene(1);
  scene.substrate[0].restitution = 0.95;
  scene.initial[0].position.z() += 1;
  const double fall = std::sqrt(2 / 9.81);
  double end = fall;
  for (int n = 1; n <= 50; ++n) end += 2 * fall * std::pow(0.95, n);
  const RecordedMotion motion = motion_of(scene, end * (1 + 1e-9));
  EXPECT_LE(motion.frames.size(), 128u);
  double time = fall;
  for (int n = 0; n < 20; ++n) {
    const auto after = std::ranges::lower_bound(motion.frames, time, {}, &MotionFrame::time);
    ASSERT_NE(after, motion.frames.end());
    EXPECT_NEAR(after->time, time + 1e-6 * end, 1e-12);
    EXPECT_NEAR(std::prev(after)->time, time - 1e-6 * end, 1e-12);
    EXPECT_EQ(after->touches, (std::vector<Pair>{{0, kSubstrate}}));
    time += 2 * fall * std::pow(0.95, n + 1);
  }
}

TEST(ReferenceMotion, ARunThatEndsAtOnceHasOneFrame) {
  const RecordedMotion motion = motion_of(test::steel_scene(2), 0);
  ASSERT_EQ(motion.frames.size(), 1u);
  EXPECT_EQ(motion.frames[0].bodies.size(), 2u);
}

// --- quantities ----------------------------------------------------------------------------------

TEST(MotionQuantities, AreOverTheSubstrate) {
  Scene scene = test::steel_scene(3);
  scene.motion = SubstrateMotion::constant({0.3, 0});
  RecordedMotion motion;
  MotionFrame& frame = motion.frames.emplace_back();
  frame.time = 2;
  frame.bodies = scene.initial;
  frame.bodies[0].velocity = {0.5, 0.2, 0.1};        // slips by 0.2 and 0.2 m/s
  frame.bodies[1] = test::rolling_at(0, 0, 0.1, 0);  // on a still substrate
  frame.bodies[2].position.z() = 0.002 * 1.01;
  frame.bodies[2].velocity = {0, 0, 3};
  const auto seen = motion_quantities(scene, motion);
  EXPECT_TRUE(seen.slip[0][0].isApprox(Vector3(0.2, 0.2, 0), 1e-12));
  EXPECT_TRUE(seen.slip[0][1].isApprox(Vector3(-0.3, 0, 0), 1e-12));
  EXPECT_TRUE(std::isnan(seen.slip[0][2].x()));
  EXPECT_DOUBLE_EQ(seen.speed[0][2], 3);
  // A solid ball that rolls has 7/5 of its translation's energy.
  const double mass = scene.bodies[0].mass;
  EXPECT_NEAR(seen.kinetic_energy[0] / mass, 0.5 * (0.30 + 1.4 * 0.01 + 9), 1e-12);
}

// --- scenes --------------------------------------------------------------------------------------

std::vector<SceneRecord> run_recorded(const std::string& engines, bool record_motion = true) {
  test::use_test_engines();
  RunOptions options;
  options.phases = 8;
  options.limits.reply = 4;
  options.record_motion = record_motion;
  return run_scenes({parse_scenario(R"(slipcheck: 1
name: pair
title: A pair
materials: {steel: {density: 7850}}
contacts:
  - {between: [steel, steel], normal: {model: hard, restitution: 0.9}, tangential: {model: none}}
  - {between: [steel, substrate], friction: {static: 0.5, kinetic: 0.1}}
substrate: {}
bodies:
  - {name: i, material: steel, sphere: {radius: 2 mm}, position: [-9.5 mm, 0], velocity: [0.15, 0], spin: rolling}
  - {name: j, material: steel, sphere: {radius: 2 mm}, position: [9.5 mm, 0], velocity: [-0.15, 0], spin: rolling}
run: {until: rolling, limit: 5}
compare:
  engines: [)" + engines + R"(]
  tolerance: {effective_restitution: 0.005, sliding_time: 1 %}
)",
                                    "scene.yaml")},
                    options);
}

TEST(RecordedScene, HasTheReferenceAndThreePhasesOfAnEngine) {
  const auto scenes = run_recorded("{engine: bullet, precision: double, rate: 240}");
  const SceneRecord& scene = scenes[0];
  ASSERT_TRUE(scene.reference.motion);
  EXPECT_EQ(scene.reference.motion->frames.back().time, scene.reference.run.end_time);
  const EngineRecord& run = scene.runs[0];
  ASSERT_EQ(run.status, RunStatus::ok) << run.reason;
  ASSERT_EQ(run.motions.size(), 3u);
  double worst = 0;
  for (const auto& [name, error] : run.errors)
    if (error.tolerance) worst = test::largest_of(worst, error.max / *error.tolerance);
  EXPECT_DOUBLE_EQ(run.motions[1].error, worst);
  EXPECT_LE(run.motions[2].error, run.motions[0].error);
  EXPECT_LE(run.motions[0].error, worst);
  for (const RecordedMotion& motion : run.motions) {
    ASSERT_GE(motion.frames.size(), 8u);
    // Phases begin in eighths of a step.
    const double stratum = motion.frames.front().time * 240 * 8;
    EXPECT_EQ(std::floor(stratum), static_cast<double>(motion.phase));
    EXPECT_EQ(std::ranges::count_if(motion.frames,
                                    [](const MotionFrame& frame) {
                                      return std::ranges::count(frame.touches, Pair(0, 1)) > 0;
                                    }),
              1);
  }
}

TEST(RecordedScene, AFailedRunKeepsWhatWasSeen) {
  const auto scenes = run_recorded(
      "{engine: faulty, precision: double, profile: nan, rate: 240},"
      "{engine: faulty, precision: double, profile: kill-at-step-10, rate: 240}");
  const EngineRecord &unstable = scenes[0].runs[0], &crashed = scenes[0].runs[1];
  ASSERT_EQ(unstable.status, RunStatus::unstable);
  ASSERT_EQ(unstable.motions.size(), 1u);
  EXPECT_EQ(unstable.motions[0].role, "worst");
  EXPECT_TRUE(std::isnan(unstable.motions[0].error));
  EXPECT_EQ(unstable.motions[0].frames.size(), 10u);  // the start and nine steps
  ASSERT_EQ(crashed.status, RunStatus::crashed);
  ASSERT_EQ(crashed.motions.size(), 1u);
  EXPECT_EQ(crashed.motions[0].frames.size(), 1u);
}

TEST(RecordedScene, NothingIsKeptWhereNothingIsAskedFor) {
  const auto scenes = run_recorded("{engine: bullet, precision: double, rate: 240}", false);
  EXPECT_FALSE(scenes[0].reference.motion);
  EXPECT_TRUE(scenes[0].runs[0].motions.empty());
}

}  // namespace
}  // namespace slipcheck
