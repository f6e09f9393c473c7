// Collisions that last, from made-up frames whose observables are known by construction.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "../scenes.h"
#include "harness/observe/observer.h"

namespace slipcheck {
namespace {

constexpr double kR = 0.002;

/// What one frame of two bodies on the x axis shows.
struct Shown {
  double time;
  double gap;     ///< between the surfaces [m]
  double v0, v1;  ///< velocities along x [m/s]
  bool touch = false;
  double slip0 = 0, slip1 = 0;  ///< on the substrate [m/s]
  bool supported0 = true;
  double height0 = 0, vz0 = 0;  ///< of the first body's lowest point
};

Frame frame_of(const Shown& shown) {
  Frame frame;
  frame.bodies = {test::rolling_at(-kR - shown.gap / 2, 0, shown.v0 - shown.slip0, 0),
                  test::rolling_at(kR + shown.gap / 2, 0, shown.v1 - shown.slip1, 0)};
  frame.bodies[0].velocity.x() = shown.v0;
  frame.bodies[1].velocity.x() = shown.v1;
  frame.bodies[0].position.z() += shown.height0;
  frame.bodies[0].velocity.z() = shown.vz0;
  if (shown.supported0) frame.touches.push_back({0, kSubstrate, 1});
  frame.touches.push_back({1, kSubstrate, 1});
  if (shown.touch) frame.touches.push_back({0, 1, 1e-300});
  return frame;
}

Observables seen_in(const std::vector<Shown>& frames, double step = 0, bool resolved = true) {
  const Scene scene = test::head_on(0.2, -0.2, 0.9);
  Observer observer(scene, step, 0.2, resolved);
  for (const Shown& shown : frames) observer.take(shown.time, frame_of(shown));
  return observer.finish(frames.back().time);
}

constexpr double kBegin = 0.02;

/// Meets at ±0.2 m/s, starts to slide 10 ns after the first touch, is deepest after 10 µs, parts
/// after 25 µs, then slides for 1 ms.
std::vector<Shown> resolved_collision() {
  return {{0, 0.008, 0.2, -0.2},
          {kBegin, 0, 0.2, -0.2},
          {kBegin + 1e-8, -4e-9, 0.2, -0.2, true},
          {kBegin + 1e-5, -3e-6, 0, 0, true, -0.2, 0.2},
          // Parting faster than at the end, as under a force that attracts.
          {kBegin + 2e-5, -1e-6, -0.19, 0.19, true, -0.38, 0.38},
          {kBegin + 2.5e-5, 0, -0.16, 0.16, true, -0.36, 0.36},
          {kBegin + 1.025e-3, 3e-4, -0.1, 0.1}};
}

TEST(ObserverOfResolvedContacts, IsOneCollisionFromTheFrameBeforeTheTouchToTheLastWithIt) {
  const Observables seen = seen_in(resolved_collision());
  ASSERT_EQ(seen.pairs.size(), 1u);
  EXPECT_NEAR(seen.pairs[0].restitution, 0.8, 1e-14);
  EXPECT_NEAR(seen.pairs[0].effective_restitution, 0.5, 1e-14);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(seen.bodies[i].velocity_after_collision.norm(), 0.16, 1e-15);
    EXPECT_NEAR(seen.bodies[i].slip_after_collision.norm(), 0.36, 1e-15);
    // Counted from the end of the contact.
    EXPECT_NEAR(seen.bodies[i].sliding_time, 1e-3, 1e-15);
    EXPECT_NEAR(seen.bodies[i].sliding_distance, 1.5e-4, 1e-15);
  }
}

TEST(ObserverOfResolvedContacts, ContactTimeOverlapAndOnset) {
  const Observables seen = seen_in(resolved_collision());
  EXPECT_NEAR(seen.pairs[0].contact_time, 2.5e-5, 1e-17);
  EXPECT_NEAR(seen.pairs[0].max_overlap, 3e-6, 1e-17);
  EXPECT_NEAR(seen.pairs[0].sliding_onset, 1e-8, 1e-17);
}

TEST(ObserverOfResolvedContacts, HardContactsHaveNoDurationToShow) {
  const Observables told_hard = seen_in(resolved_collision(), 0, false);
  EXPECT_TRUE(std::isnan(told_hard.pairs[0].contact_time));
  EXPECT_TRUE(std::isnan(told_hard.pairs[0].max_overlap));
  EXPECT_TRUE(std::isnan(told_hard.pairs[0].sliding_onset));
  // A hard pair among resolved ones: the frames before and after are of one time.
  const Observables at_once = seen_in({{0, 0.008, 0.2, -0.2},
                                       {kBegin, 0, 0.2, -0.2},
                                       {kBegin, 0, -0.16, 0.16, true, -0.36, 0.36},
                                       {kBegin + 1e-3, 3e-4, -0.1, 0.1}});
  EXPECT_NEAR(at_once.pairs[0].restitution, 0.8, 1e-14);
  EXPECT_TRUE(std::isnan(at_once.pairs[0].contact_time));
  EXPECT_TRUE(std::isnan(at_once.pairs[0].sliding_onset));
}

TEST(ObserverOfResolvedContacts, NoOnsetWhereABodySlidBeforeOrNoneSlides) {
  std::vector<Shown> slid = resolved_collision();
  slid[0].slip1 = slid[1].slip1 = slid[2].slip1 = 1e-3;
  EXPECT_TRUE(std::isnan(seen_in(slid).pairs[0].sliding_onset));
  std::vector<Shown> rolls = resolved_collision();
  for (Shown& shown : rolls) shown.slip0 = shown.slip1 = 0;
  EXPECT_TRUE(std::isnan(seen_in(rolls).pairs[0].sliding_onset));
  // What an integration leaves in the slip of a body that sticks is none.
  rolls[3].slip0 = 1e-11;
  EXPECT_TRUE(std::isnan(seen_in(rolls).pairs[0].sliding_onset));
}

TEST(ObserverOfResolvedContacts, TheFirstBodyToSlideMakesTheOnset) {
  std::vector<Shown> frames = resolved_collision();
  frames[3].slip0 = 0;
  EXPECT_NEAR(seen_in(frames).pairs[0].sliding_onset, 1e-8, 1e-17);
  frames[3].slip1 = 0;
  EXPECT_NEAR(seen_in(frames).pairs[0].sliding_onset, 1e-5, 1e-17);
}

/// At rest in an overlap of 0.1 mm, which parts them at 0.2 m/s after 1 ms.
std::vector<Shown> overlap_at_the_start() {
  return {{0, -1e-4, 0, 0, true},
          {5e-4, -4e-5, -0.06, 0.06, true},
          {1e-3, 0, -0.1, 0.1, true},
          {2e-3, 2e-4, -0.1, 0.1}};
}

TEST(ObserverOfResolvedContacts, AnOverlapAtTheStartIsACollisionWithoutAnApproach) {
  const Observables seen = seen_in(overlap_at_the_start());
  ASSERT_EQ(seen.pairs.size(), 1u);
  EXPECT_TRUE(std::isnan(seen.pairs[0].restitution));
  EXPECT_TRUE(std::isnan(seen.pairs[0].tangential_restitution));
  EXPECT_TRUE(std::isnan(seen.pairs[0].effective_restitution));
  EXPECT_NEAR(seen.pairs[0].contact_time, 1e-3, 1e-17);
  EXPECT_NEAR(seen.pairs[0].max_overlap, 1e-4, 1e-17);
  for (const BodyObservables& body : seen.bodies)
    EXPECT_NEAR(body.velocity_after_collision.norm(), 0.1, 1e-15);
}

TEST(ObserverOfResolvedContacts, AnOverlapAtTheStartMayCloseFirst) {
  std::vector<Shown> frames = overlap_at_the_start();
  frames[0].v0 = 0.05;
  frames[1].gap = -1.2e-4;
  const Observables seen = seen_in(frames);
  EXPECT_TRUE(std::isnan(seen.pairs[0].restitution));
  EXPECT_NEAR(seen.pairs[0].max_overlap, 1.2e-4, 1e-17);
}

TEST(ObserverOfResolvedContacts, ALaterCollisionAfterAnOverlapAtTheStartHasItsApproach) {
  std::vector<Shown> frames = overlap_at_the_start();
  frames.push_back({0.1, 0, 0.1, -0.1});
  frames.push_back({0.101, 0, -0.05, 0.05, true});
  frames.push_back({0.2, 0.01, -0.05, 0.05});
  const Observables seen = seen_in(frames);
  EXPECT_NEAR(seen.pairs[0].restitution, 0.5, 1e-14);
  EXPECT_NEAR(seen.pairs[0].contact_time, 1e-3, 1e-15);
}

TEST(ObserverOfResolvedContacts, AnEnginesOverlapAtTheStartLastsForAsLongAsItTouches) {
  const std::vector<Shown> touches = {{0, -1e-4, 0, 0},
                                      {1e-3, -8e-5, -0.02, 0.02, true},
                                      {2e-3, -4e-5, -0.03, 0.03, true},
                                      {3e-3, 2e-5, -0.03, 0.03}};
  const Observables seen = seen_in(touches, 1e-3);
  ASSERT_EQ(seen.pairs.size(), 1u);
  EXPECT_TRUE(std::isnan(seen.pairs[0].restitution));
  EXPECT_NEAR(seen.pairs[0].contact_time, 2e-3, 1e-15);
  EXPECT_NEAR(seen.bodies[0].velocity_after_collision.norm(), 0.03, 1e-15);
  // One that leaves the two in their overlap shows no collision.
  const Observables left = seen_in({{0, -1e-4, 0, 0}, {1e-3, -1e-4, 0, 0}}, 1e-3);
  EXPECT_TRUE(left.pairs.empty());
  EXPECT_TRUE(std::isnan(left.bodies[0].velocity_after_collision.x()));
}

TEST(ObserverOfResolvedContacts, ASecondCollisionIsTheLastOne) {
  std::vector<Shown> frames = resolved_collision();
  frames.push_back({0.1, 0, 0.05, -0.05});
  frames.push_back({0.1 + 1.5e-5, -1e-6, 0, 0, true});
  frames.push_back({0.1 + 3e-5, 0, -0.045, 0.045, true});
  frames.push_back({0.2, 0.01, -0.045, 0.045});
  const PairObservables pair = seen_in(frames).pairs[0];
  EXPECT_NEAR(pair.restitution, 0.9, 1e-14);
  EXPECT_NEAR(pair.contact_time, 3e-5, 1e-16);
  EXPECT_NEAR(pair.max_overlap, 1e-6, 1e-17);
}

TEST(ObserverOfResolvedContacts, AWeakTouchStaysNoneHoweverItGoesOn) {
  std::vector<Shown> frames = resolved_collision();
  frames.push_back({0.1, 0, 1e-5, -1e-5});
  frames.push_back({0.1 + 1e-5, -1e-9, 0.05, -0.05, true});
  frames.push_back({0.1 + 3e-5, 0, -0.05, 0.05, true});
  frames.push_back({0.2, 0.01, -0.05, 0.05});
  const Observables seen = seen_in(frames);
  EXPECT_NEAR(seen.pairs[0].restitution, 0.8, 1e-14);
  EXPECT_NEAR(seen.pairs[0].contact_time, 2.5e-5, 1e-17);
}

TEST(ObserverOfResolvedContacts, RestitutionIsOfTheLineOfCentresOfItsInstant) {
  // The line turns by δ in the contact while the bodies slip past each other: along the present
  // line the surfaces part with 0.9 of the approach, across it the slip has turned round to −½.
  const Scene scene = test::head_on(0.2, -0.2, 0.9);
  const double delta = 0.01, g_n = 0.3, g_t = 0.1;
  const auto frame_at = [&](double angle, double along, double across, bool touch) {
    const Vector3 n(-std::cos(angle), std::sin(angle), 0), t(n.y(), -n.x(), 0);
    Frame frame;
    frame.bodies = {test::rolling_at(0, 0, 0, 0), test::rolling_at(0, 0, 0, 0)};
    frame.bodies[0].position += kR * n;
    frame.bodies[1].position -= kR * n;
    frame.bodies[0].velocity = along * n + across * t;
    frame.bodies[0].angular_velocity.setZero();
    frame.touches = {{0, kSubstrate, 1}, {1, kSubstrate, 1}};
    if (touch) frame.touches.push_back({0, 1, 1e-300});
    return frame;
  };
  Observer observer(scene, 0, 0.3, true);
  observer.take(0, frame_at(0, -g_n, g_t, false));
  observer.take(1e-5, frame_at(delta / 2, 0, 0, true));
  observer.take(2e-5, frame_at(delta, 0.9 * g_n, -0.5 * g_t, true));
  const Observables seen = observer.finish(2e-5);
  EXPECT_NEAR(seen.pairs[0].restitution, 0.9, 1e-14);
  EXPECT_NEAR(seen.pairs[0].tangential_restitution, -0.5, 1e-13);
}

TEST(ObserverOfResolvedContacts, FlightCountsFromTheEndOfTheSupportInsideTheCollision) {
  // The first body's support ends 5 µs after the touch, at its height on the plane; the contact
  // ends after 25 µs with v_z = 0.03 m/s; it lands 6 ms after its support ended.
  std::vector<Shown> frames = resolved_collision();
  frames.resize(2);
  frames.push_back({kBegin + 5e-6, -1e-6, 0.1, -0.1, true, 0, 0, false, 0, 0});
  frames.push_back({kBegin + 1.5e-5, -3e-6, 0, 0, true, 0, 0, false, 1e-7, 0.02});
  frames.push_back({kBegin + 2.5e-5, 0, -0.16, 0.16, true, 0, 0, false, 3e-7, 0.03});
  // Ballistic between these two: the apex lies v²/2g above the first.
  frames.push_back({kBegin + 5e-6 + 6e-3, 1e-3, -0.16, 0.16, false, 0, 0, false, 0,
                    0.03 - 9.81 * (6e-3 - 2e-5)});
  frames.push_back({kBegin + 5e-6 + 6e-3, 1e-3, -0.16, 0.16});
  const BodyObservables body = seen_in(frames).bodies[0];
  EXPECT_NEAR(body.lift_off_speed, 0.03, 1e-15);
  EXPECT_NEAR(body.flight_time, 6e-3, 1e-15);
  EXPECT_NEAR(body.jump_height, 3e-7 + 0.03 * 0.03 / (2 * 9.81), 1e-15);
}

TEST(ObserverOfResolvedContacts, FlightCountsFromTheEndOfTheSupportWithoutACollisionToo) {
  // Lifted so slowly that the first frames show no vertical speed to speak of.
  std::vector<Shown> frames = {{0, 1, 0.2, 0.2}, {0.01, 1, 0.2, 0.2}};
  frames.push_back({0.01, 1, 0.2, 0.2, false, 0, 0, false, 0, 1e-14});
  frames.push_back({0.02, 1, 0.2, 0.2, false, 0, 0, false, 1e-4, 0.02});
  frames.push_back({0.05, 1, 0.2, 0.2, false, 0, 0, false, 0, -0.02});
  frames.push_back({0.05, 1, 0.2, 0.2});
  EXPECT_NEAR(seen_in(frames).bodies[0].flight_time, 0.04, 1e-16);
}

TEST(ObserverOfResolvedContacts, ABodyThatFlewBeforeTheCollisionCountsFromIt) {
  std::vector<Shown> frames = {{0, 0.008, 0.2, -0.2, false, 0, 0, false, 1e-3, 0}};
  frames.push_back({kBegin, 0, 0.2, -0.2, false, 0, 0, false, 2e-4, -0.1});
  frames.push_back({kBegin + 1e-5, -3e-6, 0, 0, true, 0, 0, false, 2e-4, 0.01});
  frames.push_back({kBegin + 2e-5, 0, -0.16, 0.16, true, 0, 0, false, 2e-4, 0.02});
  frames.push_back({kBegin + 9e-3, 1e-3, -0.16, 0.16, false, 0, 0, false, 0, -0.05});
  frames.push_back({kBegin + 9e-3, 1e-3, -0.16, 0.16});
  const BodyObservables body = seen_in(frames).bodies[0];
  EXPECT_NEAR(body.lift_off_speed, 0.02, 1e-15);
  EXPECT_NEAR(body.flight_time, 9e-3, 1e-15);
}

TEST(ObserverOfAnEngine, ContactTimeIsThatOfTheStepsThatTouch) {
  const double h = 1e-3;
  std::vector<Shown> frames = {{0, 3e-4, 0.2, -0.2},
                               {h, -1e-4, 0.1, -0.1, true},
                               {2 * h, -2e-4, -0.1, 0.1, true, -0.3, 0.3},
                               {3 * h, 0, -0.16, 0.16, true, -0.3, 0.3},
                               {4 * h, 3e-4, -0.16, 0.16}};
  const Scene scene = test::head_on(0.2, -0.2, 0.9);
  Observer observer(scene, h, 0.2, true);
  for (const Shown& shown : frames) {
    Frame frame = frame_of(shown);
    // An impulse that tells: the bodies' change of momentum.
    for (Touch& touch : frame.touches) touch.normal_impulse = 0.1 * scene.bodies[0].mass;
    observer.take(shown.time, frame);
  }
  const PairObservables pair = observer.finish(4 * h).pairs[0];
  EXPECT_NEAR(pair.contact_time, 3 * h, 1e-17);
  EXPECT_NEAR(pair.max_overlap, 2e-4, 1e-17);
  // Found to a step: it began in the second.
  EXPECT_NEAR(pair.sliding_onset, h, 1e-17);
  EXPECT_NEAR(pair.restitution, 0.8, 1e-14);
}

/// Two bodies of one mass meet head-on: the first with `speed(t)` [m/s], their surfaces `gap(t)`
/// [m] apart, t from the first touch for `contact` [s]. What pushes in a step is the change of
/// momentum.
template <class Speed, class Gap>
std::vector<Frame> frames_of_a_contact(double contact, double h, const Speed& speed,
                                       const Gap& gap) {
  const double mass = test::head_on(0.2, -0.2, 0.9).bodies[0].mass, begin = 1.3 * h;
  std::vector<Frame> frames;
  for (int n = 0; (n - 3) * h < begin + contact; ++n) {
    const double t = n * h - begin, v = speed(t);
    Frame frame = frame_of({n * h, gap(t), v, -v});
    const double impulse = mass * (speed(t - h) - v);
    if (impulse > 0) frame.touches.push_back({0, 1, impulse});
    frames.push_back(std::move(frame));
  }
  return frames;
}

/// They meet at g = 0.4 m/s: the relative velocity is g cos(ωt) for half the contact, then e g
/// cos(ωt), the overlap (g/ω) sin(ωt) and e times that.
std::vector<Frame> lasting_collision(double steps_in_contact, double e, double h) {
  const double contact = steps_in_contact * h, omega = M_PI / contact;
  const auto speed = [&](double t) {
    if (t <= 0) return 0.2;
    return t < contact ? (t > contact / 2 ? e : 1) * 0.2 * std::cos(omega * t) : -e * 0.2;
  };
  const auto gap = [&](double t) {
    if (t <= 0) return -0.4 * t;
    if (t >= contact) return 0.4 * e * (t - contact);
    return -(t > contact / 2 ? e : 1) * 0.4 / omega * std::sin(omega * t);
  };
  return frames_of_a_contact(contact, h, speed, gap);
}

TEST(ObserverOfAnEngine, ACollisionEndsWithTheLastStepThatPushesHoweverLongItLasts) {
  const Scene scene = test::head_on(0.2, -0.2, 0.9);
  for (const double steps : {0.5, 1.0, 2.0, 3.4, 7.0, 20.0, 45.0, 100.0, 1000.0}) {
    const double h = 1e-2 / std::max(10.0, steps);
    for (const double e : {1.0, 0.5}) {
      const std::vector<Frame> frames = lasting_collision(steps, e, h);
      Observer observer(scene, h, 0.2, true);
      std::size_t colliding = 0;
      for (std::size_t n = 0; n < frames.size(); ++n) {
        observer.take(static_cast<double>(n) * h, frames[n]);
        if (observer.anything_collides()) ++colliding;
      }
      const PairObservables pair =
          observer.finish(static_cast<double>(frames.size() - 1) * h).pairs.at(0);
      EXPECT_NEAR(pair.restitution, e, 1e-12) << steps << " steps";
      // In every frame from the first push to the last; the pair's is in whole steps.
      EXPECT_NEAR(static_cast<double>(colliding), pair.contact_time / h, 1e-6) << steps << " steps";
      EXPECT_NEAR(pair.contact_time, steps * h, 2 * h);
      EXPECT_FALSE(observer.anything_collides());
      // Where the reference's contacts are instants only what drives apart counts: not a last step
      // with less than 0.3 % of the others' mean, nor of many steps more than (0.006/π)²/2.
      Observer of_instants(scene, h, 0.2, false);
      for (std::size_t n = 0; n < frames.size(); ++n)
        of_instants.take(static_cast<double>(n) * h, frames[n]);
      EXPECT_NEAR(of_instants.finish(1).pairs.at(0).restitution, e, 3e-6 + 0.006 / steps)
          << steps << " steps";
    }
  }
}

/// A spring with ζ = 2 times the critical damping that lets go where its force is zero leaves
/// exp(−2ζ acosh ζ/√(ζ² − 1)) = 0.048: the bodies never part fast, but are pushed. What a last push
/// below 0.3 % of the mean force leaves out is less than a tenth of that.
TEST(ObserverOfAnEngine, WhatPushesStronglyGoesOnThoughTheBodiesHardlyPart) {
  const double zeta = 2, root = std::sqrt(zeta * zeta - 1), omega = 5000, h = 4e-6;
  const double fast = -(zeta + root) * omega, slow = -(zeta - root) * omega;
  const double contact = 2 * std::log(fast / slow) / (slow - fast);
  const auto speed = [&](double t) {
    if (t <= 0) return 0.2;
    t = std::min(t, contact);
    return 0.2 / (slow - fast) * (slow * std::exp(slow * t) - fast * std::exp(fast * t));
  };
  const auto gap = [&](double t) {
    if (t <= 0) return -0.4 * t;
    return -0.4 / (slow - fast) * (std::exp(slow * t) - std::exp(fast * t));
  };
  const double e = std::exp(-2 * zeta * std::acosh(zeta) / root);
  ASSERT_NEAR(speed(contact), -0.2 * e, 1e-12);
  const Scene scene = test::head_on(0.2, -0.2, 0.9);
  Observer observer(scene, h, 0.2, true);
  double t = 0;
  for (const Frame& frame : frames_of_a_contact(contact, h, speed, gap)) {
    observer.take(t, frame);
    t += h;
  }
  EXPECT_NEAR(observer.finish(t).pairs.at(0).restitution, e, 0.1 * e);
}

/// What an engine shows of the same: the support goes in the second of five steps of a collision,
/// after which the ball rises with 0.02 m/s.
TEST(ObserverOfAnEngine, FlightCountsFromTheEndOfTheSupportInsideACollisionOfSeveralSteps) {
  const double h = 1e-3, mass = test::head_on(0.2, -0.2, 0.9).bodies[0].mass;
  const Scene scene = test::head_on(0.2, -0.2, 0.9);
  Observer observer(scene, h, 0.2, true);
  observer.take(0, frame_of({0, 1e-4, 0.2, -0.2}));
  const double speeds[] = {0.2, 0.12, 0, -0.08, -0.16, -0.17};
  for (int n = 1; n <= 5; ++n) {
    Frame frame = frame_of(
        {n * h, -1e-4, speeds[n], -speeds[n], false, 0, 0, n < 2, 1e-6 * n, n < 2 ? 0 : 0.004 * n});
    frame.touches.push_back({0, 1, (speeds[n - 1] - speeds[n]) * mass});
    observer.take(n * h, frame);
  }
  double rise = 0.02, height = 5e-6;
  int n = 6;
  for (; height > 0; ++n, rise -= scene.gravity * h, height += rise * h)
    observer.take(n * h, frame_of({n * h, 1e-3, -0.17, 0.17, false, 0, 0, false, height, rise}));
  observer.take(n * h, frame_of({n * h, 1e-3, -0.17, 0.17}));
  const BodyObservables body = observer.finish(n * h).bodies[0];
  EXPECT_NEAR(body.lift_off_speed, 0.02, 1e-15);
  EXPECT_NEAR(body.flight_time, (n - 2) * h, h);
}

/// However hard: two at the foot of a slope that many others rest on.
TEST(ObserverOfAnEngine, WhatLeansOnAfterItsBlowCollidesNoMore) {
  const double h = 1e-3;
  const Scene scene = test::head_on(0.2, -0.2, 0.9);
  Observer observer(scene, h, 0.2, true);
  observer.take(0, frame_of({0, 1e-4, 0.2, -0.2}));
  for (int n = 1; n <= 20; ++n) {
    Frame frame = frame_of({n * h, 0, 1e-6, -1e-6});
    frame.touches.push_back({0, 1, (n == 1 ? 0.2 : 0.013) * scene.bodies[0].mass});
    observer.take(n * h, frame);
    EXPECT_EQ(observer.anything_collides(), n == 1) << n;
  }
  EXPECT_NEAR(observer.finish(20 * h).pairs.at(0).contact_time, h, 1e-15);
}

/// Balls that roll to each other at ±1 mm/s and part at 0.9 mm/s: less slip than friction takes in
/// half a step.
class SlowCollision : public testing::Test {
 protected:
  /// `later`: what follows the step of the blow.
  PairObservables seen_with(const std::vector<Shown>& later) {
    std::vector<Shown> frames = {{0, 0, kV, -kV}, {kH, 0, -kE * kV, kE * kV, true, -kSlip, kSlip}};
    frames.insert(frames.end(), later.begin(), later.end());
    Observer observer(scene_, kH, kV, false);
    for (const Shown& shown : frames) {
      Frame frame = frame_of(shown);
      for (Touch& touch : frame.touches) touch.normal_impulse = kV * scene_.bodies[0].mass;
      observer.take(shown.time, frame);
    }
    seen_ = observer.finish(frames.back().time);
    return seen_.pairs.at(0);
  }

