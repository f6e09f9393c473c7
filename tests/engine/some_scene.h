#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/engine.h"
#include "scene/scene.h"

namespace slipcheck {

/// `count` steel spheres in a row that fly along x at 1 m/s, two materials, one law of each kind.
inline Scene some_scene(std::size_t count = 2) {
  Scene scene;
  for (std::size_t i = 0; i < count; ++i) {
    scene.bodies.push_back({0.002, 2.6e-4, 0.4});
    BodyState state;
    state.position = Vector3(0.01 * static_cast<double>(i), 0, 0.002);
    state.velocity = Vector3(1, 0, 0);
    scene.initial.push_back(state);
    scene.material.push_back(i % 2);
  }
  SubstrateContact ground;
  ground.static_friction = 0.5;
  ground.kinetic_friction = 0.1;
  ground.rolling = RollingFriction({{0, 0.001}, {0.5, 0.002}});
  ground.drilling_length = 1e-5;
  SubstrateContact coupled;
  coupled.drilling_length = 2e-5;
  coupled.coupled_radius = 1e-4;
  coupled.hertzian_pressure = true;
  coupled.rolling_while_sliding = true;
  scene.substrate = {ground, coupled};
  const TabulatedRestitution table{-2, 0.5, {3, 2, 1}, {-1, -2, -3}};
  scene.pairs = {{0.9, 0.5, 0},
                 {PowerLawRestitution{}, 0, -1},
                 {PowerLawRestitution{}, 0, -1},
                 {table, 0, -1}};
  scene.gravity = 9.81;
  scene.downhill = {0, -0.8};
  scene.motion = SubstrateMotion::oscillation({0.1, 0.02}, 5, 0.3);
  return scene;
}

/// The same spheres in a shaken box with a lid, each contact different.
inline Scene some_box(std::size_t count = 2) {
  Scene scene = some_scene(count);
  scene.downhill = Vector2::Zero();
  scene.motion = {};
  Box box;
  box.width = 0.1;
  box.floor = {1e-3, 1.0 / 7};
  box.moving_walls = true;
  box.lid = 0.3;
  box.on_floor = {{0.9, 0.5, 0}, {PowerLawRestitution{}, 0.4, 0.1}};
  box.on_wall = {{0.8, 0.3, -0.5}, {TabulatedRestitution{-2, 0.5, {3, 2}, {-1, -2}}, 0, -1}};
  box.on_lid = {{0.7, 0.2, 0.5}, {0.6, 0.1, 1}};
  scene.box = box;
  return scene;
}

/// The same spheres among a surface of each shape and motion, without a substrate.
inline Scene some_surfaces(std::size_t count = 2) {
  Scene scene = some_scene(count);
  scene.has_substrate = false;
  const SubstrateMotion course = SubstrateMotion::oscillation({0.1, 1.0 / 3}, 1.0 / 7, 0.3);
  const Vector3 x = Vector3::UnitX(), z = Vector3::UnitZ();
  scene.surfaces = {
      {PlaneShape{{0, 0, 1.0 / 3}, {0.6, 0, 0.8}}, {}},
      {RectangleShape{{1, 2, 3}, {0.5, 0, 0}, {0, 0.1, 0}}, SurfaceMotion::moving(course, z, x)},
      {RodShape{{0, 0, 0}, {0, 1, 0}, 0.1}, SurfaceMotion::turning({0, 0, 0.2}, {0, 3, 0})},
      {BallShape{{1, 1, 1}, 0.25}, SurfaceMotion::belt(course, x, z)}};
  for (std::size_t k = 0; k < 8; ++k)
    scene.on_surfaces.push_back({scene.substrate[k % 2], {0.1 * static_cast<double>(k), 0.3, 0.5}});
  return scene;
}

/// A setting of each kind.
inline std::vector<SettingInfo> some_settings() {
  SettingInfo on, erp, iterations, body, label;
  on.name = "warm_starting";
  on.about = "begins with the last step's impulses";
  on.shipped = true;
  on.candidates = {true, false};
  erp.name = "erp";
  erp.about = "share of an overlap that is resolved in a step";
  erp.unit = "1/step";
  erp.shipped = 0.2;
  erp.low = 0;
  erp.high = 1;
  erp.candidates = {0.0, 0.2};
  erp.range = SettingInfo::Range{0.01, 1, true};
  iterations.name = "iterations";
  iterations.shipped = 10.0;
  iterations.low = 1;
  iterations.whole = true;
  body.name = "body";
  body.shipped = std::string("rigid");
  body.choices = {"rigid", "multibody"};
  body.candidates = {std::string("multibody")};
  label.name = "label_2";
  label.shipped = std::string();
  return {on, erp, iterations, body, label};
}

inline std::string faulty_engine() {
  return std::string(SLIPCHECK_BINARY_DIR) + "/faulty/slipcheck-engine-faulty-double";
}

}  // namespace slipcheck
