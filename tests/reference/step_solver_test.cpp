#include "reference/steps/step_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "../support/extremes.h"
#include "physics/contact/elastic_pair.h"
#include "reference/steps/step_pair.h"
#include "scene/impact.h"
#include "step_scenes.h"

namespace slipcheck {
namespace {

using namespace test;

TEST(StepSolver, SecondOrderInDampedLinearCollision) {
  const Scene scene = free_pair(0.05, -0.05);
  const double mass = 0.5 * scene.bodies[0].mass;
  const SoftContact contact = linear_contact(mass, 0.7, kCollisionTime, ContactEnd::zero_overlap);
  const auto& law = std::get<LinearForce>(contact.normal);
  const double half = 0.5 * law.damping / mass,
               omega = std::sqrt(law.stiffness / mass - half * half);
  // ξ = (g/ω) e^(−γt/2) sin ωt, still in contact.
  const double t = 0.7 * kCollisionTime;
  const double exact = 0.1 / omega * std::exp(-half * t) * std::sin(omega * t);
  const double exact_rate =
      0.1 * std::exp(-half * t) * (std::cos(omega * t) - half / omega * std::sin(omega * t));
  const ContactScene all = with_contact(scene, contact);
  const auto states = [&](int steps) {
    StepSolver solver(all, scene.initial, {t / steps});
    solver.run(until_time(t), nullptr);
    return solver.states();
  };
  const auto error = [&](int steps) { return std::abs(overlap(scene, states(steps)) - exact); };
  const auto rate_error = [&](int steps) { return std::abs(closing(states(steps)) - exact_rate); };
  // The next term of the error is of relative size h ω ~ 1/50.
  EXPECT_NEAR(order(error, 100), 2, 0.04);
  EXPECT_NEAR(order(rate_error, 100), 2, 0.04);
  EXPECT_LT(error(200), 1e-4 * exact);
}

TEST(StepSolver, SecondOrderInHertzCollision) {
  const Scene scene = free_pair(0.05, -0.05);
  const double mass = 0.5 * scene.bodies[0].mass, modulus = 1e10;
  const ContactScene all =
      with_contact(scene, {HertzForce{modulus}, ContactEnd::zero_overlap, NoTangentialForce{}});
  // At half of the duration all of the energy is in the largest overlap.
  const double t = 0.5 * hertz_duration(mass, modulus, 0.1);
  const double exact = hertz_largest_overlap(mass, modulus, 0.1);
  const auto error = [&](int steps) {
    StepSolver solver(all, scene.initial, {t / steps});
    solver.run(until_time(t), nullptr);
    return std::abs(overlap(scene, solver.states()) - exact);
  };
  EXPECT_NEAR(order(error, 100), 2, 0.06);
}

/// The largest error of e_n over 16 places of the first touch within a step.
double worst_restitution_error(const SoftContact& contact, double exact, double duration,
                               int steps) {
  double worst = 0;
  for (int phase = 0; phase < 16; ++phase) {
    const double h = duration / steps;
    const Scene scene = free_pair(0.05, -0.05, 0.002 + 0.05 * h * phase / 16);
    const ContactScene all = with_contact(scene, contact);
    StepSolver solver(all, scene.initial, {h});
    solver.run(until_time(1.5 * duration), nullptr);
    worst = test::largest_of(worst, std::abs(-closing(solver.states()) / 0.1 - exact));
  }
  return worst;
}

TEST(StepSolver, RestitutionIsOfSecondOrderWhereverWithinAStepTheCollisionBegins) {
  const double mass = 0.5 * free_pair(0.05, -0.05).bodies[0].mass;
  const auto check = [&](const SoftContact& contact, double least_order, const char* what) {
    const Impact exact = impact(contact.normal, mass, 0.1, contact.end);
    const auto error = [&](int steps) {
      return worst_restitution_error(contact, exact.restitution, exact.duration, steps);
    };
    const double first = error(50);
    EXPECT_GT(std::log2(first / error(400)) / 3, least_order) << what;
    EXPECT_LT(first, 2e-3) << what;
  };
  // The worst of 16 phases is not smooth in the step. An error of first order, which a force that
  // starts or ends with a jump leaves if that is not cared for, would give 1.
  for (const ContactEnd end : {ContactEnd::zero_overlap, ContactEnd::zero_force}) {
    check(linear_contact(mass, 0.7, kCollisionTime, end), 1.8, "linear");
    check({CompactViscoelasticForce{1e10, 5e-7}, end, NoTangentialForce{}}, 1.8, "compact");
    check({PowerForce{1e10, 3e4, 1.5, 1}, end, NoTangentialForce{}}, 1.8, "power");
    // F_N of B (24) begins like √t, for which no rule with equal steps is better than 3/2.
    check({ViscoelasticForce{1e10, 5e-7}, end, NoTangentialForce{}}, 1.15, "viscoelastic");
  }
}

/// A sphere of mass m between two of 1e12 m, both of which it overlaps by `squeeze`.
Scene squeezed(double squeeze) {
  Scene scene = test::steel_scene(3);
  scene.gravity = 0;
  for (std::size_t i = 0; i < 3; ++i)
    scene.initial[i].position = {(static_cast<double>(i) - 1) * (0.004 - squeeze), 0, 1};
  scene.bodies[0].mass *= 1e12;
  scene.bodies[2].mass *= 1e12;
  return scene;
}

TEST(StepSolver, EnergyOfABoundPairDoesNotDrift) {
  Scene scene = squeezed(1e-6);
  scene.initial[1].velocity = {0.01, 0, 0};
  for (const NormalForce& law : {NormalForce(LinearForce{1e6, 0}), NormalForce(HertzForce{1e9})}) {
    const ContactScene all =
        with_contact(scene, {law, ContactEnd::zero_overlap, NoTangentialForce{}});
    const double stiffness =
        2 * (std::holds_alternative<LinearForce>(law) ? 1e6 : 1.5e9 * std::sqrt(1e-6));
    const double period = 2 * M_PI / std::sqrt(stiffness / scene.bodies[1].mass);
    const double h = period / 40;
    StepSolver solver(all, scene.initial, {h});
    const double first = solver.energy();
    const double kinetic = 0.5 * scene.bodies[1].mass * 1e-4;
    const auto range = [&](double from) {
      double low = 1e300, high = -1e300;
      for (int n = 1; n <= 400; ++n) {
        solver.run(until_time(from + n * period / 10), nullptr);
        low = test::least_of(low, solver.energy() - first);
        high = test::largest_of(high, solver.energy() - first);
      }
      return std::pair(low / kinetic, high / kinetic);
    };
    const auto early = range(0);
    const auto late = range(5000 * period);
    // The shadow energy differs by (hω)²/8 = 0.003 of the energy that swings, and the range keeps;
    // what is left is in how the samples fall.
    EXPECT_LT(early.second - early.first, 0.01);
    EXPECT_NEAR(late.second, early.second, 2e-4);
    EXPECT_NEAR(late.first, early.first, 2e-4);
  }
}

/// Largest speed of the squeezed sphere in a run of 2000 steps of `ratio` times the limit, over
/// that at the start.
double growth(double damping_ratio, double ratio) {
  Scene scene = squeezed(1e-6);
  const double mass = scene.bodies[1].mass, omega = 2e5;
  // Both sides push: ω0² = 2k/m, γ = 2c/m.
  const LinearForce law{0.5 * mass * omega * omega, 0.5 * mass * damping_ratio * omega};
  scene.initial[1].velocity = {1e-10, 0, 0};
  const ContactScene all =
      with_contact(scene, {law, ContactEnd::zero_overlap, NoTangentialForce{}});
  const double h = ratio * step_limit(omega, damping_ratio * omega);
  StepSolver solver(all, scene.initial, {h});
  double largest = 0;
  for (int n = 1; n <= 2000; ++n) {
    solver.run(until_time(n * h), nullptr);
    largest = test::largest_of(largest, std::abs(solver.states()[1].velocity.x()));
  }
  return largest / 1e-10;
}

TEST(StepSolver, LosesStabilityAtTheDerivedStep) {
  EXPECT_DOUBLE_EQ(step_limit(3, 0), 2.0 / 3);
  for (const double damping_ratio : {0.0, 0.07, 0.5, 1.5}) {
    // Just below it nothing grows, but without damping by 1/√(1 − (hω/2)²) = 10; round-off of
    // positions, 1e-13 m/s, is far below the speed.
    EXPECT_LT(growth(damping_ratio, 0.995), 11) << damping_ratio;
    EXPECT_GT(growth(damping_ratio, 1.005), 1000) << damping_ratio;
  }
}

/// Counts frames and keeps the pair's largest impulse.
struct TouchWatch final : FrameSink {
  void take(double time, const Frame& frame) override {
    EXPECT_GE(time, last);
    last = time;
    ++frames;
    for (const Touch& touch : frame.touches)
      if (touch.second != kSubstrate) pair_impulse += touch.normal_impulse;
  }
  double last = 0, pair_impulse = 0;
  std::size_t frames = 0;
};

TEST(StepSolver, ShowsAFrameAStepWithTheImpulses) {
  const ContactScene all = colliding(0.1, -0.1, 0.9, kCollisionTime);
  StepSolver solver(all, all.hard.initial, {kCollisionTime / 100});
  TouchWatch watch;
  const SolvedRun run = solver.run(until_time(0.002), &watch);
  EXPECT_EQ(watch.frames, run.steps + 1);
  EXPECT_EQ(watch.last, run.end_time);
  // The impulse m̄ (1 + e) v_rel; friction of the substrate takes ~1e-4 of it, |F_N| counts at the
  // attracting end.
  const double impulse = 0.5 * all.hard.bodies[0].mass * 1.9 * 0.2;
  EXPECT_NEAR(watch.pair_impulse / impulse, 1, 0.01);
}

TEST(StepSolver, WatchingDoesNotChangeTheRun) {
  const ContactScene all = colliding(0.2, -0.05, 0.9, kCollisionTime, ViscousForce{1, 0.5});
  StepSolver seen(all, all.hard.initial, {kCollisionTime / 50});
  StepSolver unseen(all, all.hard.initial, {kCollisionTime / 50});
  TouchWatch watch;
  const SolvedRun a = seen.run(kRolling, &watch), b = unseen.run(kRolling, nullptr);
  EXPECT_EQ(a.steps, b.steps);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(seen.states()[i].position, unseen.states()[i].position);
    EXPECT_EQ(seen.states()[i].angular_velocity, unseen.states()[i].angular_velocity);
  }
}

TEST(StepSolver, FullLoopWithNothingToDoEqualsThePlainOne) {
  // A slope too small to move anything by more than round-off asks for the full substrate.
  ContactScene plain = colliding(0.2, -0.05, 0.9, kCollisionTime, ViscousForce{1, 0.5});
  ContactScene full = plain;
  full.hard.downhill = {0, 1e-18};
  const std::vector<BodyState> initial = plain.hard.initial;
  StepSolver a(plain, initial, {kCollisionTime / 50}), b(full, initial, {kCollisionTime / 50});
  a.run(until_time(0.01), nullptr);
  b.run(until_time(0.01), nullptr);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT((a.states()[i].velocity - b.states()[i].velocity).norm(), 1e-12);
    EXPECT_LT((a.states()[i].position - b.states()[i].position).norm(), 1e-13);
  }
}

