#include "peer_backends/simbody/hunt_crossley.h"

#include <algorithm>
#include <cmath>

#include "engine/engine.h"

namespace slipcheck::simbody {
namespace {

/// Of a scene in which nothing approaches [m/s].
constexpr double kGentle = 0.1;

double approach(const Scene& scene, std::size_t i, std::size_t j) {
  return (scene.initial[i].velocity - scene.initial[j].velocity).norm();
}

double landing(const Scene& scene, std::size_t body) {
  const BodyState& start = scene.initial[body];
  const double height = std::max(0.0, start.position.z() - scene.bodies[body].radius);
  return std::sqrt(std::pow(start.velocity.z(), 2) + 2 * scene.gravity * height);
}

/// Speed with which a body comes to a surface: its own towards it, and what the fall to it adds.
double arrival(const Scene& scene, std::size_t body, const slipcheck::Surface& surface) {
  const BodyState& start = scene.initial[body];
  const NearestPoint nearest = surface.nearest(0, start.position);
  const Vector3 relative = start.velocity - surface.motion.velocity(0, nearest.point);
  const double towards = -nearest.normal.dot(relative);
  const double height = std::max(0.0, nearest.distance - scene.bodies[body].radius);
  const double fall = std::max(0.0, -nearest.normal.dot(scene.gravity_vector()));
  return std::sqrt(towards * towards + 2 * fall * height);
}

double dissipation(double restitution, double seen, const SimbodySettings& settings) {
  if (settings.fields) return 1 - restitution;
  const double speed = settings.impact_speed > 0 ? settings.impact_speed : seen;
  return dissipation_for(std::max(restitution, settings.lowest_restitution),
                         speed > 0 ? speed : kGentle);
}

}  // namespace

double dissipation_for(double restitution, double speed) {
  const double e = restitution;
  if (e >= 1) return 0;
  const auto excess = [e](double a) { return a - std::log1p(a) + e * a + std::log1p(-e * a); };
  double low = 0, high = 1 / e;
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0 ? low : high) = middle;
  }
  return low / (1.5 * speed);
}

double modulus_for(double rho, double relative_radius) {
  return 0.75 * rho * std::pow(2, 1.5) / std::sqrt(relative_radius);
}

HuntCrossley pair_contact(const EngineScene& scene, std::size_t i, std::size_t j,
                          const SimbodySettings& settings) {
  const double ri = scene.bodies[i].radius, rj = scene.bodies[j].radius;
  if (const SoftContact* soft = scene.soft_between(i, j)) {
    const auto* hertz = std::get_if<HertzForce>(&soft->normal);
    if (!hertz || soft->after_impact)
      throw Refused(
          "simbody: of forces that last it has Hertz's alone, whose dissipation goes with the "
          "elastic force");
    if (!std::holds_alternative<NoTangentialForce>(soft->tangential))
      throw Refused("simbody: its tangential force is friction with a transition velocity alone");
    return {modulus_for(hertz->modulus, ri * rj / (ri + rj)), 0, 0, 0};
  }
  const PairContact& hard = scene.between(i, j);
  const double speed = approach(scene, i, j);
  const double mu = hard.tangential_restitution == -1 ? 0 : std::get<double>(hard.friction);
  const double e = restitution_at(hard.restitution, speed > 0 ? speed : kGentle);
  return {settings.modulus, dissipation(e, speed, settings), mu, mu};
}

HuntCrossley substrate_contact(const Scene& scene, std::size_t body,
                               const SimbodySettings& settings) {
  const SubstrateContact& ground = scene.on_substrate(body);
  return {settings.modulus, dissipation(ground.restitution, landing(scene, body), settings),
          settings.fields ? ground.kinetic_friction : ground.static_friction,
          ground.kinetic_friction};
}

HuntCrossley surface_contact(const Scene& scene, std::size_t body, std::size_t k,
                             const SimbodySettings& settings) {
  const SurfaceContact& contact = scene.on_surface(body, k);
  const SubstrateContact& ground = contact.lasting;
  const double speed = arrival(scene, body, scene.surfaces[k]);
  const double e = restitution_at(contact.impact.restitution, speed > 0 ? speed : kGentle);
  const bool smooth = contact.impact.tangential_restitution == -1;
  const double kinetic = smooth ? 0 : ground.kinetic_friction;
  return {settings.modulus, dissipation(e, speed, settings),
          settings.fields || smooth ? kinetic : ground.static_friction, kinetic};
}

}  // namespace slipcheck::simbody
