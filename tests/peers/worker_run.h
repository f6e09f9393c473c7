#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "engine/engine_scene.h"
#include "peer_worker.h"

namespace slipcheck::test {

/// The frames of a run from the scene's initial states.
inline std::vector<Frame> peer_run(RemoteEngine& engine, const EngineScene& scene,
                                   const Settings& settings, double time_step, std::size_t steps) {
  engine.configure(scene, settings, time_step);
  engine.start(scene.initial);
  std::vector<Frame> frames;
  engine.advance(steps, [&](const Frame& frame) { frames.push_back(frame); });
  return frames;
}

inline Settings with(Settings base, const Settings& others) {
  for (const auto& [name, value] : others) base[name] = value;
  return base;
}

/// One steel ball of this radius [m] on a substrate.
inline Scene ball_on(const SubstrateContact& ground, double radius, const Vector3& position,
                     const Vector3& velocity, const Vector3& spin = Vector3::Zero()) {
  Scene scene;
  scene.gravity = 9.81;
  scene.bodies = {{radius, 7850 * 4 * M_PI / 3 * std::pow(radius, 3), 0.4}};
  scene.initial = {{position, velocity, spin}};
  scene.material = {0};
  scene.substrate = {ground};
  scene.pairs = {{}};
  return scene;
}

/// scenarios/slide-to-roll.yaml.
inline Scene slide_to_roll() {
  SubstrateContact ground;
  ground.static_friction = ground.kinetic_friction = 0.2;
  return ball_on(ground, 0.005, {0, 0, 0.005}, {0.5, 0, 0});
}

/// scenarios/bouncing-ball.yaml.
inline Scene bouncing_ball() {
  SubstrateContact ground;
  ground.static_friction = ground.kinetic_friction = 0.3;
  ground.restitution = 0.8;
  return ball_on(ground, 0.01, {0, 0, 0.06}, Vector3::Zero());
}

/// scenarios/roll-to-rest.yaml.
inline Scene roll_to_rest() {
  SubstrateContact ground;
  ground.static_friction = ground.kinetic_friction = 0.3;
  ground.rolling = RollingFriction({{0, 0.02}});
  const Vector3 velocity(0.4330127018922193, 0.25, 0);
  return ball_on(ground, 0.01, {0, 0, 0.01}, velocity, rolling_angular_velocity(velocity, 0.01));
}

/// When the slip of the first body ends [s]: its zero by the line through the last two frames in
/// which it slides, as its deceleration is constant; `radius` [m].
inline double sliding_end(const std::vector<Frame>& frames, double radius, double time_step) {
  const auto slip = [&](std::size_t n) {
    return slip_velocity(frames[n].bodies[0], radius).head<2>().norm();
  };
  std::size_t n = 1;
  while (n + 1 < frames.size() && slip(n + 1) < slip(n) && slip(n + 1) > 1e-3 * slip(0)) ++n;
  const double rate = (slip(n - 1) - slip(n)) / time_step;
  return static_cast<double>(n + 1) * time_step + slip(n) / rate;
}

/// The square root of the last frame's energy over that of the fall: the first rebound's e where
/// there was one.
inline double rebound(const std::vector<Frame>& frames, const Scene& scene) {
  const double radius = scene.bodies[0].radius, g = scene.gravity;
  const BodyState& last = frames.back().bodies[0];
  const double v = last.velocity.z();
  return std::sqrt((0.5 * v * v + g * (last.position.z() - radius)) /
                   (g * (scene.initial[0].position.z() - radius)));
}

}  // namespace slipcheck::test
