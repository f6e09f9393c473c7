#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../scenes.h"
#include "physics/contact/linear_contact.h"
#include "reference/piles/pile_law.h"
#include "reference/piles/pile_solver.h"

// Contacts that remember beside closed forms of what spheres then do.

namespace slipcheck {
namespace {

constexpr double kTime = 2.55e-5;  // t_col [s]
constexpr double kRadius = 0.002;  // of steel_scene()
constexpr double kGravity = 9.81;

/// Two spheres that touch and approach with 30 cm/s, far from everything.
ContactScene collision(double restitution, const SpringFriction& sliding, double slip) {
  ContactScene scene = with_hard_contacts(test::free_pair(0.15, -0.15));
  scene.hard.has_substrate = false;
  const double mass = scene.hard.bodies[0].mass / 2;
  const LinearContact law =
      LinearContact::with_collision_time(mass, restitution, kTime, ContactEnd::zero_overlap);
  SoftContact contact{LinearForce{law.stiffness(), law.damping_rate() * mass},
                      ContactEnd::zero_overlap, NoTangentialForce{}};
  contact.memory = ContactMemory{sliding, {}, {}};
  scene.soft[0] = contact;
  // Both turn alike, so that nothing but their surfaces moves across the line of centres.
  for (BodyState& state : scene.hard.initial) state.angular_velocity.z() = 0.5 * slip / kRadius;
  return scene;
}

double stiffness_of(const ContactScene& scene) {
  return std::get<LinearForce>(scene.soft[0]->normal).stiffness;
}

std::vector<BodyState> after(const ContactScene& scene, double time, double step,
                             EnergyBalance* balance = nullptr) {
  PileSolver solver(scene, scene.hard.initial, {.step = step});
  const SolvedRun run = solver.run(until_time(time), nullptr);
  EXPECT_TRUE(run.reached) << run.reason;
  if (balance) *balance = *run.balance;
  return solver.states();
}

double slip_of(const std::vector<BodyState>& s) {
  const Vector3 n = (s[0].position - s[1].position).normalized(), v = s[0].velocity - s[1].velocity;
  const Vector3 turning = kRadius * (s[0].angular_velocity + s[1].angular_velocity);
  return (v - v.dot(n) * n - turning.cross(n)).norm();
}

/// The slip with its sign, of spheres along x that turn alike about z [m/s].
double slip_left(const std::vector<BodyState>& s) {
  return kRadius * (s[0].angular_velocity + s[1].angular_velocity).z() +
         (s[0].velocity - s[1].velocity).y();
}

TEST(PileCollision, RestitutionIsThatOfTheLinearContactToSecondOrder) {
  for (const double e : {1.0, 0.9, 0.5}) {
    const ContactScene scene = collision(e, {}, 0);
    double before = 0;
    for (const int steps : {50, 100, 200, 400}) {
      const auto s = after(scene, 1.5 * kTime, kTime / steps);
      const double error = std::abs((s[1].velocity.x() - s[0].velocity.x()) / 0.3 - e) + 1e-14;
      // (h ω)²/24 and the like, and the damping's: 8e-4 at t_col/50, a quarter with each half of
      // the step.
      EXPECT_LT(error, 2.0 / (steps * steps)) << e << " " << steps;
      // The last step of the contact is cut wherever its end falls, which scatters the quarter.
      if (before > 1e-9) {
        EXPECT_LT(error, 0.6 * before) << e << " " << steps;
      }
      before = error;
    }
  }
}

TEST(PileCollision, ASpringThatSticksGivesBackWhatItsHalfPeriodSays) {
  // κ m̄ ü = −k_t u from u(0): over t_col = π/ω_n it becomes cos(π √(k_t/(κ k_n))) of itself.
  constexpr double kappa = 2.0 / 7, kSlip = 1e-3;
  ContactScene scene = collision(1, {}, kSlip);
  for (const double ratio : {kappa / 4, kappa, 0.1, 1.0}) {
    SpringFriction spring;
    spring.stiffness = ratio * stiffness_of(scene);
    spring.static_friction = spring.kinetic_friction = 10;
    scene.soft[0]->memory->sliding = spring;
    const double expected = std::cos(M_PI * std::sqrt(ratio / kappa));
    const auto left = [&](int steps, EnergyBalance& balance) {
      return slip_left(after(scene, 1.5 * kTime, kTime / steps, &balance)) / kSlip;
    };
    EnergyBalance balance;
    const double limit = left(6400, balance);
    // The line of centres turns by some of u t_col/(2 R), of which the approach makes slip:
    // g t_col/(2 R) = 1.9e-3 of it, times a factor below 1.
    EXPECT_NEAR(limit, expected, 1e-3) << ratio;
    double before = 0;
    for (const int steps : {100, 200, 400}) {
      const double error = std::abs(left(steps, balance) - limit);
      // (h ω)²/24 · π and the like, of both oscillators.
      EXPECT_LT(error, 30.0 / (steps * steps)) << ratio << " " << steps;
      if (before > 1e-5) {
        EXPECT_LT(error, 0.5 * before) << ratio << " " << steps;
      }
      before = error;
      EXPECT_LT(std::abs(balance.error()), 1.0 / (steps * steps)) << ratio << " " << steps;
    }
  }
}

TEST(PileCollision, WhatSlidesThroughoutLosesMuOfTheNormalImpulse) {
  // Slip 2 m/s, μ = 0.1: ΔP_t = μ P_n, Δu = −μ (1 + e) g/κ.
  constexpr double kSlip = 2, kMu = 0.1, kClosing = 0.3, kappa = 2.0 / 7;
  SpringFriction spring;
  spring.stiffness = 1e9;  // at the cap within 1e-5 of the collision
  spring.static_friction = spring.kinetic_friction = kMu;
  ContactScene scene = collision(0.9, {}, kSlip);
  spring.stiffness = 0.3 * stiffness_of(scene);
  scene.soft[0]->memory->sliding = spring;
  for (const int steps : {200, 400}) {
    EnergyBalance balance;
    const auto s = after(scene, 1.5 * kTime, kTime / steps, &balance);
    // Until the cap is reached the spring's force is smaller, by the way μ F_N/k_t at the touch:
    // second order in the time (μ k_n g/(k_t u)) t_col that this takes.
    EXPECT_NEAR(slip_of(s), kSlip - kMu * 1.9 * kClosing / kappa, 5e-3 * kSlip);
    EXPECT_LT(std::abs(balance.error()), 3.0 / (steps * steps)) << steps;
  }
}

TEST(PileCollision, MindlinsPassiveContactMakesNoEnergyAndTheOtherDoes) {
  // Pressed, bent, pressed harder: the displacement form gains what the passive one loses.
  const double rho = 1.25 * test::free_pair(0, 0).bodies[0].mass / 2 *
                     std::pow(kTime / 2.9433 * std::pow(0.3, 0.2), -2.5);
  for (const auto form :
       {SpringFriction::Form::mindlin, SpringFriction::Form::mindlin_displacement}) {
    SpringFriction spring;
    spring.form = form;
    spring.stiffness = 1.2 * rho;
    spring.static_friction = spring.kinetic_friction = 10;
    ContactScene scene = collision(1, spring, 0.1);
    scene.soft[0]->normal = HertzForce{rho};
    EnergyBalance fine, coarse;
    after(scene, 0.6 * kTime, kTime / 800, &fine);
    after(scene, 0.6 * kTime, kTime / 400, &coarse);
    EXPECT_LT(std::abs(fine.error()), 2e-6);
    EXPECT_LT(std::abs(fine.error()), 0.4 * std::abs(coarse.error()) + 1e-9);
    after(scene, 1.5 * kTime, kTime / 400, &fine);
    if (form == SpringFriction::Form::mindlin) {
      EXPECT_GT(fine.dissipated, 0);
    }
  }
}

// --- impacts of hard contacts --------------------------------------------------------------------

/// u_t' of a hard impact, L (5)-(12): the impulse sticks up to Coulomb's cap.
double slip_after(const PairContact& contact, double closing, double slip) {
  constexpr double kappa = 2.0 / 7;
  const double sticks = (1 + contact.tangential_restitution) * slip;
  const double cap = friction_at(contact.friction, slip) *
                     (1 + restitution_at(contact.restitution, closing)) * closing / kappa;
  return slip - std::min(sticks, cap);
}

/// From slips that stick all through the impact to those that slide all through it.
constexpr double kSlips[] = {0.01, 0.1, 0.2, 0.4, 0.5, 0.6, 0.8, 1, 1.5, 4};

TEST(PileImpact, HardSpheresHaveTheSlipOfTheirRuleAtAllAngles) {
  for (const PairContact& contact :
       {PairContact{0.5, 0.1, 0.0}, PairContact{0.9, 0.3, -0.5}, PairContact{0.7, 0.2, 0.4},
        PairContact{1.0, 0.2, 1.0}, PairContact{0.8, ExponentialFriction{0.1, 0.4, 2}, 0.0}})
    for (const double slip : kSlips) {
      Scene scene = test::free_pair(0.15, -0.15);
      scene.has_substrate = false;
      scene.pairs[0] = contact;
      for (BodyState& state : scene.initial) state.angular_velocity.z() = 0.5 * slip / kRadius;
      const ContactScene hard = with_hard_contacts(scene);
      PileSolver solver(hard, scene.initial, {.step = kTime / 200, .collision_time = kTime});
      const SolvedRun run = solver.run(until_time(1.5 * kTime), nullptr);
      ASSERT_TRUE(run.reached) << run.reason;
      // As with springs, 2e-3 of the approach becomes slip as the line of centres turns; the rest
      // is the restitution's error in steps.
      EXPECT_NEAR(slip_left(solver.states()), slip_after(contact, 0.3, slip), 1e-3 * (slip + 0.3))
          << slip << " " << contact.tangential_restitution;
      EXPECT_LT(std::abs(run.balance->error()), 1e-3) << slip;
    }
}

TEST(PileImpact, SoHasASphereOnASurfaceAndOnTheSubstrate) {
  for (const bool on_substrate : {true, false})
    for (const double slip : kSlips) {
      // μ_s holds what rests, and no impact.
      SurfaceContact contact;
      contact.lasting.static_friction = 0.5;
      contact.lasting.kinetic_friction = 0.2;
      contact.lasting.restitution = 0.6;
      contact.impact = {0.6, 0.2, 0.0};
      Scene scene = test::steel_scene(1);
      scene.gravity = 0;
      scene.has_substrate = on_substrate;
      scene.substrate[0] = contact.lasting;
      if (!on_substrate) {
        scene.surfaces = {Surface()};
        scene.on_surfaces = {contact};
      }
      scene.initial[0].position.z() = (1 + 1e-6) * kRadius;
      scene.initial[0].velocity = {slip, 0, -0.3};
      scene.initial[0].angular_velocity.setZero();
      const ContactScene hard = with_hard_contacts(scene);
      PileSolver solver(hard, scene.initial, {.step = kTime / 200, .collision_time = kTime});
      const SolvedRun run = solver.run(until_time(1.5 * kTime), nullptr);
      ASSERT_TRUE(run.reached) << run.reason;
      const BodyState after = solver.states()[0];
      // The restitution's error in steps.
      EXPECT_NEAR(after.velocity.z(), 0.6 * 0.3, 5e-4 * 0.3);
      EXPECT_NEAR(after.velocity.x() - kRadius * after.angular_velocity.y(),
                  slip_after(contact.impact, 0.3, slip), 5e-4 * (slip + 0.3))
          << slip << on_substrate;
      EXPECT_LT(std::abs(run.balance->error()), 2e-3) << slip << on_substrate;
    }
}

TEST(PileImpact, RollingAndDrillingFrictionHaveTheirPartOfTheImpulse) {
  // J = m (1 + e) g. What sticking leaves of it is rolling friction, μ_r J on the centre of what
  // goes on to roll; all of it is drilling friction, l J.
  constexpr double kClosing = 0.3, kMu = 0.4, kRolling = 0.05, kLength = 1e-5, kFactor = 0.6;
  for (const double slip : {0.0, 0.1, 0.3})
    for (const bool goes_on : {true, false}) {
      Scene scene = test::steel_scene(1);
      scene.gravity = 0;
      SubstrateContact& contact = scene.substrate[0];
      contact.static_friction = contact.kinetic_friction = kMu;
      contact.rolling = RollingFriction(kRolling);
      contact.drilling_length = kLength;
      contact.restitution = kFactor;
      BodyState& ball = scene.initial[0];
      // Rolls at v after the slip is gone, where nothing but that is taken from it.
      const double v = goes_on ? 0.5 : 0.004, spin = goes_on ? 40 : 0.5;
      ball.position.z() = (1 + 1e-6) * kRadius;
      ball.velocity = {v + 2.0 / 7 * slip, 0, -kClosing};
      ball.angular_velocity = {0, (v - 5.0 / 7 * slip) / kRadius, spin};
      const ContactScene hard = with_hard_contacts(scene);
      const double impulse = (1 + kFactor) * kClosing;  // per mass, as all that follows
      const double left = impulse - 2.0 / 7 * slip / kMu;
      const double rolls = std::max(0.0, v - kRolling * left);
      const double turns = std::max(0.0, spin - kLength * impulse / (0.4 * kRadius * kRadius));
      for (const int steps : {200, 800}) {
        PileSolver solver(hard, scene.initial, {.step = kTime / steps, .collision_time = kTime});
        const SolvedRun run = solver.run(until_time(1.5 * kTime), nullptr);
        ASSERT_TRUE(run.reached) << run.reason;
        const BodyState after = solver.states()[0];
        // Rolling friction begins when half of the slip goes in a step: two steps early, with π/2
        // of their mean impulse.
        EXPECT_NEAR(after.velocity.x(), rolls, (M_PI / steps + 1e-3) * kRolling * impulse)
            << slip << goes_on << steps;
        EXPECT_NEAR(kRadius * after.angular_velocity.y(), rolls, 1e-3 * (slip + kClosing)) << slip;
        EXPECT_NEAR(after.angular_velocity.z(), turns, 1e-3 * spin) << slip << goes_on;
        EXPECT_LT(std::abs(run.balance->error()), 2e-3) << slip << goes_on << steps;
      }
    }
}

TEST(PileImpact, WhatLastsGoesOnWithItsForce) {
  // A sphere whose weight holds it down when the time of an impact is over, but for the fastest.
  // Its friction is as large then as before: a jump would be an error of first order in the books.
  for (const double speed : {1e-6, 1e-5, 1e-3}) {
    Scene scene = test::steel_scene(1);
    scene.gravity = kGravity;
    scene.substrate[0].static_friction = scene.substrate[0].kinetic_friction = 0.3;
    scene.substrate[0].restitution = 0.3;
    scene.initial[0].position.z() = kRadius;
    scene.initial[0].velocity = {2 * speed, 0, -speed};
    scene.initial[0].angular_velocity.setZero();
    const ContactScene hard = with_hard_contacts(scene);
    for (const int steps : {100, 200, 400}) {
      PileSolver solver(hard, scene.initial,
                        {.step = kTime / steps, .collision_time = kTime, .prepare = false});
      const SolvedRun run = solver.run(until_time(1.5 * kTime), nullptr);
      ASSERT_TRUE(run.reached) << run.reason;
      EXPECT_LT(std::abs(run.balance->error()), 3.0 / (steps * steps)) << speed << " " << steps;
    }
  }
}

// --- on the substrate ----------------------------------------------------------------------------

/// A steel ball on a slope whose tangent is given.
ContactScene on_slope(double tangent, double friction) {
  Scene scene = test::steel_scene(1);
  const double angle = std::atan(tangent);
  scene.gravity = kGravity * std::cos(angle);
  scene.downhill = {0, -kGravity * std::sin(angle)};
  scene.substrate[0].static_friction = scene.substrate[0].kinetic_friction = friction;
  return with_hard_contacts(std::move(scene));
}

double downhill_speed(const ContactScene& scene, double time) {
  PileSolver solver(scene, scene.hard.initial, {.collision_time = kTime});
  EXPECT_TRUE(solver.run(until_time(time), nullptr).reached);
  return -solver.states()[0].velocity.y();
}

TEST(PileSlope, ABallRollsOrSlipsByItsFriction) {
  // It rolls at 5/7 g sin up to tan = 7/2 μ, and slips beyond at g (sin − μ cos).
  constexpr double kSpan = 0.05, kMu = 0.2;
  const double critical = 3.5 * kMu;
  for (const double tangent : {0.5, 0.98 * critical, 1.02 * critical, 1.5}) {
    const ContactScene scene = on_slope(tangent, kMu);
    const double sine = tangent / std::hypot(1, tangent), cosine = 1 / std::hypot(1, tangent);
    const double expected =
        kSpan * kGravity * (tangent < critical ? 5.0 / 7 * sine : sine - kMu * cosine);
    // The start is from rest, without the few t_col that it takes to roll.
    EXPECT_NEAR(downhill_speed(scene, kSpan), expected, 5 * kTime * kGravity) << tangent;
  }
}

TEST(PileSlope, RollingFrictionHoldsUpToItsTangent) {
  // K (24): a/(1 + q) against μ_r g: a body that rolls down with 5/7 g sin is held by μ_r g cos.
  constexpr double kRolling = 0.05;
  for (const double part : {0.98, 1.02}) {
    ContactScene scene = on_slope(part * 1.4 * kRolling, 0.5);
    scene.hard.substrate[0].rolling = RollingFriction(kRolling);
    const double speed = downhill_speed(scene, 0.1);
    const double tangent = part * 1.4 * kRolling;
    const double free = 0.1 * kGravity * (5.0 / 7 * tangent - kRolling) / std::hypot(1, tangent);
    EXPECT_NEAR(speed, std::max(0.0, free), 5 * kTime * kGravity) << part;
    if (part < 1) {
      EXPECT_LT(speed, 1e-9);
    }
  }
}

TEST(PileSlope, RollingFrictionBreaksNothingLoose) {
  // (2/7) tan θ < μ_s < (2/7) tan θ + μ_r: what holds it is no more than without it, K (16).
  constexpr double kTangent = 0.5, kRolling = 0.05, kSpeed = 0.2, kUntil = 0.05;
  ContactScene scene = on_slope(kTangent, 0.16);
  scene.hard.substrate[0].rolling = RollingFriction(kRolling);
  BodyState& ball = scene.hard.initial[0];
  ball.velocity = {0, -kSpeed, 0};
  ball.angular_velocity = rolling_angular_velocity(ball.velocity, kRadius);
  const double cosine = 1 / std::hypot(1, kTangent);
  const double gain = (5.0 / 7 * kTangent - kRolling) * cosine * kGravity * kUntil;
  // It begins without the stretch and the overlap that hold it, for some of its collision times.
  EXPECT_NEAR(downhill_speed(scene, kUntil), kSpeed + gain, 2e-3 * gain);
}

TEST(PileRolling, ABallRollsToRestAndASpinDies) {
  ContactScene scene = on_slope(0, 0.5);
  SubstrateContact& ground = scene.hard.substrate[0];
  ground.rolling = RollingFriction(0.02);
  ground.drilling_length = 1e-4;
  constexpr double kSpeed = 0.1;
  scene.hard.initial[0] = test::rolling_at(0, 0, kSpeed, 0);
  PileSolver solver(scene, scene.hard.initial, {.collision_time = kTime});
  SolvedRun run = solver.run({Run::Until::rest, 0, 10}, nullptr);
  ASSERT_TRUE(run.reached) << run.reason;
  // v²/(2 μ_r g); its springs give way at the end by the weight over their stiffness.
  EXPECT_NEAR(solver.states()[0].position.x(), kSpeed * kSpeed / (2 * 0.02 * kGravity), 2e-6);
  EXPECT_LT(std::abs(run.balance->error()), 1e-6);

  constexpr double kSpin = 20, kPart = 0.005;
  scene.hard.initial[0] = test::rolling_at(0, 0, 0, 0);
  scene.hard.initial[0].angular_velocity.z() = kSpin;
  PileSolver spinning(scene, scene.hard.initial, {.collision_time = kTime});
  run = spinning.run(until_time(kPart), nullptr);
  // I dΩ/dt = −L m g, from a start that lies on the ground within some t_col.
  const double rate = 1e-4 * kGravity / (0.4 * kRadius * kRadius);
  EXPECT_NEAR(spinning.states()[0].angular_velocity.z(), kSpin - rate * kPart, 10 * rate * kTime);
}

// --- on surfaces ---------------------------------------------------------------------------------

/// A ball held between two plates that move past it at ±V: overlaps them by `squeeze` [m].
ContactScene between_belts(double speed, double squeeze, double friction) {
  Scene scene = test::steel_scene(1);
  scene.gravity = 0;
  scene.has_substrate = false;
  scene.initial[0].position.setZero();
  SurfaceContact contact;
  contact.lasting.static_friction = contact.lasting.kinetic_friction = friction;
  contact.impact = {0.5, friction, 0.0};
  for (const double side : {-1.0, 1.0}) {
    Surface plate;
    plate.shape = PlaneShape{side * (kRadius - squeeze) * kUp, -side * kUp};
    plate.motion = SurfaceMotion::belt(SubstrateMotion::constant({side * speed, 0}),
                                       Vector3::UnitX(), Vector3::UnitY());
    scene.surfaces.push_back(plate);
    scene.on_surfaces.push_back(contact);
  }
  return with_hard_contacts(std::move(scene));
}

TEST(PileSurfaces, ABallBetweenBeltsIsSpunUpByBoth) {
  // I dΩ/dt = 2 μ N R about y until R Ω = V; N = k ξ of the plates' hard contact.
  constexpr double kSpeed = 0.5, kMu = 0.3, kSqueeze = 1e-8;
  const ContactScene scene = between_belts(kSpeed, kSqueeze, kMu);
  const PileLaws laws(scene, kTime);
  const double force =
      laws.of(0, surface_touch(0)).normal.index() == 0
          ? std::get<LinearForce>(laws.of(0, surface_touch(0)).normal).stiffness * kSqueeze
          : 0;
  const double rate = 2 * kMu * force * kRadius / scene.hard.bodies[0].moment_of_inertia();
  const double until = kSpeed / kRadius / rate;
  // So many collisions that what the springs need to give way does not count.
  ASSERT_GT(until, 20 * kTime);
  PileSolver solver(scene, scene.hard.initial, {.collision_time = kTime});
  ASSERT_TRUE(solver.run(until_time(0.5 * until), nullptr).reached);
  EXPECT_NEAR(solver.states()[0].angular_velocity.y(), 0.5 * kSpeed / kRadius, 2 * rate * kTime);
  const SolvedRun run = solver.run(until_time(3 * until), nullptr);
  const BodyState end = solver.states()[0];
  EXPECT_NEAR(end.angular_velocity.y(), kSpeed / kRadius, 1e-6 * kSpeed / kRadius);
  EXPECT_NEAR(end.position.norm(), 0, 1e-12);
  EXPECT_LT(std::abs(run.balance->error()), 1e-4);
  EXPECT_GT(run.balance->work, 0);
}

TEST(PileSurfaces, ABallOnATurningPlateGoesRoundAsTheTurntableSays) {
  // A solid sphere that rolls on a plate turning at Ω goes in a circle of its own at 2/7 Ω.
  constexpr double kRate = 5;
  Scene scene = test::steel_scene(1);
  scene.has_substrate = false;
  SurfaceContact contact;
  contact.lasting.static_friction = contact.lasting.kinetic_friction = 1;
  contact.impact = {0.5, 1.0, 0.0};
  Surface plate;
  plate.motion = SurfaceMotion::turning(Vector3::Zero(), kRate * kUp);
  scene.surfaces = {plate};
  scene.on_surfaces = {contact};
  constexpr double kPlace = 0.05, kSpeed = 2.0 / 7 * kRate * kPlace;
  // About the axis itself: v = 2/7 Ω r, and what rolls turns with Ω × r − v below.
  BodyState& ball = scene.initial[0];
  ball.position = {kPlace, 0, kRadius};
  ball.velocity = {0, kSpeed, 0};
  ball.angular_velocity = rolling_angular_velocity({0, kSpeed - kRate * kPlace, 0}, kRadius);
  ball.angular_velocity.z() = 0;
  const ContactScene hard = with_hard_contacts(scene);
  PileSolver solver(hard, scene.initial, {.collision_time = kTime});
  const double quarter = 0.5 * M_PI / (2.0 / 7 * kRate);
  ASSERT_TRUE(solver.run(until_time(quarter), nullptr).reached);
  // It begins without the stretch that turns it: some μm.
  EXPECT_LT((solver.states()[0].position.head<2>() - Vector2(0, kPlace)).norm(), 1e-3 * kPlace);
}

}  // namespace
}  // namespace slipcheck
