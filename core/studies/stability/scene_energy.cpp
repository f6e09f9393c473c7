#include "studies/stability/scene_energy.h"

#include <algorithm>
#include <cmath>

namespace slipcheck {

double kinetic_energy(const Scene& scene, std::span<const BodyState> states) {
  double energy = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Sphere& sphere = scene.bodies[i];
    energy += 0.5 * sphere.mass * states[i].velocity.squaredNorm() +
              0.5 * sphere.moment_of_inertia() * states[i].angular_velocity.squaredNorm();
  }
  return energy;
}

double potential_energy(const Scene& scene, std::span<const BodyState> states) {
  double energy = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Vector3& x = states[i].position;
    const Vector2 way = (x - scene.initial[i].position).head<2>();
    energy += scene.bodies[i].mass *
              (scene.gravity * (x.z() - scene.bodies[i].radius) - scene.downhill.dot(way));
  }
  return energy;
}

EnergyRange shown_energy(const Scene& scene, std::span<const BodyState> states, double step,
                         std::span<const double> slack) {
  const double energy = kinetic_energy(scene, states) + potential_energy(scene, states);
  const Vector3 gravity(scene.downhill.x(), scene.downhill.y(), -scene.gravity);
  EnergyRange range{energy, energy};
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double mass = scene.bodies[i].mass;
    const double ripple = 0.5 * step * mass * std::abs(gravity.dot(states[i].velocity));
    const double height = states[i].position.z() - scene.bodies[i].radius;
    range.low -= ripple + mass * scene.gravity * std::clamp(height, 0.0, slack[i]);
    range.high += ripple + mass * scene.gravity * std::clamp(-height, 0.0, slack[i]);
  }
  return range;
}

}  // namespace slipcheck
