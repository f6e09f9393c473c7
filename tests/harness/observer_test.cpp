#include "harness/observe/observer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../scenes.h"
#include "physics/closed_forms.h"
#include "reference/events/event_solver.h"

namespace slipcheck {
namespace {

Frame on_plane(std::vector<BodyState> bodies) {
  Frame frame;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    frame.touches.push_back({static_cast<int>(i), kSubstrate, 1});
  frame.bodies = std::move(bodies);
  return frame;
}

/// The reference's exact path, looked at once a step as an engine shows it.
Observables sampled(const Scene& scene, double step, double end) {
  Observer observer(scene, step, speed_scale(scene, scene.initial));
  observer.take(0, on_plane(scene.initial));
  bool collided = false;
  for (int n = 1; n * step <= end; ++n) {
    const double t = n * step;
    EventSolver solver(scene, scene.initial);
    const SolvedRun run = solver.run(until_time(t), nullptr);
    Frame frame = on_plane(solver.states());
    if (run.collisions > 0 && !collided) frame.touches.push_back({0, 1, 1e-3});
    collided = run.collisions > 0;
    observer.take(t, frame);
  }
  return observer.finish(end);
}

TEST(Observer, FindsTheEndOfSlidingInsideAStep) {
  Scene scene = test::steel_scene(1);
  scene.initial[0].velocity = {0.3, 0.1, 0};
  const SlideToRoll exact(scene.bodies[0], 0.1, 9.81, scene.initial[0].velocity, Vector3::Zero());
  // Steps from a quarter to a thousandth of the slide, none a divisor of it.
  for (double step : {0.021, 0.007, 0.0011, 0.00009}) {
    const Observables seen = sampled(scene, step, 0.2);
    // The slip falls in a straight line: extrapolated without an error but of rounding.
    EXPECT_NEAR(seen.bodies[0].sliding_time, exact.sliding_time, 1e-12) << step;
    // The place at the end is linear between two frames of a parabola: ¼ of a h².
    EXPECT_NEAR(seen.bodies[0].sliding_distance, exact.sliding_distance, 0.25 * 0.981 * step * step)
        << step;
    EXPECT_LE((seen.bodies[0].rolling_velocity - exact.rolling_velocity).norm(), 1e-14);
  }
}

TEST(Observer, FindsTheStopOfARollingBallInsideAStep) {
  Scene scene = test::steel_scene(1);
  scene.substrate[0].rolling = RollingFriction(0.02);
  scene.initial[0] = test::rolling_at(0, 0, 0.3, 0);
  const double a = 0.02 * 9.81;
  for (double step : {0.07, 0.0031}) {
    const Observables seen = sampled(scene, step, 2);
    EXPECT_NEAR(seen.bodies[0].stopping_time, 0.3 / a, 1e-12);
    EXPECT_NEAR(seen.bodies[0].stopping_distance, 0.09 / (2 * a), a * step * step);
    EXPECT_EQ(seen.bodies[0].sliding_time, 0);
  }
}

TEST(Observer, FindsTheEndOfASpinInsideAStep) {
  Scene scene = test::steel_scene(1);
  scene.substrate[0].drilling_length = 1e-5;
  scene.initial[0].angular_velocity.z() = -40;
  const double rate = 1e-5 * 9.81 / (0.4 * 0.002 * 0.002);
  EXPECT_NEAR(sampled(scene, 0.0007, 1).bodies[0].spin_stopping_time, 40 / rate, 1e-12);
}

TEST(Observer, SeesTheSameCollisionInStepsAndAtEvents) {
  const Scene scene = test::head_on(0.2, -0.1, 0.9);
  EventSolver solver(scene, scene.initial);
  Observer exact(scene, 0, 0.2);
  const SolvedRun run = solver.run({Run::Until::rolling, 0, 1}, &exact);
  const Observables truth = exact.finish(run.end_time);
  EXPECT_NEAR(truth.pairs[0].restitution, 0.9, 1e-14);
  EXPECT_NEAR(truth.pairs[0].effective_restitution, (2.5 * 0.9 - 1) / 3.5, 1e-14);
  const HeadOnCollision closed{2.5, 0.9, 0};
  EXPECT_NEAR(truth.bodies[0].momentum_change_sliding, closed.slip_after(0.2, -0.1) / -3.5, 1e-14);
  const double step = 1e-4;
  const Observables seen = sampled(scene, step, 0.3);
  // Counted from the end of the step with the impulse: up to a step is missing.
  EXPECT_NEAR(seen.bodies[0].sliding_time, truth.bodies[0].sliding_time, step);
  EXPECT_NEAR(seen.pairs[0].effective_restitution, truth.pairs[0].effective_restitution, 1e-12);
  // Friction of up to a step is in the first state after the collision: 2 μ g h/v_rel.
  EXPECT_NEAR(seen.pairs[0].restitution, 0.9, 2 * 0.981 * step / 0.3);
}

TEST(Observer, LeaningBallsDoNotCollide) {
  // A second, weak touch is no collision: it would start all counts anew.
  const Scene scene = test::head_on(0.15, -0.15, 0.9);
  Observer observer(scene, 1e-3, 0.15);
  std::vector<BodyState> s = scene.initial;
  observer.take(0, on_plane(s));
  s[0].velocity.x() = -0.1;
  s[1].velocity.x() = 0.1;
  Frame blow = on_plane(s);
  blow.touches.push_back({0, 1, 1e-3});
  observer.take(1e-3, blow);
  s[0].velocity.x() = 0.001;
  s[1].velocity.x() = -0.001;
  observer.take(2e-3, on_plane(s));
  Frame leaning = on_plane(s);
  leaning.bodies[0].velocity.x() = leaning.bodies[1].velocity.x() = 0;
  leaning.touches.push_back({0, 1, 1e-9});
  observer.take(3e-3, leaning);
  EXPECT_NEAR(observer.finish(3e-3).pairs[0].restitution, 0.2 / 0.3, 1e-15);
}

TEST(Observer, JumpHasTheBallisticHeightAndTime) {
  Scene scene = test::head_on(0.3, 0, 0.9);
  scene.pairs[0].friction = 0.05;
  scene.pairs[0].tangential_restitution = 0;
  EventSolver solver(scene, scene.initial);
  Observer observer(scene, 0, 0.3);
  const SolvedRun run = solver.run({Run::Until::rolling, 0, 1}, &observer);
  const Observables seen = observer.finish(run.end_time);
  const BodyObservables& striker = seen.bodies[0];
  const double lift = 0.05 * 1.9 * 0.3 / 2;  // μ (1 + e) v/2
  EXPECT_NEAR(striker.lift_off_speed, lift, 1e-15);
  EXPECT_NEAR(striker.jump_height, lift * lift / (2 * 9.81), 1e-15);
  EXPECT_NEAR(striker.flight_time, 2 * lift / 9.81, 1e-15);
  EXPECT_TRUE(std::isnan(seen.bodies[1].flight_time));
}

TEST(Observer, ABounceIsAJumpWithTheHeightOfItsSpeed) {
  Scene scene = test::steel_scene(1);
  scene.substrate[0].restitution = 0.8;
  scene.initial[0].position.z() = 0.002 + 0.05;
  EventSolver solver(scene, scene.initial);
  Observer observer(scene, 0, speed_scale(scene, scene.initial));
  solver.run(until_time(0.3), &observer);
  const Observables seen = observer.finish(0.3);
  const double rebound = 0.8 * std::sqrt(2 * 9.81 * 0.05);
  EXPECT_NEAR(seen.bodies[0].lift_off_speed, rebound, 1e-14);
  EXPECT_NEAR(seen.bodies[0].jump_height, 0.64 * 0.05, 1e-14);  // e² h
  EXPECT_NEAR(seen.bodies[0].flight_time, 2 * rebound / 9.81, 1e-14);
  ASSERT_EQ(seen.pairs.size(), 1u);
  EXPECT_EQ(seen.pairs[0].second, kSubstrate);
  EXPECT_NEAR(seen.pairs[0].restitution, 0.8, 1e-14);
}

/// At its top it is as near to the plane and as slow as a body that an engine put to sleep.
TEST(Observer, ALowJumpOfAnEngineIsOneFlight) {
  const double h = 5e-5, g = 9.81, v = 6e-3;
  Scene scene = test::steel_scene(1);
  Observer observer(scene, h, 1);
  BodyState s = scene.initial[0];
  s.position.z() = scene.bodies[0].radius;
  observer.take(0, on_plane({s}));
  int n = 0;
  s.velocity.z() = v;
  observer.take(++n * h, on_plane({s}));
  while (s.velocity.z() > -v) {
    s.position.z() += h * (s.velocity.z() - 0.5 * g * h);
    s.velocity.z() -= g * h;
    observer.take(++n * h, {{s}, {}});
  }
  s.velocity.z() = 0;
  observer.take(++n * h, on_plane({s}));
  // Known to the steps in which it rises, ends its way and lands.
  EXPECT_NEAR(observer.finish(n * h).bodies[0].flight_time, 2 * v / g, 3 * h);
}

/// Fifty parts of a step are no fifty steps: a low hop ends when it lands, not at its top.
TEST(Observer, ABallThatHopsWithinPartsOfStepsDoesNotRollYet) {
  const double h = 1.0 / 240, g = 9.81, part = h / 50, v = 5e-3;
  Scene scene = test::steel_scene(1);
  Observer observer(scene, h, 1);
  BodyState s = test::rolling_at(0, 0, 1, 0);
  s.position.z() += 0.1;
  observer.take(0, {{s}, {}});
  s.position.z() = scene.bodies[0].radius;
  s.velocity.z() = v;
  double t = h;
  observer.take(t, on_plane({s}));
  for (; s.velocity.z() > -v; t += part) {
    EXPECT_TRUE(observer.anything_slides_or_flies()) << s.velocity.z();
    s.position.z() += part * (s.velocity.z() - 0.5 * g * part);
    s.velocity.z() -= g * part;
    observer.take(t + part, {{s}, {}});
  }
  s.velocity.z() = 0;
  s.position.z() = scene.bodies[0].radius;
  for (int n = 0; n < 2; ++n) observer.take(t += h, on_plane({s}));
  EXPECT_FALSE(observer.anything_slides_or_flies());
}

/// It leaves with the speed of the last step that throws it up, and flies from there.
TEST(Observer, AnEngineMayTakeSeveralStepsToThrowABodyUp) {
  const double h = 1e-3, g = 9.81;
  Scene scene = test::steel_scene(1);
  BodyState& s = scene.initial[0];
  s.position.z() = 0.003;
  s.velocity.z() = -1;
  Observer observer(scene, h, 1);
  observer.take(0, {{s}, {}});
  int n = 0;
  const auto step = [&](double v, bool touches) {
    s.position.z() += h * 0.5 * (s.velocity.z() + v);
    s.velocity.z() = v;
    Frame frame{{s}, {}};
    if (touches) frame.touches.push_back({0, kSubstrate, 1e-3});
    observer.take(++n * h, frame);
  };
  step(-1 - g * h, false);
  for (const double v : {-0.3, 0.4, 0.7, 0.79, 0.8}) step(v, true);
  const int begin = n - 1;
  while (s.velocity.z() > -0.7) step(s.velocity.z() - g * h, false);
  EXPECT_NEAR(observer.finish(n * h).pairs.at(0).restitution, 0.8 / (1 + g * h), 1e-12);
  step(0, true);
  const Observables seen = observer.finish(n * h);
  EXPECT_NEAR(seen.bodies[0].lift_off_speed, 0.8, 1e-15);
  // In that step it rises by half of h (0.79 + 0.8).
  EXPECT_NEAR(seen.bodies[0].jump_height, 0.8 * 0.8 / (2 * g) + h * 0.5 * (0.79 + 0.8), 1e-12);
  EXPECT_NEAR(seen.bodies[0].flight_time, (n - begin) * h, h);
}

TEST(Observer, EffectiveRestitutionOfACollisionThatAnotherInterruptsIsNotObserved) {
  Scene scene = test::steel_scene(3);
  scene.initial = {test::rolling_at(-0.01, 0, 0.2, 0), test::rolling_at(0, 0, 0, 0),
                   test::rolling_at(0.006, 0, 0, 0)};
  EventSolver solver(scene, scene.initial);
  Observer observer(scene, 0, 0.2);
  const SolvedRun run = solver.run({Run::Until::rolling, 0, 10}, &observer);
  const Observables seen = observer.finish(run.end_time);
  ASSERT_EQ(seen.pairs.size(), 2u);
  EXPECT_EQ(seen.pairs[1].first, 1);
  EXPECT_FALSE(std::isnan(seen.pairs[0].restitution));
}

TEST(Observer, EffectiveRestitutionIsNegativeWhereSpinsDriveThePairTogetherAgain) {
  // e_eff = (A e_n − 1)/(1+A) < 0 for e_n < 1/A. The pair rolls before it meets again if its mean
  // relative velocity on the way, (e_n + e_eff)/2 of the first, parts it: e_n > 1/(1+2A) = 1/6.
  // Below, hits follow each other while both slide, until the two lie together.
  const auto effective = [](double e_n) {
    const Scene scene = test::head_on(0.15, -0.15, e_n);
    EventSolver solver(scene, scene.initial);
    Observer observer(scene, 0, 0.15);
    const SolvedRun run = solver.run({Run::Until::rolling, 0, 5}, &observer);
    EXPECT_TRUE(run.reached);
    return observer.finish(run.end_time).pairs.at(0).effective_restitution;
  };
  for (const double e_n : {0.39, 0.3, 0.2, 0.17})
    EXPECT_NEAR(effective(e_n), (2.5 * e_n - 1) / 3.5, 1e-13) << e_n;
  // The slowest rebound that the rule for collapse leaves is 1e-6 of the scene's speed; the last
  // collision that counts has at least 7 % of the first.
  for (const double e_n : {0.16, 0.1, 0.0}) EXPECT_NEAR(effective(e_n), 0, 1e-4) << e_n;
}

TEST(Observer, MemoryDoesNotGrowWithTheRun) {
  // By design: it holds two frames, whatever their number.
  const Scene scene = test::head_on(0.01, 0.01, 0.9);
  Observer observer(scene, 1e-3, 0.01);
  const Frame frame = on_plane(scene.initial);
  for (int n = 0; n < 100000; ++n) observer.take(1e-3 * n, frame);
  EXPECT_EQ(observer.finish(100).bodies.size(), 2u);
  EXPECT_TRUE(observer.finish(100).pairs.empty());
}

}  // namespace
}  // namespace slipcheck
