#include "reference/steps/grain_walls.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "physics/numbers.h"

namespace slipcheck {
namespace {

/// Which side of a plate all bodies are on, as its normal says: 1 or −1; 0: not on one.
double side_of(const RectangleShape& plate, const Scene& scene) {
  const auto beyond = [&](const BodyState& state) {
    return plate.normal().dot(state.position - plate.centre);
  };
  const auto [least, most] = std::ranges::minmax(scene.initial, {}, beyond);
  return beyond(least) > 0 ? 1 : beyond(most) < 0 ? -1 : 0;
}

/// A plane or plate that stands upright on the substrate, before all bodies.
std::optional<GrainWall> wall_of(const SurfaceShape& shape, const Scene& scene) {
  const auto upright = [](const Vector3& point, const Vector3& normal,
                          double top) -> std::optional<GrainWall> {
    if (std::abs(normal.z()) > 1e-12) return {};
    return GrainWall{normal.x(), normal.y(), normal.dot(point), top};
  };
  if (const auto* plane = std::get_if<PlaneShape>(&shape))
    return upright(plane->point, plane->normal, kNever);
  const auto* plate = std::get_if<RectangleShape>(&shape);
  if (!plate) return {};
  const double height = std::abs(plate->half_length.z()) + std::abs(plate->half_width.z());
  const double side = side_of(*plate, scene);
  if (side == 0 || plate->centre.z() - height > 1e-9 * scene.bodies[0].radius) return {};
  return upright(plate->centre, side * plate->normal(), plate->centre.z() + height);
}

/// Whether a plate's ends lie on other walls or behind them, where no body comes around them.
bool is_closed(const RectangleShape& plate, const std::vector<GrainWall>& walls, double radius) {
  const Vector3& level = std::abs(plate.half_length.z()) < std::abs(plate.half_width.z())
                             ? plate.half_length
                             : plate.half_width;
  const auto is_behind = [&](const Vector3& end) {
    // Not the plate's own: that is along both ends.
    return std::ranges::any_of(walls, [&](const GrainWall& wall) {
      return wall.distance(end.x(), end.y()) <= 1e-9 * radius &&
             std::abs(wall.x * level.x() + wall.y * level.y()) > 1e-9 * level.norm();
    });
  };
  return is_behind(plate.centre + level) && is_behind(plate.centre - level);
}

/// Whether a body may come over the walls: they do not reach thrice as high as the fastest could
/// alone.
bool are_low(const Scene& scene, const std::vector<GrainWall>& walls) {
  double speed = 0, radius = 0, top = kNever;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const double R = scene.bodies[i].radius;
    speed = std::max(
        speed, scene.initial[i].velocity.norm() + R * scene.initial[i].angular_velocity.norm());
    radius = std::max({radius, R, scene.initial[i].position.z()});
  }
  for (const GrainWall& wall : walls) top = std::min(top, wall.top);
  if (top == kNever) return false;
  return !(top > 3 * (radius + speed * speed / (2 * scene.gravity)));
}

}  // namespace

std::vector<GrainWall> grain_walls(const Scene& scene) {
  std::vector<GrainWall> walls;
  for (const Surface& surface : scene.surfaces)
    if (const std::optional<GrainWall> wall = wall_of(surface.shape, scene)) walls.push_back(*wall);
  return walls;
}

std::string wall_refusal(const Scene& scene) {
  if (scene.surfaces.empty()) return "";
  if (!scene.motion.is_still() || !scene.downhill.isZero(0))
    return "there are walls on a tilted or moving plane";
  if (scene.surfaces.size() >= GrainPair::kNoWall) return "there are many walls";
  const std::vector<GrainWall> walls = grain_walls(scene);
  if (walls.size() < scene.surfaces.size()) return "there are surfaces that are no walls";
  for (const Surface& surface : scene.surfaces) {
    if (!surface.motion.is_still()) return "there are surfaces that move";
    if (const auto* plate = std::get_if<RectangleShape>(&surface.shape))
      if (!is_closed(*plate, walls, scene.bodies[0].radius))
        return "there are walls with ends that a body could come around";
  }
  for (const GrainWall& wall : walls)
    if ((scene.periodic.x() > 0 && std::abs(wall.x) > 1e-12) ||
        (scene.periodic.y() > 0 && std::abs(wall.y) > 1e-12))
      return "there are walls where the plane repeats itself";
  if (!scene.confined && are_low(scene, walls))
    return "there are walls that a body could come over";
  return "";
}

}  // namespace slipcheck
