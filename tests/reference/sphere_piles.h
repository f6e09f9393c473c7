#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "../scenes.h"
#include "force_cones.h"

namespace slipcheck::test {

/// A tetrahedral pile of equal steel spheres that touch: `layers` layers, of 1, 3, 6, … spheres
/// from the top; 2 layers are four spheres, 4 are twenty.
inline Scene pile(int layers, double friction, double on_ground) {
  Scene scene = steel_scene(0);
  const Sphere sphere = steel_scene(1).bodies[0];
  const double R = sphere.radius, rise = 2 * R * std::sqrt(2.0 / 3);
  scene.substrate[0].static_friction = scene.substrate[0].kinetic_friction = on_ground;
  scene.pairs[0] = {0.5, friction, 0.0};
  for (int level = 0; level < layers; ++level) {
    const int side = layers - level;
    // Each layer's triangle sits over the hollows of the one below.
    const Vector3 corner(level * R, level * R / std::sqrt(3.0), R + level * rise);
    for (int row = 0; row < side; ++row)
      for (int k = 0; k + row < side; ++k) {
        BodyState state;
        state.position = corner + Vector3(2 * R * k + R * row, std::sqrt(3.0) * R * row, 0);
        scene.bodies.push_back(sphere);
        scene.material.push_back(0);
        scene.initial.push_back(state);
      }
  }
  return scene;
}

/// Where its spheres touch each other and the ground.
inline std::vector<ConeContact> contacts_of(const Scene& scene) {
  std::vector<ConeContact> found;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Vector3& a = scene.initial[i].position;
    const double R = scene.bodies[i].radius;
    if (a.z() <= R * (1 + 1e-9))
      found.push_back(
          {static_cast<int>(i), -1, a - R * kUp, kUp, scene.on_substrate(i).static_friction});
    for (std::size_t j = 0; j < i; ++j) {
      const Vector3& b = scene.initial[j].position;
      if ((a - b).norm() > 2 * R * (1 + 1e-9)) continue;
      found.push_back({static_cast<int>(i), static_cast<int>(j), 0.5 * (a + b),
                       (a - b).normalized(), friction_at(scene.between(i, j).friction, 0)});
    }
  }
  return found;
}

inline bool statics_holds(const Scene& scene, Pyramid pyramid) {
  std::vector<Vector3> centres;
  std::vector<double> weights;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    // In radii and weights, of which the programme has the scale it likes.
    centres.push_back(scene.initial[i].position / scene.bodies[0].radius);
    weights.push_back(scene.bodies[i].mass / scene.bodies[0].mass);
  }
  std::vector<ConeContact> contacts = contacts_of(scene);
  for (ConeContact& contact : contacts) contact.point /= scene.bodies[0].radius;
  return can_stand(centres, weights, contacts, pyramid);
}

}  // namespace slipcheck::test
