// Flights that begin inside a collision that lasts, and how long its law acts, by closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "../reference/soft_scenes.h"
#include "harness/observe/observer.h"
#include "harness/run/reference_run.h"

namespace slipcheck {
namespace {

using Named = ByName<UncertainValue>;

Named reference(const ContactScene& scene, Compare::Reference solver, double end) {
  return run_reference(ReferenceSolver(scene, solver), until_time(end), {"i", "j"}).observables;
}

/// A ball that spins backwards strikes one at rest and lifts it, or itself, by rubbing, after
/// `wait` [s].
struct Strike {
  double speed = 0, spin = 0;  ///< of the striker [m/s], [1/s]
  double restitution = 0, damping_ratio = 0, friction = 0;
  double wait = 1e-3;
  double heading = 0;  ///< of the striker's way, from x

  static constexpr double kCollisionTime = 1e-4;

  ContactScene scene() const {
    Scene hard = test::steel_scene(2);
    hard.pairs[0].restitution = restitution;
    const Vector3 n(std::cos(heading), std::sin(heading), 0);
    hard.initial[1].position += (0.004 + speed * wait) * n;
    hard.initial[0].velocity = speed * n;
    hard.initial[0].angular_velocity = -spin * kUp.cross(n);
    hard.substrate[0].static_friction = hard.substrate[0].kinetic_friction = 0;
    const double reduced = hard.bodies[0].mass / 2;
    return test::soft(hard, kCollisionTime, ContactEnd::zero_overlap,
                      ViscousForce{reduced * damping_ratio / kCollisionTime, friction});
  }
};

Strike random_strike(std::mt19937& random) {
  const auto in = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  return {in(0.02, 0.4), in(-80, 80), in(0.4, 0.95), in(0.02, 2), in(0.02, 0.6)};
}

/// An engine may take steps to turn a body round, and further ones to throw it up again (Havok:
/// two; MuJoCo as shipped: 60 ms of them): all of it is one landing, with the largest speed
/// upwards.
TEST(Flight, ALandingOfSeveralStepsIsOne) {
  constexpr double kStep = 1.0 / 240, kDown = 1.0;
  for (const std::vector<double>& after :
       std::vector<std::vector<double>>{{0.8}, {0.0, 0.8}, {-0.5, 0.0, 0.4, 0.8}, {0.0, 0.0}}) {
    const Scene scene = test::steel_scene(1);
    Observer observer(scene, kStep, kDown);
    Frame frame;
    frame.bodies = {scene.initial[0]};
    BodyState& ball = frame.bodies[0];
    ball.position.z() += 0.01;
    ball.velocity = {0, 0, -kDown};
    observer.take(0, frame);
    double time = 0;
    ball.position.z() = scene.bodies[0].radius;
    frame.touches = {{0, kSubstrate, 1e-3}};
    for (const double speed : after) {
      ball.velocity.z() = speed;
      observer.take(time += kStep, frame);
    }
    frame.touches.clear();
    for (int k = 0; k < 3; ++k) {
      ball.velocity.z() = std::max(0.0, ball.velocity.z() - 9.81 * kStep);
      ball.position.z() += ball.velocity.z() * kStep;
      observer.take(time += kStep, frame);
    }
    const Observables seen = observer.finish(time);
    ASSERT_EQ(seen.pairs.size(), 1u);
    EXPECT_DOUBLE_EQ(seen.pairs[0].restitution, after.back() / kDown);
  }
}

/// From the lift-off at T_0 to the landing: up to the end of the collision, at most t_col, where
/// the body has the speed v^z and the height h^z − v²/2g; from there on v^z/g up and √(2 h^z/g)
/// down.
TEST(Flight, LastsFromItsLiftOffToItsLanding) {
  std::mt19937 random(11);
  int flights = 0, from_first_touch = 0;
  for (int k = 0; k < 400; ++k) {
    const Strike strike = random_strike(random);
    const ContactScene scene = strike.scene();
    const Named seen = reference(scene, Compare::Reference::contact, 0.15);
    for (const std::string body : {"i", "j"}) {
      if (!seen.contains(body + ".flight_time")) continue;
      ++flights;
      const auto flight = seen.at(body + ".flight_time"), height = seen.at(body + ".jump_height"),
                 speed = seen.at(body + ".lift_off_speed"), contact = seen.at("i-j.contact_time");
      const double g = scene.hard.gravity;
      const double free = (speed.value + std::sqrt(2 * g * height.value)) / g;
      const double inside = flight.value - free;  // the collision
      // Integrated at 1e-13 of a whole of some ms; the rest is rounding of 1e-7 m high arcs.
      const double error = 1e-10 * flight.value;
      EXPECT_GE(inside, -error) << k << body;
      EXPECT_LE(inside, contact.value + error) << k << body;
      EXPECT_LT(flight.uncertainty, 1e-6 * flight.value);
      // Where rubbing bears the weight from the first touch on, and to the end, it is all of it.
      const auto& law = std::get<LinearForce>(scene.soft[0]->normal);
      const double slip = scene.hard.bodies[0].radius * std::abs(strike.spin);
      const double rubbing = std::min(
          scene.soft[0] ? std::get<ViscousForce>(scene.soft[0]->tangential).viscous(slip) : 0,
          strike.friction * law.damping * strike.speed);
      if (rubbing > 1.01 * scene.hard.bodies[0].mass * g) {
        ++from_first_touch;
        EXPECT_NEAR(inside, contact.value, error) << k << body;
      }
    }
  }
  EXPECT_GT(flights, 200);
  EXPECT_GT(from_first_touch, 100);
}

TEST(Flight, KnowsNoPlaceTimeOrHeading) {
  Strike strike{0.1, 40, 0.9, 0.5, 0.5};
  const Named once = reference(strike.scene(), Compare::Reference::contact, 0.1);
  for (const double wait : {2e-3, 0.0137, 0.05}) {
    strike.wait = wait;
    strike.heading = 40 * wait;
    const Named moved = reference(strike.scene(), Compare::Reference::contact, 0.1);
    for (const std::string name : {"flight_time", "jump_height", "lift_off_speed"}) {
      std::size_t found = 0;
      for (const std::string body : {"i.", "j."}) {
        if (!once.contains(body + name)) continue;
        ++found;
        ASSERT_TRUE(moved.contains(body + name));
        EXPECT_NEAR(moved.at(body + name).value / once.at(body + name).value, 1, 1e-7) << name;
      }
      EXPECT_GT(found, 0u);
    }
  }
}

/// Two that do not meet and are thrown up at the start, one of them from `above` the plane [m].
TEST(Flight, BeginsWithTheRunWhereABodyIsThrownUp) {
  constexpr double g = 9.81, e = 0.8, fast = 0.05, slow = 0.008;
  for (const double above : {0.0, 1e-4}) {
    Scene thrown = test::steel_scene(2);
    thrown.substrate[0].restitution = e;
    thrown.initial[0].velocity = {0.1, 0, fast};
    thrown.initial[0].position.z() += above;
    thrown.initial[1].position.x() = -0.1;
    thrown.initial[1].velocity = {0, 0.1, slow};
    const ContactScene hard = with_hard_contacts(thrown);
    const ContactScene soft =
        test::soft(thrown, 1e-4, ContactEnd::zero_overlap, ViscousForce{0.1, 0.3});
    using Reference = Compare::Reference;
    for (const auto& [scene, solver] : {std::pair(&hard, Reference::event),
                                        {&hard, Reference::contact},
                                        {&soft, Reference::contact},
                                        {&soft, Reference::steps}}) {
      const Named seen = reference(*scene, solver, 0.06);
      const auto expect = [&](const std::string& name, double value) {
        const UncertainValue& found = seen.at(name);
        // Steps, of 1e-4/200, know times to two and speeds to what gravity adds in these.
        EXPECT_LT(found.uncertainty, 0.01 * value) << name;
        EXPECT_NEAR(found.value, value, found.uncertainty + 1e-11 * value) << name;
      };
      const double rise = fast * fast / (2 * g);
      expect("i.lift_off_speed", fast);
      expect("i.jump_height", rise);
      expect("i.flight_time", fast / g + std::sqrt(2 * (rise + above) / g));
      expect("j.lift_off_speed", slow);
      expect("j.jump_height", slow * slow / (2 * g));
      expect("j.flight_time", 2 * slow / g);
      expect("i-substrate.restitution", e);
    }
  }
}

/// Two fall side by side, meet in the air, and bounce off the plane before they part.
TEST(Flight, BeginsWithABounceInsideACollision) {
  constexpr double g = 9.81, e = 0.8, above = 1e-3, closing = 0.1, collision_time = 4e-3;
  const double lands = std::sqrt(2 * above / g), meets = lands - 0.3 * collision_time;
  Scene falling = test::steel_scene(2);
  falling.substrate[0] = {};
  falling.substrate[0].restitution = e;
  for (BodyState& state : falling.initial) state.position.z() += above;
  falling.initial[0].velocity.x() = closing;
  falling.initial[1].position.x() = 0.004 + closing * meets;
  const ContactScene scene = test::soft(falling, collision_time);
  const double rebound = e * g * lands;
  for (const auto solver : {Compare::Reference::contact, Compare::Reference::steps}) {
    const Named seen = reference(scene, solver, lands + 2.5 * rebound / g);
    for (const std::string body : {"i", "j"}) {
      const auto expect = [&](const std::string& name, double value) {
        const UncertainValue& found = seen.at(body + name);
        EXPECT_LT(found.uncertainty, 0.03 * value) << body << name;
        EXPECT_NEAR(found.value, value, found.uncertainty + 1e-9 * value) << body << name;
      };
      expect(".lift_off_speed", rebound - g * (meets + collision_time - lands));
      expect(".jump_height", rebound * rebound / (2 * g));
      expect(".flight_time", 2 * rebound / g);
    }
  }
}

/// An engine's first frame is a step later, when gravity has slowed the body down.
TEST(Flight, BeginsWithTheSpeedOfTheStartInStepsToo) {
  constexpr double kStep = 1.0 / 60, g = 9.81, v = 1;
  const Scene scene = test::steel_scene(1);
  Observer observer(scene, kStep, v);
  Frame frame;
  frame.bodies = scene.initial;
  double time = 0;
  for (; time * g < 1.5 * v; time += kStep) {
    frame.bodies[0].position.z() = scene.bodies[0].radius + v * time - g * time * time / 2;
    frame.bodies[0].velocity.z() = v - g * time;
    observer.take(time, frame);
  }
  const BodyObservables seen = observer.finish(time - kStep).bodies[0];
  EXPECT_EQ(seen.lift_off_speed, v);
  EXPECT_NEAR(seen.jump_height, v * v / (2 * g), 1e-15);
}

#ifdef SLIPCHECK_SANITIZE
constexpr int kStrikes = 8;  // a second each
#else
constexpr int kStrikes = 30;
#endif

TEST(Flight, OfFixedStepsIsCoveredByItsUncertainty) {
  std::mt19937 random(5);
  int flights = 0;
  for (int k = 0; k < kStrikes; ++k) {
    const ContactScene scene = random_strike(random).scene();
    const Named exact = reference(scene, Compare::Reference::contact, 0.1);
    const Named steps = reference(scene, Compare::Reference::steps, 0.1);
    for (const std::string name : {"i.flight_time", "j.flight_time"}) {
      if (!exact.contains(name) || !steps.contains(name)) continue;
      ++flights;
      EXPECT_NEAR(steps.at(name).value, exact.at(name).value,
                  steps.at(name).uncertainty + exact.at(name).uncertainty)
          << k << name;
    }
  }
  EXPECT_GT(flights, kStrikes / 2);
}

// --- how long a law acts -------------------------------------------------------------------------

/// ξ̈ + γ ξ̇ + ω0² ξ = 0 from ξ = 0: F_N ∝ −ξ̈ falls to zero after 2 atan(2ω/γ)/ω with
/// ω² = ω0² − γ²/4, where the speed is e^(−γt/2) of the first; ξ itself returns after π/ω.
TEST(ContactTime, IsThatInWhichTheLawActs) {
  constexpr double kSoonAfter = 0.0205;  // they meet at 0.02 s
  for (const double e : {0.2, 0.57, 0.9, 0.99}) {
    for (const ContactEnd end : {ContactEnd::zero_force, ContactEnd::zero_overlap}) {
      Scene hard = test::head_on(0.3, 0, e);
      hard.substrate[0].static_friction = hard.substrate[0].kinetic_friction = 0;
      const ContactScene scene = test::soft(hard, 2.5e-5, end);
      const double m = hard.bodies[0].mass / 2;
      const auto& law = std::get<LinearForce>(scene.soft[0]->normal);
      const double gamma = law.damping / m;
      const double w = std::sqrt(law.stiffness / m - gamma * gamma / 4);
      const double acts =
          end == ContactEnd::zero_force ? 2 * std::atan(2 * w / gamma) / w : M_PI / w;
      EXPECT_NEAR(acts, 2.5e-5, 1e-12 * acts);  // what was asked for
      const Named exact = reference(scene, Compare::Reference::contact, kSoonAfter);
      EXPECT_NEAR(exact.at("i-j.contact_time").value, acts, 1e-9 * acts) << e;
      EXPECT_NEAR(exact.at("i-j.restitution").value, e, 1e-9);
      const Named steps = reference(scene, Compare::Reference::steps, kSoonAfter);
      EXPECT_NEAR(steps.at("i-j.contact_time").value, acts,
                  steps.at("i-j.contact_time").uncertainty)
          << e;
    }
  }
}

/// What is told after the collision is told of the instant at which the law ends: friction has
/// braked the sliding pair for so long, and no longer.
TEST(ContactTime, WhatFollowsTheCollisionIsSampledAtItsEnd) {
  Scene hard = test::head_on(0.3, -0.3, 0.57);
  const double mu = hard.substrate[0].kinetic_friction, g = hard.gravity;
  const ContactScene scene = test::soft(hard, 1e-3, ContactEnd::zero_force);
  const Named seen = reference(scene, Compare::Reference::contact, 0.3);
  // Over the contact both slide but for its first 1/100: the slip after it is what v changed by,
  // and friction has turned the body by A μ g t_col against it.
  const double turned = 2.5 * mu * g * seen.at("i-j.contact_time").value;
  const double slip = seen.at("i.slip_after_collision").value;
  const double rim = slip - seen.at("i.velocity_after_collision").value;
  EXPECT_NEAR(0.3 - rim, turned, 0.02 * turned);
}

}  // namespace
}  // namespace slipcheck
