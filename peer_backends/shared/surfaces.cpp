#include "peer_backends/shared/surfaces.h"

namespace slipcheck::peer {

Vector3 Surface::displacement(const Scene& scene, double time) const {
  if (!moves || !scene.box) return Vector3::Zero();
  return {0, 0, scene.box->floor.height(time)};
}

Vector3 Surface::velocity(const Scene& scene, double time) const {
  if (!moves) return Vector3::Zero();
  if (!scene.box) return scene.motion.velocity(time);
  return {0, 0, scene.box->floor.velocity(time)};
}

std::vector<Surface> surfaces_of(const Scene& scene) {
  if (!scene.box && !scene.has_substrate) return {};
  if (!scene.box) return {{Vector3::UnitZ(), 0, kFloor, !scene.motion.is_still()}};
  const Box& box = *scene.box;
  const bool shaken = !box.floor.is_still(), walls = shaken && box.moving_walls;
  std::vector<Surface> surfaces = {{Vector3::UnitZ(), 0, kFloor, shaken},
                                   {Vector3::UnitX(), 0, kWall, walls},
                                   {-Vector3::UnitX(), -box.width, kWall, walls}};
  if (box.lid) surfaces.push_back({-Vector3::UnitZ(), -*box.lid, kLid, walls});
  return surfaces;
}

}  // namespace slipcheck::peer
