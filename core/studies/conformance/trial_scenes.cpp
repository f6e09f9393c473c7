#include "studies/conformance/trial_scenes.h"

#include <numbers>

namespace slipcheck {
namespace {

constexpr std::size_t kInRow = 20;
constexpr double kTrialDensity = 7850;  // [kg/m³]

Sphere trial_sphere() {
  const double R = kTrialRadius;
  return {R, kTrialDensity * 4 / 3 * std::numbers::pi * R * R * R, 0.4};
}

}  // namespace

Scene spheres_on_plane(std::size_t bodies) {
  Scene scene;
  for (std::size_t i = 0; i < bodies; ++i) {
    scene.bodies.push_back(trial_sphere());
    scene.material.push_back(0);
    BodyState state;
    const std::size_t row = i / kInRow;
    state.position = {3 * kTrialRadius * static_cast<double>(i % kInRow),
                      3 * kTrialRadius * static_cast<double>(row), kTrialRadius};
    scene.initial.push_back(state);
  }
  SubstrateContact ground;
  ground.static_friction = ground.kinetic_friction = kTrialFriction;
  ground.restitution = 0.8;
  scene.substrate = {ground};
  scene.pairs = {{0.8, kTrialFriction, 0}};
  scene.gravity = 9.81;
  return scene;
}

Scene one_sphere(double height, const Vector3& velocity) {
  Scene scene = spheres_on_plane(1);
  scene.initial[0].position.z() += height;
  scene.initial[0].velocity = velocity;
  return scene;
}

Scene two_that_meet(double speed) {
  Scene scene = spheres_on_plane(2);
  scene.pairs = {{0.8, 0, -1}};
  for (const int side : {-1, 1}) {
    BodyState& state = scene.initial[side < 0 ? 0 : 1];
    state.position = {side * 2 * kTrialRadius, 0, kTrialRadius};
    state.velocity = {-side * speed, 0, 0};
    state.angular_velocity = rolling_angular_velocity(state.velocity, kTrialRadius);
  }
  return scene;
}

Scene spheres_in_box() {
  Scene scene = spheres_on_plane(3);
  for (BodyState& state : scene.initial) state.position += Vector3(0.03, 0, 0.02);
  Box box;
  box.width = 0.2;
  box.floor = {1e-3, 20};
  box.on_floor = box.on_wall = box.on_lid = {{0.8, kTrialFriction, 0}};
  scene.box = box;
  return scene;
}

}  // namespace slipcheck
