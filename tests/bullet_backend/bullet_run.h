#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "engine/lacks.h"
#include "engine/profile.h"
#include "engine/remote_engine.h"
#include "engine/settings.h"
#include "scene/scene.h"

namespace slipcheck {

inline constexpr double kGravity = 9.81;  // [m/s²]
inline constexpr double kRadius = 0.002;  // of most steel balls [m]

inline std::string bullet_executable(const std::string& precision) {
  return std::string(SLIPCHECK_BINARY_DIR) + "/slipcheck-engine-bullet-" + precision;
}

/// The settings of a profile that is shipped.
inline Settings shipped(const std::string& profile) {
  return load_profile(std::string(SLIPCHECK_SOURCE_DIR) + "/bullet_backend/profiles/" + profile +
                      ".yaml")
      .settings;
}

/// What the profiles of these names come down to.
inline const Settings kDefault = {};
inline const Settings kNaive = {{"coefficients", "fields"}};

/// `base` with other settings over it.
inline Settings with(Settings base, const Settings& others) {
  for (const auto& [name, value] : others) base[name] = value;
  return base;
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

/// The horizontal direction so many degrees from x.
inline Vector3 direction(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {std::cos(angle), std::sin(angle), 0};
}

/// Rolling at the speed v in a direction [degrees from x], `place` along it.
inline BodyState rolling_towards(double radius, double v, double degrees, double place = 0) {
  BodyState state;
  state.position = place * direction(degrees) + Vector3(0, 0, radius);
  state.velocity = v * direction(degrees);
  state.angular_velocity = rolling_angular_velocity(state.velocity, radius);
  return state;
}

/// Equal balls of one material.
inline Scene scene_of(const Sphere& ball, const std::vector<BodyState>& states,
                      const SubstrateContact& ground, const PairContact& pair = {}) {
  Scene scene;
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

/// The same with rolling, drilling and rebound, all different.
inline SubstrateContact rough_ground(const RollingFriction& rolling) {
  SubstrateContact ground = ground_with_friction(0.1);
  ground.static_friction = 0.5;
  ground.rolling = rolling;
  ground.drilling_length = 2e-5;
  ground.restitution = 0.4;
  return ground;
}

/// The frames of a run from the scene's initial states, with those inside steps.
inline std::vector<Frame> run(RemoteEngine& engine, const Scene& scene, const Settings& settings,
                              double rate, std::size_t steps) {
  engine.configure(scene, settings, 1 / rate);
  engine.start(scene.initial);
  std::vector<Frame> frames;
  engine.advance(steps, [&](const Frame& frame) { frames.push_back(frame); });
  return frames;
}

/// A value that the engine takes and does not ship with.
inline Setting another(const SettingInfo& info) {
  if (const bool* flag = std::get_if<bool>(&info.shipped)) return !*flag;
  if (std::holds_alternative<std::string>(info.shipped))
    return info.choices.back() == std::get<std::string>(info.shipped) ? info.choices.front()
                                                                      : info.choices.back();
  // Halves and thirds that single precision would round, and one more of what is whole.
  const double shipped = std::get<double>(info.shipped);
  if (info.whole) return shipped + 1;
  for (const double value : {shipped / 3, shipped * 3, 0.3, 3.0})
    if (value != shipped && broken_rule(info, value).empty()) return value;
  ADD_FAILURE() << info.name << " has no other value";
  return info.shipped;
}

/// A setting that applies; NaN, and the test fails, where it does not.
inline double number(const Applied& applied, const std::string& name) {
  const auto found = applied.settings.find(name);
  if (found == applied.settings.end()) ADD_FAILURE() << name << " is not among the settings";
  return found == applied.settings.end() ? std::nan("") : std::get<double>(found->second);
}

/// Whether what is not represented includes something that starts so.
inline bool lists(const Applied& applied, const std::string& start) {
  return std::ranges::any_of(applied.not_represented,
                             [&](const Lack& lack) { return lack.text.starts_with(start); });
}

/// By what friction a ball of 1 cm is braked that slides at 2 m/s on a plane of friction `mu`, over
/// 20 ms; dv/dt = −μ g.
inline double braking_friction(double mu, const Settings& settings) {
  BodyState state;
  state.position = Vector3(0, 0, 0.01);
  state.velocity = Vector3(2, 0, 0);
  RemoteEngine engine(bullet_executable("double"));
  const auto frames = run(engine, scene_of(steel_ball(0.01), {state}, ground_with_friction(mu)),
                          settings, 1000, 20);
  return (2 - frames.back().bodies[0].velocity.x()) / (kGravity * 0.02);
}

/// Whether two balls touched.
inline bool touch_each_other(const Frame& frame) {
  return std::ranges::any_of(frame.touches,
                             [](const Touch& touch) { return touch.second != kSubstrate; });
}

}  // namespace slipcheck
