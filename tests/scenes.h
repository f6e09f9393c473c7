#pragma once

#include <cmath>

#include "scene/scene.h"

namespace slipcheck::test {

/// Steel balls of one kind on a level substrate, K's numbers: R = 2 mm, μ_k = 0.1, g = 9.81 m/s².
inline Scene steel_scene(std::size_t count = 0) {
  Scene scene;
  scene.gravity = 9.81;
  SubstrateContact substrate;
  substrate.static_friction = 0.5;
  substrate.kinetic_friction = 0.1;
  scene.substrate = {substrate};
  scene.pairs = {{0.9, 0.0, -1.0}};
  const double radius = 0.002;
  const double mass = 7850 * 4 * M_PI / 3 * std::pow(radius, 3);
  scene.bodies.assign(count, Sphere{radius, mass, 0.4});
  scene.material.assign(count, 0);
  scene.initial.assign(count, BodyState{});
  for (BodyState& state : scene.initial) state.position.z() = radius;
  return scene;
}

inline BodyState rolling_at(double x, double y, double vx, double vy, double radius = 0.002) {
  BodyState state;
  state.position = {x, y, radius};
  state.velocity = {vx, vy, 0};
  state.angular_velocity = rolling_angular_velocity(state.velocity, radius);
  return state;
}

/// Two rolling balls on the x axis, centres at ∓`half_distance`.
inline Scene head_on(double v_i, double v_j, double restitution, double half_distance = 0.005) {
  Scene scene = steel_scene(2);
  scene.pairs[0].restitution = restitution;
  scene.initial = {rolling_at(-half_distance, 0, v_i, 0), rolling_at(half_distance, 0, v_j, 0)};
  return scene;
}

/// Two balls far above the plane without gravity or spin; centres at ∓`half_distance`, in touch.
inline Scene free_pair(double v_i, double v_j, double half_distance = 0.002) {
  Scene scene = steel_scene(2);
  scene.gravity = 0;
  scene.initial[0] = {{-half_distance, 0, 1}, {v_i, 0, 0}, Vector3::Zero()};
  scene.initial[1] = {{half_distance, 0, 1}, {v_j, 0, 0}, Vector3::Zero()};
  return scene;
}

}  // namespace slipcheck::test
