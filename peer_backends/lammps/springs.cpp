#include "peer_backends/lammps/springs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "engine/engine.h"
#include "peer_backends/shared/contact_values.h"
#include "physics/contact/linear_contact.h"
#include "physics/contact/sticking_spring.h"

namespace slipcheck::lammps {
namespace {

constexpr double kPi = std::numbers::pi;

/// What a hard contact is made of, between spheres of the reduced mass and κ of the slip.
struct HardContact {
  double restitution, tangential_restitution, mass, kappa;
};

/// The spring on which an elastic collision takes the settings' collision time, π/ω0. It never
/// attracts, as a hard contact does not: friction would count that as well, Coulomb's cap being of
/// |F_N|, and the impulse of a landing with e = 0.01 be a third too large.
Spring spring_with(const HardContact& hard, bool holds, const LammpsSettings& settings) {
  if (settings.collision_time == 0)
    throw Refused(
        "lammps: the scene has hard contacts, LAMMPS has forces that last alone, and the setting "
        "collision_time allows no spring in their place");
  const bool as_typed = settings.coefficients == Coefficients::fields;
  const double frequency = kPi / settings.collision_time;
  const LinearContact law = LinearContact::with_stiffness(
      hard.mass, std::max(hard.restitution, settings.lowest_restitution),
      hard.mass * frequency * frequency,
      as_typed ? ContactEnd::zero_overlap : ContactEnd::zero_force);
  Spring spring;
  spring.mass = hard.mass;
  spring.stiffness = law.stiffness();
  spring.damping = law.damping_rate() * hard.mass;
  spring.never_attracts = !as_typed;
  if (as_typed) spring.tsuji_restitution = hard.restitution;
  spring.tangential = settings.sticking / settings.collision_time * hard.mass;
  if (!holds || hard.tangential_restitution == -1) return spring;
  // The slip passes through zero for the third time where it is to end there: the stiffer the
  // spring, the less does LAMMPS's friction fall short of Coulomb's cap where that rises faster
  // than the spring's force.
  const double beta = hard.tangential_restitution;
  const double swings = beta == 0 ? 1 + 2 * kPi / std::atan(2.0) : 1;
  const StickingSpring sticks = sticking_spring(beta, settings.collision_time / swings);
  const double slides = hard.kappa * hard.mass;
  spring.shear = sticks.frequency * sticks.frequency * slides;
  spring.tangential = 2 * sticks.damping * sticks.frequency * slides;
  return spring;
}

struct NormalOf {
  Spring& spring;
  void operator()(const LinearForce& force) const {
    spring.stiffness = force.stiffness;
    spring.damping = force.damping;
  }
  void operator()(const HertzForce& force) const {
    spring.hertz = true;
    spring.stiffness = force.modulus;
  }
  void operator()(const ViscoelasticForce& force) const {
    spring.hertz = true;
    spring.stiffness = force.modulus;
    spring.damping = 1.5 * force.modulus * force.dissipation_time;
  }
  void operator()(const PowerForce&) const {
    throw Refused("lammps: it has no normal force with a power of the overlap to choose");
  }
  void operator()(const CompactViscoelasticForce&) const {
    throw Refused("lammps: it has no viscoelastic force in the compact form");
  }
};

struct TangentialOf {
  Spring& spring;
  void operator()(const NoTangentialForce&) const {}
  void operator()(const ViscousForce& force) const {
    spring.tangential = force.damping;
    spring.friction = force.friction;
  }
  void operator()(const AsperityForce&) const {
    throw Refused("lammps: it has no asperities that break");
  }
  void operator()(const ImpactAngleForce&) const {
    throw Refused("lammps: it has no tangential force along the slip of the first touch");
  }
};

void remember(const ContactMemory& memory, Spring& spring) {
  const SpringFriction& sliding = memory.sliding;
  spring.friction = sliding.kinetic_friction;
  spring.shear = sliding.stiffness;
  spring.shear_form = sliding.form;
  spring.tangential = sliding.damping;
  if (spring.hertz && spring.damping > 0)
    spring.tangential_ratio = sliding.damping_ratio;
  else
    spring.tangential += sliding.damping_ratio * spring.damping;
  spring.rolling = memory.rolling;
  spring.drilling = memory.drilling;
}

Spring soft_spring(const SoftContact& contact, double mass, double effective_radius) {
  if (contact.after_impact)
    throw Refused("lammps: the scene's forces only hold what an impact leaves together");
  Spring spring;
  spring.mass = mass;
  spring.effective_radius = effective_radius;
  spring.never_attracts = contact.end == ContactEnd::zero_force;
  std::visit(NormalOf{spring}, contact.normal);
  if (contact.memory)
    remember(*contact.memory, spring);
  else
    std::visit(TangentialOf{spring}, contact.tangential);
  if (spring.hertz && spring.damping > 0 && spring.friction > 0 && spring.tangential > 0)
    throw Refused(
        "lammps: its tangential damping goes with its normal one, by the root of the overlap, "
        "where the scene's does not");
  return spring;
}

/// m_eff κ of a sphere on a body that cannot move is m/(1 + 1/q).
double kappa_of(const Sphere& sphere) { return 1 / (1 + sphere.inverse_shape_factor()); }

/// On something rigid. Rolling and drilling are springs that hold up to their caps and are
/// critically damped.
Spring spring_on(const HardContact& hard, double friction, const SubstrateContact& ground,
                 const Sphere& sphere, const EngineScene& scene, const LammpsSettings& settings) {
  Spring spring = spring_with(hard, holds_by_springs(scene, settings), settings);
  spring.effective_radius = sphere.radius;
  spring.friction = friction;
  const double q = sphere.shape_factor, R = sphere.radius;
  const double stiffness = spring.stiffness * R * R;
  if (!ground.rolling.is_zero()) {
    // The torque is R μ F_N; a sphere that rolls is slowed by R μ F_N/((1 + q) m R).
    const double factor = settings.coefficients == Coefficients::fields ? 1 : 1 + q;
    spring.rolling = {stiffness, 2 * R * R * std::sqrt(spring.stiffness * (1 + q) * sphere.mass),
                      factor * ground.rolling.points().front().coefficient * R};
  }
  if (ground.drilling_length > 0)
    spring.drilling = {stiffness, 2 * std::sqrt(stiffness * sphere.moment_of_inertia()),
                       ground.drilling_length};
  return spring;
}

}  // namespace

AtomTypes atom_types(const Scene& scene) {
  AtomTypes types;
  std::map<std::tuple<std::size_t, double, double>, std::size_t> known;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Sphere& body = scene.bodies[i];
    const auto [found, is_new] =
        known.try_emplace({scene.material[i], body.radius, body.mass}, known.size());
    if (is_new) types.first_body.push_back(i);
    types.of_body.push_back(found->second);
  }
  return types;
}

