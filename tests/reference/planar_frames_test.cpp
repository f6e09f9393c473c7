#include <gtest/gtest.h>

#include <cmath>

#include "planar_scenes.h"
#include "reference/events/event_solver.h"
#include "reference/events/planar_solver.h"
#include "reference/reference_solver.h"

namespace slipcheck {
namespace {

PairContact gas_contact(double e, double friction = 0, double beta0 = -1) {
  return {.restitution = e, .friction = friction, .tangential_restitution = beta0};
}

struct TimedFrame {
  double time;
  Frame frame;
};

struct WholeFrames final : FrameSink {
  void take(double time, const Frame& frame) override { seen.push_back({time, frame}); }
  std::vector<TimedFrame> seen;
};

/// Makes the frames whole again: who is not named goes straight on.
struct PartialFrames final : FrameSink {
  void take(double time, const Frame& frame) override {
    seen.push_back({time, frame});
    ++whole;
  }
  bool take_partial(double time, const PartialFrame& frame) override {
    TimedFrame next = seen.back();
    for (BodyState& body : next.frame.bodies)
      body.position += (time - seen.back().time) * body.velocity;
    for (std::size_t k = 0; k < frame.bodies.size(); ++k)
      next.frame.bodies[frame.bodies[k]] = frame.states[k];
    next.time = time;
    next.frame.touches.assign(frame.touches.begin(), frame.touches.end());
    seen.push_back(next);
    return true;
  }
  std::vector<TimedFrame> seen;
  std::size_t whole = 0;
};

std::vector<Touch> of_two_bodies(const Frame& frame) {
  std::vector<Touch> touches = frame.touches;
  std::erase_if(touches, [](const Touch& touch) { return touch.second == kSubstrate; });
  return touches;
}

void expect_alike(const std::vector<TimedFrame>& one, const std::vector<TimedFrame>& other,
                  double tolerance) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_NEAR(one[k].time, other[k].time, tolerance);
    const auto touches = of_two_bodies(one[k].frame), others = of_two_bodies(other[k].frame);
    ASSERT_EQ(touches.size(), others.size()) << k;
    for (std::size_t c = 0; c < touches.size(); ++c) {
      EXPECT_EQ(touches[c].first, others[c].first);
      EXPECT_EQ(touches[c].second, others[c].second);
      EXPECT_NEAR(touches[c].normal_impulse, others[c].normal_impulse, tolerance);
    }
    for (std::size_t i = 0; i < one[k].frame.bodies.size(); ++i) {
      const BodyState &a = one[k].frame.bodies[i], &b = other[k].frame.bodies[i];
      EXPECT_LT((a.position - b.position).norm(), tolerance) << k << " " << i;
      EXPECT_LT((a.velocity - b.velocity).norm(), tolerance) << k << " " << i;
      EXPECT_LT((a.angular_velocity - b.angular_velocity).norm(), tolerance) << k << " " << i;
    }
  }
}

Scene spinning_gas(const PairContact& contact) {
  Scene scene = test::smooth_gas(40, 0.3, contact);
  for (std::size_t i = 0; i < scene.initial.size(); ++i)
    scene.initial[i].angular_velocity.z() = std::cos(static_cast<double>(i));
  return scene;
}

/// The frames before and after each collision are those of the solver that knows substrates. Some
/// three collisions a body let rounding grow by a few thousand.
TEST(PlanarFrames, AreThoseOfTheEventSolver) {
  for (const PairContact& contact :
       {gas_contact(1), gas_contact(0.8), gas_contact(0.9, 0.2, 0.3), gas_contact(0.9, 0.5)}) {
    const Scene scene = spinning_gas(contact);
    WholeFrames planar, spatial;
    const SolvedRun run = PlanarSolver(scene, scene.initial).run(until_time(2), &planar);
    const SolvedRun other = EventSolver(scene, scene.initial).run(until_time(2), &spatial);
    EXPECT_GT(run.collisions, 40u);
    EXPECT_EQ(run.collisions, other.collisions);
    EXPECT_EQ(run.events, other.events);
    EXPECT_EQ(run.collapses, other.collapses);
    EXPECT_EQ(run.end_time, other.end_time);
    EXPECT_EQ(planar.seen[1].frame.touches.size(), scene.bodies.size());  // with the substrate
    expect_alike(planar.seen, spatial.seen, 1e-10);
  }
}

TEST(PlanarFrames, PartialOnesSayTheSame) {
  Scene clustered = spinning_gas(gas_contact(0.5));
  clustered.collapse = {CollapseRule::Model::largest_velocity, 0.1};
  for (const Scene& scene : {spinning_gas(gas_contact(0.9, 0.2, 0.3)), clustered}) {
    const bool has_clusters = scene.collapse.contact_time > 0;
    WholeFrames whole;
    PartialFrames partial;
    PlanarSolver(scene, scene.initial).run(until_time(2), &whole);
    const SolvedRun run = PlanarSolver(scene, scene.initial).run(until_time(2), &partial);
    // The first and the last, and before a cluster those that it may draw in.
    EXPECT_EQ(partial.whole, 2 + (has_clusters ? run.collapses : 0));
    EXPECT_EQ(run.collapses > 0, has_clusters);
    // Each way is summed over its pieces: 100 roundings of some 10 m.
    expect_alike(partial.seen, whole.seen, 1e-12);
  }
}

