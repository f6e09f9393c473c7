#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "../support/runge_kutta.h"
#include "free_collision.h"
#include "reference/events/event_solver.h"
#include "reference/forces/contact_solver.h"
#include "reference/steps/step_pair.h"
#include "reference/steps/step_solver.h"
#include "step_scenes.h"

namespace slipcheck {
namespace {

using namespace test;

/// A bound pair of spinning spheres with all components in play, against Runge-Kutta steps.
struct Turning {
  double stiffness = 1e5, damping = 0.05, rubbing = 0.03;
  Scene scene = free_pair(0, 0);

  Turning() {
    // The pair swings about its centre while it is pressed together by nothing but inertia's lack:
    // short enough to stay in contact.
    scene.initial[0].position.x() += 1e-5;
    scene.initial[0].velocity = {0.1, 0.3, -0.2};
    scene.initial[1].velocity = {-0.1, -0.1, 0.1};
    scene.initial[0].angular_velocity = {40, -80, 60};
    scene.initial[1].angular_velocity = {-10, 20, 90};
    scene.bodies[1].mass *= 2;
    scene.bodies[1].shape_factor = 0.6;
  }
};

TEST(StepSolver, SecondOrderWithViscousForceAndSpins) {
  const Turning pair;
  const ContactScene all =
      with_contact(pair.scene, {LinearForce{pair.stiffness, pair.damping}, ContactEnd::zero_overlap,
                                ViscousForce{pair.rubbing, 100}});
  const double t = 5e-5;
  // Runge-Kutta on the equations written out anew.
  using State = Eigen::Matrix<double, 3, 6>;  // positions, velocities, spins of both
  const auto& bodies = pair.scene.bodies;
  const auto rates = [&](double, const State& s) {
    const Vector3 d = s.col(0) - s.col(1), n = d.normalized();
    const Vector3 dv = s.col(2) - s.col(3);
    const Vector3 u = dv - 0.002 * Vector3(s.col(4) + s.col(5)).cross(n);
    const Vector3 tangential = -pair.rubbing * (u - n.dot(u) * n);
    const double normal = pair.stiffness * (0.004 - d.norm()) - pair.damping * n.dot(dv);
    const Vector3 force = normal * n + tangential, torque = -0.002 * n.cross(tangential);
    State r;
    r << s.col(2), s.col(3), force / bodies[0].mass, -force / bodies[1].mass,
        torque / bodies[0].moment_of_inertia(), torque / bodies[1].moment_of_inertia();
    return r;
  };
  const BodyState &a = pair.scene.initial[0], &b = pair.scene.initial[1];
  State exact;
  exact << a.position, b.position, a.velocity, b.velocity, a.angular_velocity, b.angular_velocity;
  exact = integrate(rates, exact, 0, t, 2000);
  ASSERT_LT((exact.col(0) - exact.col(1)).norm(), 0.004);  // still in contact
  const auto error = [&](int steps) {
    StepSolver solver(all, pair.scene.initial, {t / steps});
    solver.run(until_time(t), nullptr);
    const std::vector<BodyState> s = solver.states();
    double e = 0;
    for (std::size_t i = 0; i < 2; ++i)
      e += (s[i].velocity - exact.col(2 + i)).norm() +
           0.002 * (s[i].angular_velocity - exact.col(4 + i)).norm();
    return e;
  };
  EXPECT_NEAR(order(error, 100), 2, 0.05);
  EXPECT_LT(error(200), 1e-4);
}

TEST(StepSolver, FreePairKeepsMomentumAndAngularMomentum) {
  const Turning pair;
  for (const TangentialForce& law :
       {TangentialForce(ViscousForce{0.03, 0.2}),
        TangentialForce(AsperityForce{0.3, 1e-6, AsperityForce::Form::printed}),
        TangentialForce(AsperityForce{0.3, 1e-6, AsperityForce::Form::passive})}) {
    const ContactScene all =
        with_contact(pair.scene, {LinearForce{pair.stiffness, 0}, ContactEnd::zero_overlap, law});
    const auto momenta = [&](const std::vector<BodyState>& s) {
      Vector3 p = Vector3::Zero(), l = Vector3::Zero();
      for (std::size_t i = 0; i < 2; ++i) {
        p += pair.scene.bodies[i].mass * s[i].velocity;
        l += pair.scene.bodies[i].mass * s[i].position.cross(s[i].velocity) +
             pair.scene.bodies[i].moment_of_inertia() * s[i].angular_velocity;
      }
      return std::pair(p, l);
    };
    StepSolver solver(all, pair.scene.initial, {1e-7});
    const auto before = momenta(solver.states());
    EXPECT_EQ(solver.run(until_time(2e-4), nullptr).collisions, 1u);
    const auto after = momenta(solver.states());
    EXPECT_LT((after.first - before.first).norm(), 1e-13 * before.first.norm());
    // The lever arms are R, the surfaces being ξ/2 ~ 1e-5 of them inside: what the contact point's
    // place leaves open (K, B).
    EXPECT_LT((after.second - before.second).norm(), 1e-3 * before.second.norm());
  }
}

TEST(StepSolver, BendTurnsWithTheLineOfCentres) {
  // ζ̇ = −n (ζ·ṅ) keeps |ζ| and turns ζ with n: exactly for a turn about one axis.
  const double angle = 0.1;
  Bend bend;
  bend.begin(0.5, 1, {0, 2, 3}, Vector3::UnitX());
  bend.advance(0, 1, Vector3::Zero(), Vector3::UnitX());
  const Vector3 start = bend.bend;
  ASSERT_GT(start.y(), 0);
  for (int k = 1; k <= 10; ++k)
    bend.advance(0, 1, Vector3::Zero(), {std::cos(k * angle), std::sin(k * angle), 0});
  const Vector3 expected(-start.y() * std::sin(1), start.y() * std::cos(1), start.z());
  EXPECT_LT((bend.bend - expected).norm(), 1e-14);
}

TEST(StepSolver, FreeCollisionsMeetThePairMap) {
  const double g_n = 1e-3, g_t = 2e-4;
  Scene scene = free_pair(0.5 * g_n, -0.5 * g_n);
  scene.initial[0].velocity.y() = 0.5 * g_t;
  scene.initial[1].velocity.y() = -0.5 * g_t;
  const double mass = 0.5 * scene.bodies[0].mass, omega = M_PI / kCollisionTime;
  const LinearForce normal{mass * omega * omega, 0.05 * mass * omega};
  // g_T t_col = 5e-9 m: the asperities break not at all, or some times.
  const auto rough = [](double friction, double size, AsperityForce::Form form) {
    return TangentialForce(AsperityForce{friction, size, form});
  };
  struct Case {
    const char* name;
    TangentialForce law;
    double tolerance;  ///< at 800 steps
  };
  // What is left is the turn of n by g_T t_col/2R ~ 1e-6 times g_N/g_T, and of first order in the
  // step where the cap starts and ends or an asperity breaks.
  const Case cases[] = {
      {"viscous", ViscousForce{0.1 * mass * omega, 1e6}, 3e-5},
      {"capped", ViscousForce{1e3 * mass * omega, 0.02}, 3e-4},
      {"printed", rough(0.01, 1e-8, AsperityForce::Form::printed), 3e-5},
      {"passive", rough(0.01, 1e-8, AsperityForce::Form::passive), 3e-4},
      {"printed, breaking", rough(0.01, 1.2e-9, AsperityForce::Form::printed), 3e-3},
      {"passive, breaking", rough(0.01, 1.2e-9, AsperityForce::Form::passive), 3e-3},
  };
  for (const Case& c : cases) {
    const SoftContact contact{normal, ContactEnd::zero_overlap, c.law};
    const PairCollision exact =
        test::collide_freely(contact, scene.bodies[0], scene.bodies[1], g_n, g_t);
    const ContactScene all = with_contact(scene, contact);
    const auto error = [&](int steps) {
      StepSolver solver(all, scene.initial, {kCollisionTime / steps});
      solver.run(until_time(1.3 * kCollisionTime), nullptr);
      const std::vector<BodyState> s = solver.states();
      const Vector3 n = (s[0].position - s[1].position).normalized();
      const Vector3 u = s[0].velocity - s[1].velocity -
                        0.002 * (s[0].angular_velocity + s[1].angular_velocity).cross(n);
      return std::abs(u.y() / g_t - exact.tangential_restitution);
    };
    EXPECT_LT(exact.tangential_restitution, 0.95) << c.name;
    EXPECT_LT(error(800), c.tolerance) << c.name;
  }
}

TEST(StepSolver, SymmetricCollisionTendsToTheEventSolver) {
  double before = std::numeric_limits<double>::infinity();
  for (const double collision_time : {1.02e-4, 5.1e-5, 2.55e-5}) {
    const ContactScene all = colliding(0.1, -0.1, 0.9, collision_time);
    EventSolver hard(all.hard, all.hard.initial);
    hard.run(kRolling, nullptr);
    StepSolver soft(all, all.hard.initial, {collision_time / 50});
    const SolvedRun run = soft.run(kRolling, nullptr);
    ASSERT_TRUE(run.reached) << run.reason;
    EXPECT_EQ(run.collisions, 1u);
    const double sliding = 0.1 * 1.9 / (3.5 * 0.1 * 9.81);
    const double difference = (soft.states()[0].velocity - hard.states()[0].velocity).norm() / 0.1;
    // O(t_col/t^s), of order 1 in that ratio, and with it.
    EXPECT_LT(difference, 3 * collision_time / sliding);
    EXPECT_LT(difference, 0.7 * before);
    before = difference;
  }
}

TEST(StepSolver, K55RubbingOfConfinedSpheres) {
  // ΔΩ = −½ (1 − e^(−2C)) (Ω_i + Ω_j) without a cap. On centres that are held the vertical slip
  // R(Ω_i + Ω_j) decays with 2 (R²/I) c = 2 A c/m, so 2C = 2 A c t_col/m. The substrate's friction,
  // which would turn the spheres as well, is left out.
  const double collision_time = 1e-6;
  ContactScene all = colliding(0.2, -0.05, 0.9, collision_time, NoTangentialForce{}, 0.002);
  all.hard.confined = true;
  all.hard.substrate[0].static_friction = all.hard.substrate[0].kinetic_friction = 0;
  const double c = 0.1 * std::get<LinearForce>(all.soft[0]->normal).damping;
  all.soft[0]->tangential = ViscousForce{c, 1e9};
  StepSolver solver(all, all.hard.initial, {collision_time / 500});
  solver.run(until_time(2 * collision_time), nullptr);
  const std::vector<BodyState> s = solver.states();
  const double share = -0.5 * std::expm1(-2 * 2.5 * c * collision_time / all.hard.bodies[0].mass);
  const double sum = (0.2 - 0.05) / 0.002;
  // Second order in 1/500.
  EXPECT_NEAR((0.2 / 0.002 - s[0].angular_velocity.y()) / sum / share, 1, 1e-4);
  EXPECT_NEAR((-0.05 / 0.002 - s[1].angular_velocity.y()) / sum / share, 1, 1e-4);
}

TEST(StepSolver, K9RubbingLiftsOneSphere) {
  // App. F: the struck, slower sphere is pressed down, the faster one lifted; it flies and lands.
  const ContactScene all = colliding(0.5, 0, 0.9, kCollisionTime, ViscousForce{1.5, 0.5}, 0.002);
  StepSolver solver(all, all.hard.initial, {kCollisionTime / 50});
  solver.run(until_time(2 * kCollisionTime), nullptr);
  const std::vector<BodyState> s = solver.states();
  EXPECT_GT(s[0].velocity.z(), 1e-3);
  EXPECT_EQ(s[1].velocity.z(), 0);
  const SolvedRun run = solver.run(kRolling, nullptr);
  ASSERT_TRUE(run.reached) << run.reason;
  for (const BodyState& body : solver.states()) EXPECT_EQ(body.position.z(), 0.002);
}

/// Two balls that collide obliquely, with anything that the contact model has.
ContactScene random_collision(unsigned seed) {
  std::mt19937_64 random(seed);
  const auto within = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  Scene hard = test::head_on(0.1, -0.1, 0.8);
  SubstrateContact& c = hard.substrate[0];
  c.static_friction = 0.3;
  c.kinetic_friction = within(0.05, 0.3);
  if (seed % 2) c.rolling = RollingFriction(0.01);
  c.rolling_while_sliding = seed % 4 == 1;
  if (seed % 3 == 0) c.drilling_length = within(0, 1e-5);
  if (seed % 14 == 0) {
    c.coupled_radius = 1e-4;
    c.drilling_length = 2.0 / 3 * 1e-4 * c.kinetic_friction;
  }
  if (seed % 5 == 0) hard.downhill = {within(-1, 1), within(-1, 1)};
  if (seed % 4 == 0) {
    const double phase = within(0, 6);
    hard.motion = SubstrateMotion::oscillation({within(0, 0.01), within(0, 0.01)}, 5, phase);
  }
  hard.confined = seed % 6 == 1;
  const auto speeds = [&] {  // arguments would be drawn in any order
    const double across = within(-0.05, 0.05), along = within(0.05, 0.3);
    return Vector2(along, across);
  };
  const Vector2 first = speeds(), second = speeds();
  hard.initial[0] = test::rolling_at(-0.00195, 0, first.x(), first.y());
  hard.initial[1] = test::rolling_at(0.00195, 0.001, -second.x(), second.y());
  if (seed % 2 == 0)
    for (BodyState& body : hard.initial)
      body.angular_velocity = {within(-50, 50), within(-50, 50), within(-100, 100)};
  SoftContact contact = linear_contact(
      0.5 * hard.bodies[0].mass, 0.8, within(1e-5, 2e-4),
      seed % 4 == 3 || seed % 3 == 0 ? ContactEnd::zero_force : ContactEnd::zero_overlap);
  if (seed % 4 == 1)
    contact.tangential = ViscousForce{0.5 * std::get<LinearForce>(contact.normal).damping, 0.3};
  if (seed % 4 > 1)
    contact.tangential = AsperityForce{
        0.1, 1e-7, seed % 4 == 2 ? AsperityForce::Form::printed : AsperityForce::Form::passive};
  return with_contact(hard, contact);
}

TEST(StepSolver, TendsToTheContactSolver) {
  // Two solvers that share the laws of force alone.
  for (unsigned seed = 1; seed <= 24; ++seed) {
    const ContactScene scene = random_collision(seed);
    const bool breaks = std::holds_alternative<AsperityForce>(scene.soft[0]->tangential);
    const auto& law = std::get<LinearForce>(scene.soft[0]->normal);
    const double collision_time =
        M_PI / std::sqrt(law.stiffness / (0.5 * scene.hard.bodies[0].mass));
    const double end = 1e-3 + 20 * collision_time;
    ContactSolver exact(scene, scene.hard.initial);
    ASSERT_TRUE(exact.run(until_time(end), nullptr).reached) << seed;
    const auto error = [&](int steps) {
      const double h = end / std::ceil(end / collision_time * steps);
      StepSolver solver(scene, scene.hard.initial, {h});
      EXPECT_EQ(solver.run(until_time(end), nullptr).collisions, 1u) << seed;
      double e = 0;
      for (std::size_t i = 0; i < 2; ++i) {
        const BodyState now = solver.states()[i], then = exact.states()[i];
        e += (now.velocity - then.velocity).norm() +
             0.002 * (now.angular_velocity - then.angular_velocity).norm();
      }
      return e;
    };
    // Velocities of order 0.2 m/s. Second order, but that an asperity which breaks a step late
    // leaves an error of first order, and stick and slip are found to a step.
    EXPECT_LT(error(100), breaks ? 5e-2 : 2e-4) << seed;
    EXPECT_LT(error(800), breaks ? 1e-2 : 1e-5) << seed;
    if (breaks) {
      EXPECT_LT(error(3200), 5e-3) << seed;
    }
  }
}

}  // namespace
}  // namespace slipcheck