  static constexpr double kH = 1.0 / 240, kV = 1e-3, kE = 0.9, kSlip = (1 + kE) * kV;
  /// A solid sphere rolls when 2/7 of its slip is taken off its velocity.
  static constexpr double kRolls = kE * kV - 2.0 / 7 * kSlip;
  static constexpr double kEffective = (2.5 * kE - 1) / 3.5;
  const Scene scene_ = test::head_on(kV, -kV, kE);
  const double brake_ = scene_.on_substrate(0).kinetic_friction * scene_.gravity;
  const double slides_ = 2.0 / 7 * kSlip / brake_;  ///< 0.55 ms
  Observables seen_;
};

TEST_F(SlowCollision, WhatTheNextStepTakesAwayIsASlide) {
  const double way = 0.5 * (kE * kV + kRolls) * slides_;
  const double gap = 2 * (way + (kH - slides_) * kRolls);
  const PairObservables pair = seen_with({{2 * kH, gap, -kRolls, kRolls}});
  EXPECT_NEAR(pair.restitution, kE, 1e-12);
  EXPECT_NEAR(pair.effective_restitution, kEffective, 1e-12);
  for (const BodyObservables& body : seen_.bodies) {
    EXPECT_NEAR(body.sliding_time, slides_, 1e-12);
    EXPECT_NEAR(body.sliding_distance, way, 1e-15);
    EXPECT_NEAR(body.rolling_velocity.norm(), kRolls, 1e-15);
  }
}

TEST_F(SlowCollision, AnEngineThatMovesBodiesByTheVelocityAfterAStepSlidesForNoTime) {
  const PairObservables pair = seen_with({{2 * kH, 2 * kH * kRolls, -kRolls, kRolls}});
  EXPECT_NEAR(pair.effective_restitution, kEffective, 1e-12);
  EXPECT_NEAR(seen_.bodies[0].sliding_time, 0, 1e-12);
  EXPECT_NEAR(seen_.bodies[0].sliding_distance, 0, 1e-15);
}

TEST_F(SlowCollision, APartOfAStepTakesAPartOfTheSlip) {
  const double part = 0.1 * slides_, v = kE * kV - brake_ * part, slip = 0.9 * kSlip;
  const double gap = (kE * kV + v) * part, rest = (v + kRolls) * (slides_ - part);
  const PairObservables pair =
      seen_with({{kH + part, gap, -v, v, false, -slip, slip},
                 {2 * kH, gap + rest + 2 * (kH - slides_) * kRolls, -kRolls, kRolls}});
  EXPECT_NEAR(pair.effective_restitution, kEffective, 1e-12);
  EXPECT_NEAR(seen_.bodies[0].sliding_time, slides_, 1e-12);
}

TEST_F(SlowCollision, SlipThatStaysIsNoSlide) {
  const double v = kE * kV;
  const PairObservables pair = seen_with({{2 * kH, 2 * kH * v, -v, v, false, -kSlip, kSlip},
                                          {3 * kH, 4 * kH * v, -v, v, false, -kSlip, kSlip}});
  EXPECT_NEAR(pair.effective_restitution, kE, 1e-12);
  EXPECT_EQ(seen_.bodies[0].sliding_time, 0);
}

TEST_F(SlowCollision, WhatBeginsWithLittleSlipSlidesToo) {
  Observer observer(scene_, kH, kV, false);
  const double way = 0.5 * (kE * kV + kRolls) * slides_ + (kH - slides_) * kRolls;
  observer.take(0, frame_of({0, 0, -kE * kV, kE * kV, false, -kSlip, kSlip}));
  observer.take(kH, frame_of({kH, 2 * way, -kRolls, kRolls}));
  seen_ = observer.finish(kH);
  EXPECT_NEAR(seen_.bodies[0].sliding_time, slides_, 1e-12);
  EXPECT_NEAR(seen_.bodies[0].rolling_velocity.norm(), kRolls, 1e-15);
}

TEST(ObserverOfAnEngine, EffectiveRestitutionOfSlidesThatEndTogetherUpToRounding) {
  // A solid sphere's slip falls by (7/2) μ g h in a step, its velocity changes by μ g h, and in all
  // by 2/7 of the first slip. What is left after ten steps counts as zero: less than half a step's.
  const double h = 1e-3;
  const Scene scene = test::head_on(0.2, -0.2, 0.9);
  const double brake = scene.on_substrate(0).kinetic_friction * scene.gravity * h;
  const double u0 = 10.3 * 3.5 * brake, u1 = u0 * (1 - 1e-12);
  const double w0 = 0.11, w1 = 0.27;
  std::vector<Shown> frames = {{0, 3e-4, 0.2, -0.2}};
  for (int n = 0; n <= 10; ++n)
    frames.push_back({(n + 1) * h, 0, -w0 + n * brake, w1 - n * brake, n == 0,
                      -(u0 - n * 3.5 * brake), u1 - n * 3.5 * brake});
  const double v0 = -w0 + 2.0 / 7 * u0, v1 = w1 - 2.0 / 7 * u1;
  frames.push_back({12 * h, 0, v0, v1});
  Observer observer(scene, h, 0.2, false);
  for (const Shown& shown : frames) {
    Frame frame = frame_of(shown);
    for (Touch& touch : frame.touches) touch.normal_impulse = 0.1 * scene.bodies[0].mass;
    observer.take(shown.time, frame);
  }
  const PairObservables pair = observer.finish(12 * h).pairs.at(0);
  EXPECT_NEAR(pair.effective_restitution, (v1 - v0) / 0.4, 1e-12);
}

}  // namespace
}  // namespace slipcheck