TEST(PlanarFrames, SamplesAloneLeaveTheEventsOut) {
  const Scene scene = spinning_gas(gas_contact(0.9));
  PartialFrames sink;
  PlanarSolver(scene, scene.initial).run(until_time(2, 0.25), &sink);
  EXPECT_EQ(sink.seen.size(), 9u);
  EXPECT_EQ(sink.whole, 9u);
}

/// Two that come from both sides onto a third at rest drive it to and fro in ever weaker collisions
/// below e = 7 − 4√3 = 0.072: the same least rebound ends it in both solvers.
TEST(PlanarFrames, TheLeastReboundIsThatOfTheEventSolver) {
  Scene scene = test::of_one_material(3, 0.5, gas_contact(0.04));
  scene.periodic = {20, 20};
  scene.gravity = 9.81;
  for (int k = 0; k < 3; ++k) {
    BodyState state;
    state.position = {5.0 + 2 * k, 10, 0.5};
    state.velocity = {1.0 - k, 0, 0};
    scene.initial.push_back(state);
  }
  scene.initial[2].velocity.x() *= 0.9;
  PlanarSolver planar(scene, scene.initial);
  EventSolver spatial(scene, scene.initial);
  const SolvedRun run = planar.run(until_time(3), nullptr);
  const SolvedRun other = spatial.run(until_time(3), nullptr);
  EXPECT_GT(run.collapses, 0u);
  EXPECT_EQ(run.collapses, other.collapses);
  EXPECT_EQ(run.collisions, other.collisions);
  for (std::size_t i = 0; i < 3; ++i)
    // Times of collisions 1e-16 apart, at speeds of 1e-6: gaps to 1e-10 of themselves.
    EXPECT_LT((planar.states()[i].velocity - spatial.states()[i].velocity).norm(), 1e-12);
}

/// What moves on a plane without friction never comes to rest.
TEST(PlanarFrames, RollingAndRestComeAtOnceOrNever) {
  const Scene moving = test::smooth_gas(30, 0.1, gas_contact(0.9));
  Scene still = moving;
  for (BodyState& state : still.initial) state.velocity.setZero();
  Scene spinning = still;
  spinning.initial[3].angular_velocity.z() = 1;
  struct Case {
    const Scene& scene;
    Run::Until until;
  };
  for (const auto& [scene, until] :
       {Case{moving, Run::Until::rolling}, Case{moving, Run::Until::rest},
        Case{still, Run::Until::rolling}, Case{still, Run::Until::rest},
        Case{spinning, Run::Until::rolling}, Case{spinning, Run::Until::rest}}) {
    const RunEnd end{until, 0, 0.1};
    const SolvedRun run = PlanarSolver(scene, scene.initial).run(end, nullptr);
    const SolvedRun other = EventSolver(scene, scene.initial).run(end, nullptr);
    EXPECT_EQ(run.reached, other.reached);
    EXPECT_EQ(run.end_time, other.end_time);
    EXPECT_EQ(run.reason, other.reason);
  }
}

TEST(ReferenceSolver, SendsAGasThatGoesStraightToThePlanarSolver) {
  const auto is_planar = [](const Scene& scene) {
    const ContactScene contacts = with_hard_contacts(scene);
    return ReferenceSolver(contacts).loop().front() == "bodies on straight lines in a plane";
  };
  const Scene gas = test::smooth_gas(40, 0.2, gas_contact(0.9));
  EXPECT_TRUE(is_planar(gas));
  EXPECT_TRUE(is_planar(test::smooth_gas(40, 0.2, gas_contact(0.9, 0.3))));
  Scene open = gas, few = test::smooth_gas(10, 0.1, gas_contact(1));
  EXPECT_TRUE(is_planar(few));
  open.periodic.setZero();
  few.periodic.setZero();
  EXPECT_TRUE(is_planar(open));
  EXPECT_FALSE(is_planar(few));  // needs no cells
  Scene moving = gas, rubbed = gas, unlike = gas, clustered = gas;
  moving.motion = SubstrateMotion::constant({0.1, 0});
  rubbed.substrate[0].kinetic_friction = rubbed.substrate[0].static_friction = 0.1;
  unlike.bodies[3].radius *= 0.9;
  clustered.collapse = {CollapseRule::Model::contact_time, 1e-4};
  for (const Scene& scene : {moving, rubbed, unlike, clustered}) EXPECT_FALSE(is_planar(scene));
}

/// The other order of the bodies reaches the sink as the scene's own.
TEST(ReferenceSolver, ShowsReversedBodiesInTheirOwnOrder) {
  const ContactScene contacts = with_hard_contacts(spinning_gas(gas_contact(0.9, 0.2, 0.3)));
  const ReferenceSolver solver(contacts);
  PartialFrames straight, reversed;
  solver.run(until_time(2), &straight);
  solver.run(until_time(2), &reversed, {.reversed = true});
  EXPECT_EQ(reversed.whole, 2u);
  expect_alike(straight.seen, reversed.seen, 1e-10);
}

}  // namespace
}  // namespace slipcheck
