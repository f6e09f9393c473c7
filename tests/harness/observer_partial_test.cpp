#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "../reference/planar_scenes.h"
#include "harness/observe/observer.h"
#include "reference/events/event_solver.h"
#include "reference/events/planar_solver.h"

namespace slipcheck {
namespace {

/// Wants all bodies in each frame.
struct WholeAlone final : FrameSink {
  explicit WholeAlone(Observer& to) : observer(to) {}
  void take(double time, const Frame& frame) override { observer.take(time, frame); }
  Observer& observer;
};

enum class Shown { partial, whole, by_event_solver };

Observables observed(const Scene& scene, double end, Shown shown) {
  Observer observer(scene, 0, speed_scale(scene, scene.initial));
  WholeAlone whole(observer);
  FrameSink& sink = shown == Shown::partial ? static_cast<FrameSink&>(observer) : whole;
  const RunEnd until = until_time(end);
  if (shown == Shown::by_event_solver)
    EventSolver(scene, scene.initial).run(until, &sink);
  else
    PlanarSolver(scene, scene.initial).run(until, &sink);
  return observer.finish(end);
}

void expect_alike(const Observables& one, const Observables& other, double tolerance) {
  ASSERT_EQ(one.pairs.size(), other.pairs.size());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < one.bodies.size(); ++i) names.push_back(std::to_string(i));
  const std::vector<double> a = flat_values(one), b = flat_values(aligned(other, one));
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(std::isnan(a[k]), std::isnan(b[k])) << value_name(one, names, k);
    if (std::isnan(a[k]) || std::isnan(b[k])) continue;
    EXPECT_NEAR(a[k], b[k], tolerance * std::max(1.0, std::abs(a[k]))) << value_name(one, names, k);
  }
}

/// Who is shown at its own collisions alone is observed as if it were shown at all of them: sums of
/// the ways between them are the same to rounding. Where each solver rounds on its own, some three
/// collisions a body let that grow by a few thousand.
TEST(Observer, SeesInPartialFramesWhatWholeOnesShow) {
  for (const PairContact& contact :
       {PairContact{.restitution = 1.0}, PairContact{.restitution = 0.8},
        PairContact{.restitution = 0.9, .friction = 0.2, .tangential_restitution = 0.3}}) {
    Scene scene = test::smooth_gas(40, 0.3, contact);
    for (std::size_t i = 0; i < scene.initial.size(); i += 2)
      scene.initial[i].angular_velocity.z() = std::cos(static_cast<double>(i));
    scene.initial[7].velocity.setZero();
    const Observables partial = observed(scene, 2, Shown::partial);
    EXPECT_GT(partial.pairs.size(), 30u);
    expect_alike(partial, observed(scene, 2, Shown::whole), 1e-12);
    expect_alike(partial, observed(scene, 2, Shown::by_event_solver), 1e-9);
  }
}

/// Equal balls in a row hand a velocity on from one to the next past one that drifts elsewhere:
/// each stops where it strikes and rests from then on.
TEST(Observer, SeesInPartialFramesThatBodiesStop) {
  Scene scene = test::of_one_material(4, 0.5, {.restitution = 1.0});
  scene.periodic = {12, 12};
  scene.gravity = 9.81;
  for (int k = 0; k < 4; ++k) {
    BodyState state;
    state.position = {1.0 + 3 * k, k < 3 ? 2.0 : 9.0, 0.5};
    state.velocity = {k == 0 ? 1.0 : k == 3 ? 0.5 : 0.0, 0, 0};
    scene.initial.push_back(state);
  }
  // Gaps of 2 m: the third one leaves at 4 s.
  const double end = 6;
  const Observables partial = observed(scene, end, Shown::partial);
  expect_alike(partial, observed(scene, end, Shown::whole), 1e-12);
  ASSERT_EQ(partial.pairs.size(), 2u);
  for (const PairObservables& pair : partial.pairs) EXPECT_NEAR(pair.restitution, 1, 1e-14);
  EXPECT_NEAR(partial.bodies[0].final_position.x(), 3, 1e-14);
  EXPECT_NEAR(partial.bodies[1].final_position.x(), 6, 1e-14);
  EXPECT_NEAR(partial.bodies[2].final_position.x(), 7 + (end - 4), 1e-14);
  EXPECT_EQ(partial.bodies[0].stopping_time, 0);
  EXPECT_EQ(partial.bodies[1].stopping_distance, 0);
}

