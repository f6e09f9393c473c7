#pragma once

#include <vector>

#include "bullet_run.h"

namespace slipcheck {

/// Equal balls of one material in a box 0.2 m wide, without gravity and contacts that rub.
inline Scene box_of(const Sphere& ball, const std::vector<BodyState>& states) {
  Scene scene = scene_of(ball, states, {});
  scene.gravity = 0;
  Box box;
  box.width = 0.2;
  box.on_floor = box.on_wall = box.on_lid = {PairContact{}};
  scene.box = box;
  return scene;
}

/// At (x, z) with the velocity (vx, vz) and the spin w about y.
inline BodyState in_plane(double x, double z, double vx, double vz, double w = 0) {
  return {Vector3(x, 0, z), Vector3(vx, 0, vz), Vector3(0, w, 0)};
}

}  // namespace slipcheck
