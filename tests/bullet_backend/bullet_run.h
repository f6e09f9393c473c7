#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "engine/remote_engine.h"
#include "scenario/hard_scene.h"

namespace slipcheck {

inline constexpr double kGravity = 9.81;  // [m/s²]

inline std::string bullet_executable(const std::string& precision) {
  return std::string(SLIPCHECK_BINARY_DIR) + "/slipcheck-engine-bullet-" + precision;
}

/// A steel sphere.
inline Sphere steel_ball(double radius) {
  return {radius, 7850 * 4.0 / 3 * std::numbers::pi * std::pow(radius, 3), 0.4};
}

/// A state of rolling along x at the speed v, on the plane.
inline BodyState rolling_along_x(double radius, double x, double v) {
  BodyState state;
  state.position = Vector3(x, 0, radius);
  state.velocity = Vector3(v, 0, 0);
  state.angular_velocity = rolling_angular_velocity(state.velocity, radius);
  return state;
}

/// Equal balls of one material.
inline HardScene scene_of(const Sphere& ball, const std::vector<BodyState>& states,
                          const SubstrateContact& ground, const PairContact& pair = {}) {
  HardScene scene;
  scene.bodies.assign(states.size(), ball);
  scene.initial = states;
  scene.material.assign(states.size(), 0);
  scene.substrate = {ground};
  scene.pairs = {pair};
  scene.gravity = kGravity;
  return scene;
}

/// Friction of the substrate, static and kinetic alike.
inline SubstrateContact ground_with_friction(double mu) {
  SubstrateContact ground;
  ground.static_friction = ground.kinetic_friction = mu;
  return ground;
}

/// The frames of a run from the scene's initial states.
inline std::vector<Frame> run(RemoteEngine& engine, const HardScene& scene,
                              const std::string& profile, double rate, std::size_t steps) {
  engine.configure(scene, profile, 1 / rate);
  engine.start(scene.initial);
  std::vector<Frame> frames;
  engine.advance(steps, [&](const Frame& frame) { frames.push_back(frame); });
  return frames;
}

}  // namespace slipcheck
