// Bodies that start in overlap: what is stored in their contacts sets them going.

#include "reference/initial_contacts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "physics/contact/elastic_pair.h"
#include "reference/forces/contact_solver.h"
#include "reference/reference_solver.h"
#include "reference/steps/step_solver.h"
#include "soft_scenes.h"

namespace slipcheck {
namespace {

constexpr double kR = 0.002;
/// What the integration leaves of a balance: 1e-13 in each of some hundred steps.
constexpr double kBalance = 1e-10;

/// When two bodies were last in contact, and how fast they parted then.
struct LastTouch final : FrameSink {
  double time = -1, speed = 0;
  void take(double now, const Frame& frame) override {
    for (const Touch& touch : frame.touches) {
      if (touch.second == kSubstrate) continue;
      time = now;
      speed = frame.bodies[1].velocity.x() - frame.bodies[0].velocity.x();
    }
  }
};

/// `count` balls at rest in a row, each `overlap` [m] into the next, on a smooth substrate.
Scene row(std::size_t count, double overlap, double restitution = 1) {
  Scene hard = test::steel_scene(count);
  hard.pairs[0].restitution = restitution;
  hard.substrate[0].static_friction = hard.substrate[0].kinetic_friction = 0;
  for (std::size_t i = 0; i < count; ++i)
    hard.initial[i].position.x() = static_cast<double>(i) * (2 * kR - overlap);
  return hard;
}

double overlap_now(const ContactSolver& solver) {
  const auto states = solver.states();
  return 2 * kR - (states[0].position - states[1].position).norm();
}

ContactScene with_law(const Scene& hard, const NormalForce& normal,
                      const TangentialForce& tangential = NoTangentialForce{}) {
  ContactScene scene = with_hard_contacts(hard);
  scene.soft[0] = SoftContact{normal, ContactEnd::zero_overlap, tangential};
  return scene;
}

TEST(InitialContacts, AnUndampedSpringPartsThemInAQuarterPeriod) {
  // ξ = ξ0 cos ω0 t; the integrator's tolerance sets the errors.
  const double t_col = 1e-3, omega0 = M_PI / t_col;
  for (const double overlap : {1e-9 * kR, 0.1 * kR, 0.5 * kR, 0.999 * kR}) {
    const ContactScene scene = test::soft(row(2, overlap), t_col);
    ContactSolver solver(scene, scene.hard.initial);
    LastTouch touch;
    const SolvedRun run = solver.run(until_time(0.01), &touch);
    // The distance of the centres knows an overlap to 1e-16 of itself.
    const double known = 1e-11 + 1e-15 * kR / overlap;
    EXPECT_EQ(run.collisions, 1u);
    EXPECT_NEAR(touch.time / (M_PI / (2 * omega0)), 1, known);
    EXPECT_NEAR(touch.speed / (omega0 * overlap), 1, known);
    EXPECT_NEAR(solver.states()[0].velocity.x() / (-0.5 * omega0 * overlap), 1, known);
    EXPECT_NEAR(solver.states()[1].velocity.x() / (0.5 * omega0 * overlap), 1, known);
    EXPECT_LT(std::abs(run.balance->error()), kBalance);
  }
}

TEST(InitialContacts, ADampedSpringFollowsItsClosedForm) {
  // ξ = ξ0 e^(−γt/2) (cos ωt + (γ/2ω) sin ωt), ω² = ω0² − γ²/4: no overlap at ωt = π − atan(2ω/γ),
  // no force at ωt = atan(2ω/γ), where −ξ̇ = ω0 ξ0 e^(−γt/2).
  const double overlap = 0.3 * kR;
  for (const ContactEnd end : {ContactEnd::zero_overlap, ContactEnd::zero_force}) {
    const ContactScene scene = test::soft(row(2, overlap, 0.4), 1e-3, end);
    const double reduced = scene.hard.bodies[0].mass / 2;
    const auto& law = std::get<LinearForce>(scene.soft[0]->normal);
    const double gamma = law.damping / reduced, omega02 = law.stiffness / reduced;
    const double omega = std::sqrt(omega02 - gamma * gamma / 4);
    const auto left = [&](double t) {
      return overlap * std::exp(-gamma * t / 2) *
             (std::cos(omega * t) + gamma / (2 * omega) * std::sin(omega * t));
    };
    const auto speed = [&](double t) {
      return overlap * omega02 / omega * std::exp(-gamma * t / 2) * std::sin(omega * t);
    };
    const double no_force = std::atan(2 * omega / gamma) / omega;
    const double no_overlap = (M_PI - std::atan(2 * omega / gamma)) / omega;
    for (const double part : {0.1, 0.5, 0.9}) {
      ContactSolver solver(scene, scene.hard.initial);
      solver.run(until_time(part * no_force), nullptr);
      EXPECT_NEAR(overlap_now(solver) / overlap, left(part * no_force) / overlap, 1e-11);
    }
    ContactSolver solver(scene, scene.hard.initial);
    LastTouch touch;
    const SolvedRun run = solver.run(until_time(0.01), &touch);
    const bool clamped = end == ContactEnd::zero_force;
    const double parted = speed(clamped ? no_force : no_overlap);
    EXPECT_NEAR(touch.speed / parted, 1, 1e-10);
    // Free after the force has gone, until no overlap is left.
    const double last = clamped ? no_force + left(no_force) / parted : no_overlap;
    EXPECT_NEAR(touch.time / last, 1, 1e-10);
    EXPECT_LT(std::abs(run.balance->error()), kBalance);
    EXPECT_GT(run.balance->dissipated, 0);
  }
}

TEST(InitialContacts, HertzGivesBackTwoFifthsOfKTimesTheOverlapToFiveHalves) {
  const Scene hard = row(2, 0.1 * kR);
  const double overlap = 0.1 * kR, rho = 1e6;
  const ContactScene scene = with_law(hard, HertzForce{rho});
  ContactSolver solver(scene, hard.initial);
  LastTouch touch;
  const SolvedRun run = solver.run(until_time(0.01), &touch);
  const double energy = 0.4 * rho * std::pow(overlap, 2.5);
  const double speed = std::sqrt(2 * energy / (hard.bodies[0].mass / 2));
  EXPECT_NEAR(run.balance->initial / energy, 1, 1e-12);
  EXPECT_NEAR(touch.speed / speed, 1, 1e-10);
  EXPECT_NEAR(touch.time / (hertz_duration(hard.bodies[0].mass / 2, rho, speed) / 2), 1, 1e-10);
  EXPECT_LT(std::abs(run.balance->error()), kBalance);
}

TEST(InitialContacts, WithoutGravityNothingElseSetsAScale) {
  Scene hard = row(2, 0.5 * kR);
  hard.gravity = 0;
  const ContactScene scene = test::soft(hard, 1e-3);
  ContactSolver solver(scene, hard.initial);
  const SolvedRun run = solver.run(until_time(0.01), nullptr);
  EXPECT_NEAR(solver.states()[1].velocity.x() / (0.25 * M_PI * kR / 1e-3), 1, 1e-11);
  EXPECT_LT(std::abs(run.balance->error()), kBalance);
  EXPECT_NEAR(speed_scale(scene), 0.5 * M_PI * kR / 1e-3, 1e-12);
}

TEST(InitialContacts, ThrownUpwardsTheyFallAgain) {
  // One above the other, the lower one held by the plane: m z̈ = k ξ − m g.
  Scene hard = row(2, 0);
  const double overlap = 0.5 * kR, k = 100, m = hard.bodies[0].mass;
  hard.initial[1].position = Vector3(0, 0, 3 * kR - overlap);
  const ContactScene scene = with_law(hard, LinearForce{k, 0});
  ContactSolver solver(scene, hard.initial);
  const double omega = std::sqrt(k / m), rest = m * hard.gravity / k;
  const double t = std::acos(-rest / (overlap - rest)) / omega;
  const double v = omega * (overlap - rest) * std::sin(omega * t);
  const SolvedRun run = solver.run(until_time(t + v / hard.gravity), nullptr);
  EXPECT_NEAR(solver.states()[1].position.z() / (3 * kR + v * v / (2 * hard.gravity)), 1, 1e-11);
  EXPECT_EQ(solver.states()[0].position.z(), kR);
  EXPECT_LT(std::abs(run.balance->error()), kBalance);
}

TEST(InitialContacts, RollingFrictionHoldsWhatPressesLess) {
  Scene hard = row(2, 0.1 * kR);
  hard.substrate[0].static_friction = hard.substrate[0].kinetic_friction = 0.5;
  hard.substrate[0].rolling = RollingFriction(0.3);
  const double weight = hard.bodies[0].mass * hard.gravity;
  // Rolling takes A/(1 + A) = 5/7 of what pushes a body.
  const double held = 0.3 * weight / (5.0 / 7);
  for (const double share : {0.99, 1.01}) {
    const ContactScene scene = with_law(hard, LinearForce{share * held / (0.1 * kR), 0});
    ContactSolver solver(scene, hard.initial);
    const SolvedRun run = solver.run({Run::Until::rest, 0, 20}, nullptr);
    EXPECT_TRUE(run.reached) << run.reason;
    EXPECT_EQ(run.end_time == 0, share < 1);
    if (share < 1) {
      EXPECT_EQ(solver.states()[1].position, hard.initial[1].position);
    }
    EXPECT_LT(std::abs(run.balance->error()), kBalance);
  }
}

TEST(InitialContacts, ManyOnRoughStillTiltedAndMovingPlanes) {
  // A row and one on top of it, of two radii, that spin and rub.
  const std::vector<TangentialForce> rubbing = {
      NoTangentialForce{}, ViscousForce{0.5, 0.4},
      AsperityForce{0.3, 1e-5, AsperityForce::Form::printed},
      AsperityForce{0.3, 1e-5, AsperityForce::Form::passive}};
  const std::vector<NormalForce> normals = {LinearForce{1e3, 0.05}, HertzForce{1e5},
                                            ViscoelasticForce{1e5, 1e-5},
                                            PowerForce{1e4, 1, 1.3, 0.4}};
  for (const int plane : {0, 1, 2})
    for (const TangentialForce& tangential : rubbing)
      for (const NormalForce& normal : normals) {
        Scene hard = row(4, 0.2 * kR);
        hard.substrate[0].static_friction = 0.5;
        hard.substrate[0].kinetic_friction = 0.2;
        hard.bodies[1].radius *= 1.1;
        hard.initial[1].position.z() = hard.bodies[1].radius;
        hard.initial[3].position = Vector3(kR, 0, 2.5 * kR);
        hard.initial[0].angular_velocity = Vector3(0, 20, 10);
        hard.initial[2].velocity = Vector3(0.1, 0.2, 0);
        if (plane == 1) hard.downhill = Vector2(0, -3);
        if (plane == 2) hard.motion = SubstrateMotion::oscillation(Vector2(1e-4, 0), 50, 0);
        const ContactScene scene = with_law(hard, normal, tangential);
        ASSERT_GE(initial_contacts(scene, hard.initial).size(), 4u);
        ContactSolver solver(scene, hard.initial);
        const SolvedRun run = solver.run(until_time(0.02), nullptr);
        EXPECT_TRUE(run.reached) << run.reason;
        EXPECT_LT(std::abs(run.balance->error()), 5 * kBalance)
            << "plane " << plane << ", normal " << normal.index() << ", tangential "
            << tangential.index();
      }
}

TEST(InitialContacts, TheFirstContactIsThereFromTheStart) {
  const ContactScene scene = test::soft(row(2, 0.1 * kR), 1e-3);
  EXPECT_EQ(ContactSolver(scene, scene.hard.initial).first_contact(1), 0);
  const ReferenceSolver solver(scene, Compare::Reference::automatic);
  EXPECT_EQ(solver.first_contact(1), 0);
  EXPECT_GT(solver.states_at(1e-3)[1].velocity.x(), 0.1);
  EXPECT_THROW(ReferenceSolver(scene, Compare::Reference::event), Unsupported);
  // Looking for what meets next, an overlap of bodies that do not approach is none.
  EXPECT_EQ(solver.next_collision(scene.hard.initial, 0, 1, 0),
            std::numeric_limits<double>::infinity());
}

TEST(InitialContacts, TouchingIsNone) {
  for (const double overlap : {0.0, 1e-13 * kR, -1e-13 * kR}) {
    const ContactScene scene = test::soft(row(5, overlap), 1e-3);
    EXPECT_TRUE(initial_contacts(scene, scene.hard.initial).empty());
  }
  const ContactScene hard = with_hard_contacts(row(2, 0.1 * kR));
  EXPECT_TRUE(initial_contacts(hard, hard.hard.initial).empty());
}

TEST(InitialContacts, TheFixedStepSolverAgreesToSecondOrder) {
  const double t_col = 1e-3, overlap = 0.5 * kR;
  const ContactScene scene = test::soft(row(2, overlap), t_col);
  const double speed = 0.5 * overlap * M_PI / t_col;
  double last = 0;
  for (const double h : {1e-5, 0.5e-5, 0.25e-5}) {
    StepSolver solver(scene, scene.hard.initial, {h});
    solver.run(until_time(0.4 * t_col), nullptr);
    // Before they part: v = ω0 ξ0/2 sin ω0 t.
    const double off = std::abs(solver.states()[1].velocity.x() - speed * std::sin(0.4 * M_PI));
    EXPECT_LT(off, 1e-3 * speed);
    if (last > 0) {
      EXPECT_NEAR(last / off, 4, 0.1);
    }
    last = off;
  }
}

}  // namespace
}  // namespace slipcheck
