#include "reference/forces/contact_solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "physics/closed_forms.h"
#include "reference/events/event_solver.h"
#include "soft_scenes.h"

namespace slipcheck {
namespace {

constexpr RunEnd kRolling{Run::Until::rolling, 0, 10};

/// Keeps all frames.
struct Film final : FrameSink {
  std::vector<std::pair<double, Frame>> frames;
  void take(double time, const Frame& frame) override { frames.emplace_back(time, frame); }

  bool touches(std::size_t k) const {
    for (const Touch& touch : frames[k].second.touches)
      if (touch.second != kSubstrate) return true;
    return false;
  }
  /// The frames between which the first two bodies that meet are in contact.
  std::pair<std::size_t, std::size_t> contact() const {
    std::size_t first = 0;
    while (first + 1 < frames.size() && !touches(first + 1)) ++first;
    std::size_t last = first + 1;
    while (last + 1 < frames.size() && touches(last + 1)) ++last;
    return {first, last};
  }
  double duration() const {
    const auto [first, last] = contact();
    return frames[last].first - frames[first].first;
  }
};

TEST(ContactSolver, K2FreePairPartsWithItsRestitutionAfterItsTime) {
  // Closed forms of the linear law; the integrator's tolerance sets the error.
  for (const ContactEnd end : {ContactEnd::zero_overlap, ContactEnd::zero_force}) {
    const ContactScene scene = test::soft(test::free_pair(0.05, -0.05, 0.005), 2.55e-5, end);
    ContactSolver solver(scene, scene.hard.initial);
    Film film;
    const SolvedRun run = solver.run(until_time(0.1), &film);
    const auto states = solver.states();
    EXPECT_NEAR(states[0].velocity.x(), -0.045, 1e-12);
    EXPECT_NEAR(states[1].velocity.x(), 0.045, 1e-12);
    // Under zero_force the overlap outlasts the force.
    const auto [first, last] = film.contact();
    double force_ends = film.frames[last].first;
    if (end == ContactEnd::zero_force) force_ends = film.frames[last - 1].first;
    EXPECT_NEAR((force_ends - film.frames[first].first) / 2.55e-5, 1, 1e-10);
    EXPECT_LT(std::abs(run.balance->error()), 1e-10);
  }
}

TEST(ContactSolver, AGapOfRoundOffBetweenBallsAtRestTakesNoTime) {
  // Looked at as if friction could close it at any moment, a minute would take ten billion looks.
  Scene hard = test::head_on(0, 0, 0.9);
  hard.initial[1].position = hard.initial[0].position;
  hard.initial[1].position.x() += 2 * hard.bodies[0].radius * (1 + 8e-15);
  for (BodyState& state : hard.initial) state.angular_velocity.setZero();
  const ContactScene scene = test::soft(hard);
  ContactSolver solver(scene, scene.hard.initial);
  const SolvedRun run = solver.run(until_time(60), nullptr);
  EXPECT_TRUE(run.reached);
  EXPECT_EQ(run.collisions, 0u);
  EXPECT_LT(run.steps, 1000u);
}

TEST(ContactSolver, AGapOfRoundOffBesideBallsThatLeanTakesNoTime) {
  // One ball stands on another; beside it a third one that nothing pushes.
  Scene hard = test::steel_scene(3);
  const double radius = hard.bodies[0].radius;
  hard.initial[1].position = Vector3(2 * radius * (1 + 8e-15), 0, radius);
  hard.initial[2].position = Vector3(0, 0, 3 * radius);
  ContactScene scene = with_hard_contacts(hard);
  const LinearContact law = LinearContact::with_collision_time(hard.bodies[0].mass / 2, 0.3, 1e-3,
                                                               LinearContact::End::zero_force);
  scene.soft[0] =
      SoftContact{LinearForce{law.stiffness(), law.damping_rate() * hard.bodies[0].mass / 2},
                  ContactEnd::zero_force, NoTangentialForce{}};
  ContactSolver solver(scene, scene.hard.initial);
  const SolvedRun run = solver.run(until_time(0.1), nullptr);
  EXPECT_TRUE(run.reached);
  const double rest = 3 * radius - hard.bodies[0].mass * hard.gravity / law.stiffness();
  EXPECT_NEAR(solver.states()[2].position.z(), rest, 1e-12);
  EXPECT_EQ(run.collisions, 1u);
}

TEST(ContactSolver, KClampOnTheDampingOfZeroOverlapGives090203) {
  ContactScene scene = test::soft(test::free_pair(0.05, -0.05, 0.005));
  scene.soft[0]->end = ContactEnd::zero_force;
  ContactSolver solver(scene, scene.hard.initial);
  solver.run(until_time(0.1), nullptr);
  EXPECT_NEAR(solver.states()[1].velocity.x() / 0.05, 0.90203, 5e-6);
}

TEST(ContactSolver, KD1ToD4SubstrateFrictionLengthensTheCollision) {
  // Relative change 4 μ_k g/(π v_rel ω0) to first order; its square and the damping set the error.
  const ContactScene scene = test::soft(test::head_on(0.05, -0.05, 0.9));
  ContactSolver solver(scene, scene.hard.initial);
  Film film;
  solver.run(kRolling, &film);
  EXPECT_NEAR(film.duration() / 2.55e-5 - 1, 1.01e-4, 0.08e-4);
  Scene elastic = test::head_on(0.05, -0.05, 1.0);
  const ContactScene undamped = test::soft(elastic);
  ContactSolver second(undamped, undamped.hard.initial);
  Film other;
  second.run(kRolling, &other);
  const double omega0 = M_PI / 2.55e-5;
  EXPECT_NEAR(other.duration() / 2.55e-5 - 1, 4 * 0.1 * 9.81 / (M_PI * 0.1 * omega0), 2e-7);
}

TEST(ContactSolver, K34SlidingStartsAtTmin) {
  // Without damping x(t) = (v/ω0) sin ω0 t passes x_min = 2 (1+A) μ_s g/ω0² at 2.27e-8 s.
  Scene hard = test::head_on(0.05, -0.05, 1.0);
  const ContactScene scene = test::soft(hard, M_PI / 1.2327e5);
  ContactSolver solver(scene, scene.hard.initial);
  Film film;
  solver.run(kRolling, &film);
  const std::size_t first = film.contact().first;
  const double touch = film.frames[first].first;
  // The instant of the touch is shown before and after.
  const auto later =
      std::find_if(film.frames.begin() + static_cast<std::ptrdiff_t>(first), film.frames.end(),
                   [&](const auto& frame) { return frame.first > touch; });
  ASSERT_NE(later, film.frames.end());
  const double onset = later->first - touch;
  const double omega0 = 1.2327e5, x_min = 2 * 3.5 * 0.5 * 9.81 / (omega0 * omega0);
  // Until then the balls roll, which makes them heavier by a part of (ω0 t_min)² = 8e-6.
  EXPECT_NEAR(onset, std::asin(x_min * omega0 / 0.1) / omega0, 1e-6 * onset);
  EXPECT_NEAR(onset, 2.26e-8, 0.01e-8);
}

TEST(ContactSolver, K55CappedRubbingTurnsBothBy0113) {
  // γ_S = γ_N/2, ν_s = 0.5, confined, on a frictionless substrate so that the rubbing acts alone.
  // 0.113 is with K's clamp at the end of the contact and γ_N of zero_overlap.
  Scene hard = test::head_on(0.1, 0, 0.9);
  hard.confined = true;
  hard.substrate[0].kinetic_friction = hard.substrate[0].static_friction = 0;
  const LinearContact law = LinearContact::with_collision_time(
      hard.bodies[0].mass / 2, 0.9, 2.55e-5, LinearContact::End::zero_overlap);
  const double half = 0.5 * law.damping_rate() * law.reduced_mass();
  const auto share = [&](double cap, ContactEnd end = ContactEnd::zero_overlap) {
    ContactScene scene =
        test::soft(hard, 2.55e-5, ContactEnd::zero_overlap, ViscousForce{half, cap});
    scene.soft[0]->end = end;
    ContactSolver solver(scene, scene.hard.initial);
    solver.run(until_time(0.1), nullptr);
    const double before = scene.hard.initial[0].angular_velocity.y();
    const auto after = solver.states();
    // Both turn by the same angle in the same sense.
    EXPECT_NEAR(after[0].angular_velocity.y() - before, after[1].angular_velocity.y(), 1e-9);
    return -after[1].angular_velocity.y() / before;
  };
  const double exponent = 2.5 * 0.5 * law.damping_rate() * 2.55e-5;
  EXPECT_NEAR(share(1e9), -0.5 * std::expm1(-exponent), 1e-10);
  EXPECT_NEAR(share(1e9), 0.116, 5e-4);
  EXPECT_NEAR(share(0.5, ContactEnd::zero_force), 0.113, 5e-4);
}

TEST(ContactSolver, AgreesWithTheEventSolverToTheShareOfTheContactInTheSlide) {
  // The difference is O(t_col/t^s) and falls with the collision time.
  const Scene hard = test::head_on(0.15, -0.15, 0.9);
  const HeadOnCollision closed{2.5, 0.9};
  double last = 0;
  for (const double t_col : {4e-5, 2e-5, 1e-5}) {
    const ContactScene scene = test::soft(hard, t_col);
    ContactSolver solver(scene, scene.hard.initial);
    ASSERT_TRUE(solver.run(kRolling, nullptr).reached);
    const auto states = solver.states();
    const double e_eff = (states[1].velocity.x() - states[0].velocity.x()) / 0.3;
    const double off = std::abs(e_eff - closed.effective_restitution());
    const double slide = 0.95 * 0.3 / (2 * 3.5 * 0.1 * 9.81);
    EXPECT_LT(off, t_col / slide);
    if (last > 0) {
      EXPECT_NEAR(off / last, 0.5, 0.01);
    }
    last = off;
  }
}

TEST(ContactSolver, HardPairsCollideAtAnInstantAsInTheEventSolver) {
  const Scene hard = test::head_on(0.2, -0.1, 0.8);
  const ContactScene scene = with_hard_contacts(hard);
  ContactSolver solver(scene, hard.initial);
  EventSolver exact(hard, hard.initial);
  ASSERT_TRUE(solver.run(kRolling, nullptr).reached);
  exact.run(kRolling, nullptr);
  EXPECT_NEAR(solver.now(), exact.now(), 1e-12);
  for (std::size_t i : {0u, 1u}) {
    EXPECT_LT((solver.states()[i].position - exact.states()[i].position).norm(), 1e-13);
    EXPECT_LT((solver.states()[i].velocity - exact.states()[i].velocity).norm(), 1e-12);
  }
}

TEST(ContactSolver, AGrazeShorterThanAStepIsNotMissed) {
  // Two balls pass and overlap by a millionth of their radius, for 1e-5 of the flight.
  Scene hard = test::free_pair(1, -1);
  const double reach = 2 * 0.002 - 2e-9;
  hard.initial[0].position.y() = reach / 2;
  hard.initial[1].position.y() = -reach / 2;
  hard.initial[0].position.x() = -3;
  hard.initial[1].position.x() = 3;
  const ContactScene scene = test::soft(hard, 1e-7);
  ContactSolver solver(scene, scene.hard.initial);
  const SolvedRun run = solver.run(until_time(6), nullptr);
  EXPECT_EQ(run.collisions, 1u);
  EXPECT_GT(solver.states()[0].velocity.y(), 1e-4);
}

TEST(ContactSolver, KAppFLiftedStrikerFliesAndLands) {
  // Strong rubbing lifts the striker: ballistic flight from its speed at the end of the contact.
  Scene hard = test::head_on(0.3, 0, 0.9);
  const ContactScene scene =
      test::soft(hard, 2.55e-5, ContactEnd::zero_overlap, ViscousForce{4, 0.1});
  ContactSolver solver(scene, scene.hard.initial);
  Film film;
  const SolvedRun run = solver.run(kRolling, &film);
  ASSERT_TRUE(run.reached) << run.reason;
  const auto [first, last] = film.contact();
  const BodyState& after = film.frames[last].second.bodies[0];
  EXPECT_GT(after.velocity.z(), 0.01);
  const double h = after.position.z() - 0.002, v = after.velocity.z();
  const double landing = film.frames[last].first + (v + std::sqrt(v * v + 2 * 9.81 * h)) / 9.81;
  bool landed = false;
  for (const auto& [time, frame] : film.frames) landed |= std::abs(time - landing) < 1e-13;
  EXPECT_TRUE(landed);
  EXPECT_LT(std::abs(run.balance->error()), 1e-10);
  // The struck one never leaves the plane.
  for (const auto& [time, frame] : film.frames) EXPECT_EQ(frame.bodies[1].position.z(), 0.002);
}

TEST(ContactSolver, SpinAboutTheVerticalShearsAnObliqueHit) {
  // Two free balls, sticking never reached: the shear impulse is ν_s times the normal one, against
  // R Ω_z at the contact. L (5)-(12), sliding; the line of centres turns by a little, which sets
  // the error.
  Scene hard = test::free_pair(0.1, -0.1, 0.005);
  hard.initial[0].angular_velocity.z() = 200;
  const ContactScene scene =
      test::soft(hard, 1e-6, ContactEnd::zero_overlap, ViscousForce{1e3, 0.05});
  ContactSolver solver(scene, scene.hard.initial);
  solver.run(until_time(0.1), nullptr);
  const auto states = solver.states();
  const double normal = 0.5 * 1.9 * 0.2;  // impulse over mass
  EXPECT_NEAR(states[0].velocity.y(), -0.05 * normal, 1e-3 * normal);
  EXPECT_NEAR(states[1].velocity.y(), 0.05 * normal, 1e-3 * normal);
  const double turned = -2.5 * 0.05 * normal / 0.002;
  EXPECT_NEAR(states[0].angular_velocity.z() - 200, turned, 1e-2 * std::abs(turned));
  EXPECT_NEAR(states[1].angular_velocity.z(), turned, 1e-2 * std::abs(turned));
}

TEST(ContactSolver, K4K6CapsApartTakeSqrtTwoOfOne) {
  // Both parts of the slip are far above what the contact can stop: F_S and F_R are ν_s F_N each,
  // or that along the slip. ∫F_N dt = (1 + e) m̄ v, and a spin loses R/I of the impulse.
  const double v = 0.1, nu = 1e-3, spin = 40;
  Scene hard = test::free_pair(v / 2, -v / 2, 0.005);
  hard.gravity = 0;
  for (BodyState& state : hard.initial) {
    state.position.z() += 1;
    state.angular_velocity = Vector3(0, 2 * spin, spin);  // F_R, F_S
  }
  const Sphere& ball = hard.bodies[0];
  const double e = std::get<double>(hard.pairs[0].restitution);
  const double lost = nu * (1 + e) * 0.5 * ball.mass * v * ball.radius / ball.moment_of_inertia();
  for (const auto caps : {ViscousForce::Caps::together, ViscousForce::Caps::apart}) {
    const ContactScene scene = test::soft(hard, 2.55e-5, ContactEnd::zero_force,
                                          ViscousForce{1e3 * ball.mass / 2.55e-5, nu, caps});
    ContactSolver solver(scene, scene.hard.initial);
    const SolvedRun run = solver.run(until_time(0.11), nullptr);
    EXPECT_LT(std::abs(run.balance->error()), 1e-10);
    const Vector3 change =
        scene.hard.initial[0].angular_velocity - solver.states()[0].angular_velocity;
    const bool apart = caps == ViscousForce::Caps::apart;
    // The line of centres turns by v t_col/2R of what the impulses do to it: below 1e-5.
    EXPECT_NEAR(change.y() / lost, apart ? 1 : 2 / std::sqrt(5), 1e-4);
    EXPECT_NEAR(change.z() / lost, apart ? 1 : 1 / std::sqrt(5), 1e-4);
  }
}

TEST(ContactSolver, BallsThatComeToRestAgainstEachOtherEndTheRun) {
  // The struck ball brakes harder than the striker, which leans on it until both rest.
  Scene hard = test::head_on(0.05, 0, 0.05);
  hard.substrate.push_back(hard.substrate[0]);
  hard.substrate[0].rolling = RollingFriction(0.002);
  hard.substrate[1].rolling = RollingFriction(0.3);
  hard.material = {0, 1};
  hard.pairs.assign(4, hard.pairs[0]);
  ContactScene scene = test::soft(hard);
  scene.soft.assign(4, scene.soft[0]);
  ContactSolver solver(scene, scene.hard.initial);
  const SolvedRun run = solver.run({Run::Until::rest, 0, 20}, nullptr);
  EXPECT_TRUE(run.reached) << run.reason;
  for (const BodyState& state : solver.states()) EXPECT_LT(state.velocity.norm(), 1e-9);
  EXPECT_LT(std::abs(run.balance->error()), 1e-10);
}

TEST(ContactSolver, TurnedSceneTurnsItsResult) {
  Scene hard = test::head_on(0.2, -0.1, 0.9);
  hard.initial[1].position.y() = 0.0011;
  const ViscousForce rough{2, 0.3};
  const ContactScene straight = test::soft(hard, 2.55e-5, ContactEnd::zero_overlap, rough);
  const Eigen::AngleAxisd turn(0.7, kUp);
  Scene turned_hard = hard;
  for (BodyState& state : turned_hard.initial) {
    state.position = turn * state.position;
    state.velocity = turn * state.velocity;
    state.angular_velocity = turn * state.angular_velocity;
  }
  const ContactScene turned = test::soft(turned_hard, 2.55e-5, ContactEnd::zero_overlap, rough);
  ContactSolver a(straight, straight.hard.initial), b(turned, turned.hard.initial);
  ASSERT_TRUE(a.run(kRolling, nullptr).reached);
  ASSERT_TRUE(b.run(kRolling, nullptr).reached);
  // The integrator's tolerance, grown by the collision.
  for (std::size_t i : {0u, 1u}) {
    const Vector3 expected = turn * a.states()[i].velocity;
    EXPECT_LT((b.states()[i].velocity - expected).norm(), 1e-10);
  }
}

TEST(ContactSolver, AHundredthOfTheToleranceAHundredthOfTheError) {
  const ContactScene scene = test::soft(test::head_on(0.2, 0, 0.8), 2.55e-5,
                                        ContactEnd::zero_overlap, ViscousForce{2, 0.3});
  const auto speed = [&](double tolerance) {
    ContactSettings settings;
    settings.tolerance = tolerance;
    ContactSolver solver(scene, scene.hard.initial, settings);
    solver.run(kRolling, nullptr);
    return solver.states()[1].velocity.x();
  };
  const double best = speed(1e-13);
  EXPECT_LT(std::abs(speed(1e-12) - best), 1e-11);
  EXPECT_LT(std::abs(speed(1e-10) - best), 1e-9);
  EXPECT_LT(std::abs(speed(1e-7) - best), 1e-6);
}

}  // namespace
}  // namespace slipcheck