TEST(StepSolver, MixedLawsEqualTheSpecialisedLoop) {
  const ContactScene plain = colliding(0.2, -0.05, 0.9, kCollisionTime, ViscousForce{1, 0.5});
  // Two more bodies far away, of another material with another law.
  ContactScene mixed = plain;
  mixed.hard.substrate.resize(2, plain.hard.substrate[0]);
  mixed.hard.pairs.resize(4, plain.hard.pairs[0]);
  mixed.hard.bodies.resize(4, plain.hard.bodies[0]);
  mixed.hard.material = {0, 0, 1, 1};
  mixed.hard.initial.push_back(test::rolling_at(1, 0, 0, 0));
  mixed.hard.initial.push_back(test::rolling_at(2, 0, 0, 0));
  const SoftContact other{HertzForce{1e10}, ContactEnd::zero_force, NoTangentialForce{}};
  mixed.soft = {plain.soft[0], other, other, other};
  StepSolver a(plain, plain.hard.initial, {kCollisionTime / 50});
  StepSolver b(mixed, mixed.hard.initial, {kCollisionTime / 50});
  a.run(until_time(0.01), nullptr);
  b.run(until_time(0.01), nullptr);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(a.states()[i].velocity, b.states()[i].velocity);
}

TEST(StepSolver, HardPairsAreRefused) {
  ContactScene scene;
  scene.hard = test::head_on(0.1, -0.1, 0.9);
  scene.soft.resize(1);
  EXPECT_THROW(StepSolver(scene, scene.hard.initial, {1e-6}), Unsupported);
}

TEST(StepSolver, SaysWhyItDidNotReachItsEnd) {
  const ContactScene all = colliding(0.1, -0.1, 0.9, kCollisionTime);
  StepSolver solver(all, all.hard.initial, {kCollisionTime / 20});
  const SolvedRun run = solver.run({Run::Until::rolling, 0, 0.01}, nullptr);
  EXPECT_FALSE(run.reached);
  EXPECT_EQ(run.reason, "a body still slides or flies, or collides again, at the limit");
}

/// The step's own form, without a branch and with one root less.
TEST(StepPair, ViscousForceIsTheLaw) {
  const ViscousPair pair{{3.0, 0.4}};
  for (const double normal : {-2.0, 0.0, 0.5, 2.0})
    for (const double speed : {1e-9, 0.06, 0.1, 1.0}) {
      const Vector3 slip = speed * Vector3(2, -1, 2) / 3;
      TangentialBranch branch;
      follow(pair.law, normal, speed, branch);
      const Vector3 law = tangential_force(pair.law, branch, normal, slip, no_vector<Vector3>());
      EXPECT_LE((pair.force({}, normal, slip) - law).norm(), 4e-16 * law.norm()) << normal;
    }
}

}  // namespace
}  // namespace slipcheck