Spring pair_spring(const EngineScene& scene, std::size_t i, std::size_t j,
                   const LammpsSettings& settings) {
  const Sphere &first = scene.bodies[i], &second = scene.bodies[j];
  const double mass = first.mass * second.mass / (first.mass + second.mass);
  const double radius = first.radius * second.radius / (first.radius + second.radius);
  if (const SoftContact* soft = scene.soft_between(i, j)) return soft_spring(*soft, mass, radius);
  const PairContact& hard = scene.between(i, j);
  const double e = restitution_at(hard.restitution, approach_speed(scene));
  Spring spring =
      spring_with({e, hard.tangential_restitution, mass, tangential_mass_ratio(first, second)},
                  holds_by_springs(scene, settings), settings);
  spring.effective_radius = radius;
  // β0 = −1, u_t' = u_t: no tangential impulse whatever μ is.
  spring.friction = hard.tangential_restitution == -1 ? 0 : std::get<double>(hard.friction);
  return spring;
}

Spring substrate_spring(const EngineScene& scene, std::size_t body,
                        const LammpsSettings& settings) {
  const SubstrateContact& ground = scene.on_substrate(body);
  return spring_on({ground.restitution, 0, scene.bodies[body].mass, kappa_of(scene.bodies[body])},
                   ground.kinetic_friction, ground, scene.bodies[body], scene, settings);
}

Spring surface_spring(const EngineScene& scene, std::size_t body, std::size_t k,
                      const LammpsSettings& settings) {
  const Sphere& sphere = scene.bodies[body];
  if (const SoftContact* soft = scene.soft_on_surface(body, k))
    return soft_spring(*soft, sphere.mass, sphere.radius);
  const int touch = surface_touch(k), whose = static_cast<int>(body);
  const SurfaceContact& contact = scene.on_surface(body, k);
  return spring_on({peer::typed_values(scene, whose, touch).restitution,
                    contact.impact.tangential_restitution, sphere.mass, kappa_of(sphere)},
                   peer::exact_values(scene, whose, touch, {}).friction, contact.lasting, sphere,
                   scene, settings);
}

bool holds_by_springs(const EngineScene& scene, const LammpsSettings& settings) {
  return settings.sticking_by == StickingBy::spring ||
         (settings.sticking_by == StickingBy::scene && scene.has_memory());
}

double collision_time(const Spring& spring, double speed) {
  const double mass = spring.mass;
  if (spring.hertz)  // elastic: 2.94 ξ_max/v with ξ_max = ((5/4) m v²/ρ)^(2/5)
    return 2.9433 * std::pow(1.25 * mass / spring.stiffness, 0.4) * std::pow(speed, -0.2);
  return kPi / std::sqrt(spring.stiffness / mass);
}

double approach_speed(const Scene& scene) {
  double fastest = 1e-3;
  // Of many bodies what no two can exceed: there are too many pairs.
  constexpr std::size_t kFew = 2000;
  if (scene.bodies.size() > kFew) {
    Vector3 mean = Vector3::Zero();
    for (const BodyState& state : scene.initial)
      mean += state.velocity / static_cast<double>(scene.initial.size());
    for (const BodyState& state : scene.initial)
      fastest = std::max(fastest, 2 * (state.velocity - mean).norm());
    return fastest;
  }
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      fastest = std::max(fastest, (scene.initial[i].velocity - scene.initial[j].velocity).norm());
  return fastest;
}

}  // namespace slipcheck::lammps
