#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reference/forces/contact_solver.h"
#include "soft_scenes.h"

// Random scenes with every law, end rule, substrate and motion: the ledger of energy must close,
// nothing may be lost or made, and every run must come to its end.

namespace slipcheck {
namespace {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  double log(double low, double high) { return low * std::pow(high / low, (*this)(0, 1)); }
  bool chance(double p) { return (*this)(0, 1) < p; }
  int pick(int count) { return static_cast<int>((*this)(0, count)); }

 private:
  std::mt19937_64 random_;
};

NormalForce random_normal(Dice& dice, double mass, double radius) {
  const double m = mass / 2;
  const double rho = dice.log(1e6, 1e9) * std::sqrt(radius);
  switch (dice.pick(5)) {
    case 0: {
      const double omega = dice.log(2e4, 2e5);
      return LinearForce{m * omega * omega, dice(0, 1) * m * omega};
    }
    case 1:
      return HertzForce{rho};
    case 2:
      return PowerForce{rho, dice.log(1e-6, 1e-5) * rho, 1.5, dice(0.5, 1)};
    case 3:
      return ViscoelasticForce{rho, dice.log(1e-7, 1e-5)};
    default:
      return CompactViscoelasticForce{rho, dice.log(1e-7, 1e-5)};
  }
}

TangentialForce random_tangential(Dice& dice, double mass, double radius) {
  switch (dice.pick(4)) {
    case 0:
      return NoTangentialForce{};
    case 1:
      return ViscousForce{dice.log(1e3, 1e5) * mass, dice(0, 0.8)};
    case 2:
      return AsperityForce{dice(0, 0.5), dice.log(1e-3, 1e-1) * radius,
                           AsperityForce::Form::printed};
    default:
      return AsperityForce{dice(0, 0.5), dice.log(1e-3, 1e-1) * radius,
                           AsperityForce::Form::passive};
  }
}

SubstrateContact random_substrate(Dice& dice, double radius) {
  SubstrateContact contact;
  contact.kinetic_friction = dice.chance(0.2) ? 0 : dice(0.05, 0.6);
  contact.static_friction = contact.kinetic_friction * (dice.chance(0.5) ? 1 : 1.5);
  if (dice.chance(0.5)) {
    const double most = contact.static_friction;
    contact.rolling =
        dice.chance(0.5)
            ? RollingFriction(0.3 * most * dice(0, 1))
            : RollingFriction({{0.0, 0.3 * most}, {0.1, 0.1 * most}, {0.3, 0.2 * most}});
    contact.rolling_while_sliding = dice.chance(0.3);
  }
  const double disc = dice.log(1e-2, 0.3) * radius;
  if (dice.chance(0.3)) contact.drilling_length = 2.0 / 3 * contact.kinetic_friction * disc;
  if (dice.chance(0.2)) {
    contact.coupled_radius = disc;
    contact.hertzian_pressure = dice.chance(0.5);
  }
  contact.restitution = dice.chance(0.5) ? 0 : dice(0, 0.9);
  return contact;
}

ContactScene random_scene(std::uint64_t seed) {
  Dice dice(seed);
  Scene hard;
  const int count = 1 + dice.pick(4);
  const double radius = dice.log(1e-3, 1e-1);
  hard.gravity = dice.chance(0.1) ? 0 : 9.81;
  if (dice.chance(0.3)) hard.downhill = {dice(-2, 2), dice(-2, 2)};
  if (dice.chance(0.4)) {
    const Vector2 way(dice(-2, 2) * radius, dice(-2, 2) * radius);
    if (dice.chance(0.4))
      hard.motion = SubstrateMotion::oscillation(way, dice.log(1, 30), dice(0, 6));
    else if (dice.chance(0.5))
      hard.motion = SubstrateMotion::table({{0.05, {0, 0}}, {0.1, way}, {0.2, -way}});
    else
      hard.motion = SubstrateMotion::constant(way / 0.1);
  }
  hard.confined = dice.chance(0.3);
  hard.substrate = {random_substrate(dice, radius)};
  const double mass = 2000 * 4 * M_PI / 3 * std::pow(radius, 3);
  for (int i = 0; i < count; ++i) {
    const double size = radius * dice(0.8, 1.2);
    hard.bodies.push_back({size, mass * dice(0.5, 2), dice.chance(0.7) ? 0.4 : 2.0 / 3});
    hard.material.push_back(0);
    BodyState state;
    const double angle = 2 * M_PI * i / count + dice(0, 0.5);
    const double away = count == 1 ? 0 : 3 * radius;
    const Vector3 out(std::cos(angle), std::sin(angle), 0);
    state.position = away * out + size * kUp;
    // Towards the middle, not quite.
    state.velocity = -dice(5, 40) * radius * out + Vector3(dice(-3, 3), dice(-3, 3), 0) * radius;
    if (dice.chance(0.6)) state.angular_velocity = rolling_angular_velocity(state.velocity, size);
    if (dice.chance(0.5)) state.angular_velocity += Vector3(dice(-30, 30), 0, dice(-50, 50));
    if (dice.chance(0.2) && !hard.confined) state.position.z() += dice(0, 1) * size;
    hard.initial.push_back(state);
  }
  hard.pairs = {{dice(0.3, 1), dice.chance(0.5) ? 0 : dice(0, 0.5), dice(-1, 1)}};
  ContactScene scene = with_hard_contacts(hard);
  // Hard balls that are driven against each other rattle without end; they have tests of their own.
  if (count > 1 || dice.chance(0.5))
    scene.soft[0] =
        SoftContact{random_normal(dice, mass, radius),
                    dice.chance(0.5) ? ContactEnd::zero_overlap : ContactEnd::zero_force,
                    random_tangential(dice, mass, radius)};
  return scene;
}

TEST(RandomContacts, TheLedgerOfEnergyCloses) {
#ifdef SLIPCHECK_SANITIZE
  constexpr std::uint64_t kScenes = 40;
#else
  constexpr std::uint64_t kScenes = 250;
#endif
  for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
    SCOPED_TRACE(seed);
    const ContactScene scene = random_scene(seed);
    ContactSolver solver(scene, scene.hard.initial);
    const SolvedRun run = solver.run(until_time(0.4), nullptr);
    EXPECT_TRUE(run.reached) << run.reason;
    for (const BodyState& state : solver.states()) {
      ASSERT_TRUE(state.velocity.allFinite());
      ASSERT_TRUE(state.angular_velocity.allFinite());
    }
    // Some hundred events, each with some units of the integrator's tolerance of 1e-13.
    EXPECT_LT(std::abs(run.balance->error()), 5e-10);
    // Only the printed asperity can make energy.
    const auto* asperity =
        scene.soft[0] ? std::get_if<AsperityForce>(&scene.soft[0]->tangential) : nullptr;
    if (!asperity || asperity->form == AsperityForce::Form::passive) {
      EXPECT_GE(run.balance->dissipated, -1e-9 * run.balance->scale);
    }
  }
}

}  // namespace
}  // namespace slipcheck
