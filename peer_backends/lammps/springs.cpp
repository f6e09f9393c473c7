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

namespace slipcheck::lammps {
namespace {

constexpr double kPi = std::numbers::pi;

/// ξ̈ + γ ξ̇ + ω0² ξ = 0 takes t_col = π/ω and leaves e = exp(−γ t_col/2).
Spring spring_with(double restitution, double mass, const LammpsSettings& settings) {
  if (settings.collision_time == 0)
    throw Refused(
        "lammps: the scene has hard contacts, LAMMPS has forces that last alone, and the setting "
        "collision_time allows no spring in their place");
  Spring spring;
  spring.mass = mass;
  const double e = std::max(restitution, settings.lowest_restitution);
  const LinearContact law = LinearContact::with_collision_time(mass, e, settings.collision_time,
                                                               ContactEnd::zero_overlap);
  spring.stiffness = law.stiffness();
  spring.damping = law.damping_rate() * mass;
  if (settings.coefficients == Coefficients::fields) spring.tsuji_restitution = restitution;
  spring.tangential = settings.sticking / settings.collision_time * mass;
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

Spring soft_spring(const SoftContact& contact, double mass, double effective_radius) {
  if (contact.after_impact)
    throw Refused("lammps: the scene's forces only hold what an impact leaves together");
  Spring spring;
  spring.mass = mass;
  spring.effective_radius = effective_radius;
  spring.never_attracts = contact.end == ContactEnd::zero_force;
  std::visit(NormalOf{spring}, contact.normal);
  std::visit(TangentialOf{spring}, contact.tangential);
  if (spring.hertz && spring.damping > 0 && spring.friction > 0 && spring.tangential > 0)
    throw Refused(
        "lammps: its tangential damping goes with its normal one, by the root of the overlap, "
        "where the scene's does not");
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
  Spring spring =
      spring_with(restitution_at(hard.restitution, approach_speed(scene)), mass, settings);
  spring.effective_radius = radius;
  // β0 = −1, u_t' = u_t: no tangential impulse whatever μ is.
  spring.friction = hard.tangential_restitution == -1 ? 0 : std::get<double>(hard.friction);
  return spring;
}

Spring substrate_spring(const Scene& scene, std::size_t body, const LammpsSettings& settings) {
  const SubstrateContact& ground = scene.on_substrate(body);
  Spring spring = spring_with(ground.restitution, scene.bodies[body].mass, settings);
  spring.effective_radius = scene.bodies[body].radius;
  spring.friction = ground.kinetic_friction;
  return spring;
}

Spring surface_spring(const Scene& scene, std::size_t body, std::size_t k,
                      const LammpsSettings& settings) {
  const int touch = surface_touch(k), whose = static_cast<int>(body);
  Spring spring = spring_with(peer::typed_values(scene, whose, touch).restitution,
                              scene.bodies[body].mass, settings);
  spring.effective_radius = scene.bodies[body].radius;
  spring.friction = peer::exact_values(scene, whose, touch, {}).friction;
  return spring;
}

double collision_time(const Spring& spring, double speed) {
  const double mass = spring.mass;
  if (spring.hertz)  // elastic: 2.94 ξ_max/v with ξ_max = ((5/4) m v²/ρ)^(2/5)
    return 2.9433 * std::pow(1.25 * mass / spring.stiffness, 0.4) * std::pow(speed, -0.2);
  const double rate = spring.damping / mass, square = spring.stiffness / mass - rate * rate / 4;
  return kPi / std::sqrt(square > 0 ? square : spring.stiffness / mass);
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
