#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>

#include "scene/scene.h"

namespace slipcheck::test {

/// Uniform in [0, 1) from 53 random bits: the same everywhere.
inline double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// One material with one contact for everything.
inline Scene of_one_material(std::size_t n, double radius, const PairContact& contact) {
  Scene scene;
  scene.bodies.assign(n, Sphere{radius, 1, 0.4});
  scene.material.assign(n, 0);
  scene.substrate.resize(1);
  scene.pairs = {contact};
  return scene;
}

/// A gas of n unit-mass spheres of radius 1/2 on a smooth periodic plane at an area fraction; on a
/// square lattice at first, with random velocities of about 1 m/s.
inline Scene smooth_gas(std::size_t n, double area_fraction, const PairContact& contact,
                        std::uint64_t seed = 1) {
  constexpr double kRadius = 0.5;
  Scene scene = of_one_material(n, kRadius, contact);
  const double disks = static_cast<double>(n) * std::numbers::pi * kRadius * kRadius;
  const double length = std::sqrt(disks / area_fraction);
  scene.periodic = {length, length};
  scene.gravity = 9.81;
  scene.confined = true;
  std::mt19937_64 random(seed);
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n))));
  for (std::size_t i = 0; i < n; ++i) {
    BodyState state;
    state.position = {(static_cast<double>(i % side) + 0.5) * length / static_cast<double>(side),
                      (static_cast<double>(i / side) + 0.5) * length / static_cast<double>(side),
                      kRadius};
    const auto symmetric = [&] { return 2 * uniform(random) - 1; };
    state.velocity = {symmetric(), symmetric(), 0};
    scene.initial.push_back(state);
  }
  return scene;
}

/// Unit-mass balls of radius 1/2 that slide and roll on a level table inside four cushions, at an
/// area fraction of 0.3 at first; as fast as those of smooth_gas().
inline Scene balls_in_frame(std::size_t n, std::uint64_t seed = 1) {
  Scene scene = smooth_gas(
      n, 0.3, PairContact{.restitution = 0.93, .friction = 0.05, .tangential_restitution = 0},
      seed);
  const Vector2 length = scene.periodic;
  scene.periodic.setZero();
  scene.confined = false;
  scene.substrate[0].static_friction = scene.substrate[0].kinetic_friction = 0.05;
  scene.substrate[0].rolling = RollingFriction(0.002);
  const Vector3 far(length.x(), length.y(), 0);
  for (const auto& [point, normal] :
       {std::pair<Vector3, Vector3>{Vector3::Zero(), Vector3::UnitX()},
        {Vector3::Zero(), Vector3::UnitY()},
        {far, -Vector3::UnitX()},
        {far, -Vector3::UnitY()}}) {
    scene.surfaces.push_back({PlaneShape{point, normal}, {}});
    SurfaceContact cushion;
    cushion.impact = {.restitution = 0.9, .friction = 0.1, .tangential_restitution = 0};
    scene.on_surfaces.push_back(cushion);
  }
  return scene;
}

/// L's box with n spheres of 1 mm and 1 g, a width of 10 mm, f = 100 Hz and the floor speed V
/// [m/s]; the same contact for pairs, floor and walls.
inline Scene shaken_box(std::size_t n, double V, const PairContact& contact,
                        std::uint64_t seed = 1) {
  constexpr double kRadius = 0.5e-3;
  Scene scene = of_one_material(n, kRadius, contact);
  for (Sphere& sphere : scene.bodies) sphere.mass = 1e-3;
  scene.gravity = 9.81;
  Box box;
  box.width = 10e-3;
  box.floor = {V / (2 * std::numbers::pi * 100), 100};
  box.on_floor = box.on_wall = box.on_lid = {contact};
  scene.box = box;
  std::mt19937_64 random(seed);
  for (std::size_t i = 0; i < n; ++i) {
    BodyState state;
    state.position = {(1 + static_cast<double>(i % 8)) * 1.1e-3, 0,
                      box.floor.amplitude + (1 + static_cast<double>(i / 8)) * 1.2e-3};
    state.velocity = {0.2 * uniform(random) - 0.1, 0, 0.2 * uniform(random) - 0.1};
    scene.initial.push_back(state);
  }
  return scene;
}

}  // namespace slipcheck::test