/// Counts the frames that had all bodies.
struct Counting final : FrameSink {
  explicit Counting(Observer& to) : observer(to) {}
  void take(double time, const Frame& frame) override {
    ++whole;
    observer.take(time, frame);
  }
  bool take_partial(double time, const PartialFrame& frame) override {
    ++partial;
    return observer.take_partial(time, frame);
  }
  Observer& observer;
  std::size_t whole = 0, partial = 0;
};

/// Unlike balls that slide, roll, spin and, where their rubbing throws them up, fly; most come to
/// rest where rolling friction stops them.
Scene on_a_table(const RollingFriction& rolling, bool periodic) {
  std::mt19937 dice(9);
  std::uniform_real_distribution<double> unit(-1, 1);
  Scene scene = test::of_one_material(40, 0.01, {0.8, 0.3, 0.2});
  scene.gravity = 9.81;
  if (periodic) scene.periodic = {0.3, 0.3};
  SubstrateContact& contact = scene.substrate[0];
  contact.static_friction = contact.kinetic_friction = 0.2;
  contact.rolling = rolling;
  contact.drilling_length = 1e-3;
  contact.restitution = 0.5;
  for (int k = 0; k < 40; ++k) {
    const double part = 1 + 0.3 * unit(dice);
    Sphere& sphere = scene.bodies[static_cast<std::size_t>(k)];
    sphere.radius *= part;
    sphere.mass *= part * part * part;
    BodyState state;
    state.position = {0.042 * (k % 7), 0.042 * (k / 7), sphere.radius};
    state.velocity = 0.4 * Vector3(unit(dice), unit(dice), 0);
    state.angular_velocity = 20 * Vector3(unit(dice), unit(dice), unit(dice));
    scene.initial.push_back(state);
  }
  return scene;
}

TEST(Observer, SeesInPartialFramesWhatASubstrateDoes) {
  const RollingFriction none, constant(0.01), table({{0, 0.005}, {1, 0.02}});
  std::size_t jumps = 0, stops = 0, effective = 0;
  for (const RollingFriction& rolling : {none, constant, table})
    for (const bool periodic : {false, true}) {
      const Scene scene = on_a_table(rolling, periodic);
      const RunEnd end =
          rolling.is_zero() ? RunEnd{Run::Until::rolling, 0, 2} : RunEnd{Run::Until::rest, 0, 30};
      const auto solve = [&](auto make_sink) {
        Observer observer(scene, 0, speed_scale(scene, scene.initial));
        auto sink = make_sink(observer);
        const SolvedRun run = EventSolver(scene, scene.initial).run(end, &sink);
        if constexpr (std::is_same_v<decltype(sink), Counting>) {
          EXPECT_GT(sink.partial, 2 * run.collisions);
          EXPECT_EQ(sink.whole, 2u);  // the first and the last
        }
        EXPECT_GT(run.collisions, 20u);
        return observer.finish(run.end_time);
      };
      const Observables partial = solve([](Observer& observer) { return Counting(observer); });
      const Observables whole = solve([](Observer& observer) { return WholeAlone(observer); });
      expect_alike(partial, whole, 1e-12);
      for (const BodyObservables& body : partial.bodies) {
        jumps += !std::isnan(body.jump_height);
        stops += !std::isnan(body.stopping_distance);
      }
      for (const PairObservables& pair : partial.pairs)
        effective += !std::isnan(pair.effective_restitution);
    }
  EXPECT_GT(jumps, 10u);
  EXPECT_GT(stops, 100u);
  EXPECT_GT(effective, 50u);
}

/// Balls that slide, roll, stop and meet cushions; some meet others too softly for a collision
/// before they roll and those that they collided with are looked at.
TEST(Observer, SeesInPartialFramesWhatHappensInAFrame) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Scene scene = test::balls_in_frame(40, seed);
    const auto seen = [&](bool partial) {
      Observer observer(scene, 0, speed_scale(scene, scene.initial));
      WholeAlone whole(observer);
      FrameSink& sink = partial ? static_cast<FrameSink&>(observer) : whole;
      EXPECT_TRUE(EventSolver(scene, scene.initial).run(until_time(20), &sink).reached);
      return observer.finish(20);
    };
    const Observables partial = seen(true);
    EXPECT_GT(partial.pairs.size(), 60u);
    expect_alike(partial, seen(false), 1e-12);
  }
}

}  // namespace
}  // namespace slipcheck
