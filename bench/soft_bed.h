#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

#include "physics/contact/linear_contact.h"
#include "scene/contact_scene.h"

namespace slipcheck::bench {

/// Spheres of glass that fall into a container and settle there: soft contacts that remember.
struct SoftBed {
  std::size_t count = 1000;
  double ratio = 1;        ///< largest over smallest radius, evenly spread in four sizes, >= 1
  std::size_t length = 0;  ///< spheres along x; 0: as many as along y
  bool walls = true;       ///< else a periodic plane
  double collision_time = 1e-3;  ///< of the largest with its like [s]
  double gap = 1.02;             ///< of the lattice on which they start, in largest diameters
  unsigned seed = 1;
};

/// SI, radii up to 5 mm; linear springs with k_t = 2/7 k_n, c_t = c_n/2, μ = 0.4 and e = 0.5. For
/// equal radii the forces are those of LAMMPS's gran/hooke/history, whose dashpots go with the
/// reduced mass: at a wall they are twice as strong.
inline ContactScene soft_bed(const SoftBed& bed) {
  constexpr double kLargest = 5e-3, kDensity = 2500, kSpeed = 0.3;
  std::mt19937_64 random(bed.seed);
  const auto uniform = [&] { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; };
  ContactScene scene;
  Scene& hard = scene.hard;
  const double spacing = bed.gap * 2 * kLargest;
  const double cube = 0.7 * static_cast<double>(bed.count);
  const double width =
      bed.length > 0 ? std::sqrt(cube / static_cast<double>(bed.length)) : std::cbrt(cube);
  const auto across = static_cast<std::size_t>(std::max(4.0, std::round(width)));
  const std::size_t along = bed.length > 0 ? bed.length : across;
  const auto side = [&](std::size_t spheres) {
    return spacing * static_cast<double>(spheres) + 0.1 * kLargest;
  };
  for (std::size_t i = 0; i < bed.count; ++i) {
    const auto size = static_cast<double>(random() % 4) / 3;
    const double R = kLargest * (1 - size * (1 - 1 / bed.ratio));
    const double mass = kDensity * 4 * M_PI / 3 * R * R * R;
    hard.bodies.push_back({R, mass, 0.4});
    hard.material.push_back(0);
    const auto cell = [&](std::size_t k) {
      return spacing * (static_cast<double>(k) + 0.5) + 0.05 * kLargest;
    };
    BodyState state;
    state.position = {cell(i % along), cell(i / along % across),
                      cell(i / (along * across)) + kLargest};
    for (int k = 0; k < 3; ++k) state.velocity[k] = kSpeed * (2 * uniform() - 1);
    state.velocity.z() -= 0.5;
    hard.initial.push_back(state);
  }
  hard.gravity = 9.81;
  hard.substrate.resize(1);
  hard.pairs = {{0.5, 0.4, -1.0}};
  SoftContact contact;
  const double mass = kDensity * 4 * M_PI / 3 * std::pow(kLargest, 3);
  const LinearContact linear = LinearContact::with_collision_time(
      0.5 * mass, 0.5, bed.collision_time, ContactEnd::zero_force);
  contact.end = ContactEnd::zero_force;
  const double k = linear.stiffness(), c = linear.damping_rate() * 0.5 * mass;
  contact.normal = LinearForce{k, c};
  contact.memory.emplace();
  contact.memory->sliding.stiffness = 2.0 / 7 * k;
  contact.memory->sliding.damping = 0.5 * c;
  contact.memory->sliding.static_friction = contact.memory->sliding.kinetic_friction = 0.4;
  scene.soft = {contact};
  if (!bed.walls) {
    hard.periodic = {side(along), side(across)};
    return scene;
  }
  hard.has_substrate = false;
  const Vector3 far(side(along), side(across), 0);
  for (const auto& [point, normal] : {std::pair{Vector3(0, 0, 0), Vector3(0, 0, 1)},
                                      {Vector3(0, 0, 0), Vector3(1, 0, 0)},
                                      {Vector3(0, 0, 0), Vector3(0, 1, 0)},
                                      {far, Vector3(-1, 0, 0)},
                                      {far, Vector3(0, -1, 0)}}) {
    hard.surfaces.push_back({PlaneShape{point, normal}, {}});
    hard.on_surfaces.emplace_back().impact = hard.pairs[0];
    SoftContact& at_wall = *scene.soft_surfaces.emplace_back(contact);
    at_wall.normal = LinearForce{k, 2 * c};
    at_wall.memory->sliding.damping = c;
  }
  return scene;
}

}  // namespace slipcheck::bench
