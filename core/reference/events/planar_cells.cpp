#include "reference/events/planar_cells.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace slipcheck {
namespace {

double largest_radius(const Scene& scene) {
  double most = 0;
  for (const Sphere& sphere : scene.bodies) most = std::max(most, sphere.radius);
  return most;
}

/// Width of a cell over the mean distance of bodies, so that looking around after collisions and
/// crossing borders cost least together (slipcheck_bench, an area fraction of 0.2).
constexpr double kOfMeanDistance = 0.85;

/// Cells in which there is about one body each.
struct CellPlan {
  double width_x, width_y;
  std::uint32_t nx, ny;
};

std::uint32_t at_least_four(double n) {
  return static_cast<std::uint32_t>(std::clamp(n, 4.0, 4096.0));
}

CellPlan plan_box(const Box& box, double gravity, std::span<const BodyState> initial,
                  double diameter) {
  const auto n = static_cast<double>(initial.size());
  // How high the bodies are: as they start, or as the floor throws them.
  double height = diameter;
  for (const BodyState& state : initial)
    height = std::max({height, state.position.z(),
                       gravity > 0 ? state.velocity.squaredNorm() / (2 * gravity) : 0});
  const double V = box.floor.largest_speed();
  if (gravity > 0) height = std::max(height, V * V / gravity);
  if (box.lid) height = std::min(height, *box.lid);
  const double edge = std::clamp(std::sqrt(box.width * height / n), diameter, 8 * diameter);
  const double columns = std::max(1.0, std::floor(box.width / edge));
  return {box.width / columns, edge, at_least_four(columns), at_least_four(4 * n / columns)};
}

CellPlan plan_plane(const Vector2& period, std::span<const BodyState> initial, double diameter) {
  const auto n = static_cast<double>(initial.size());
  Vector2 least = initial.front().position.head<2>(), most = least;
  for (const BodyState& state : initial) {
    least = least.cwiseMin(state.position.head<2>());
    most = most.cwiseMax(state.position.head<2>());
  }
  const Vector2 extent = (most - least).cwiseMax(Vector2::Constant(diameter));
  const double across = period.x() > 0 ? period.x() : extent.x();
  const double along = period.y() > 0 ? period.y() : extent.y();
  const double edge = std::max(diameter, kOfMeanDistance * std::sqrt(across * along / n));
  const auto direction = [&](double length) {
    const std::uint32_t cells = at_least_four(std::min(
        length > 0 ? length / edge : std::sqrt(2 * n), length > 0 ? length / diameter : 4096.0));
    return std::pair{length > 0 ? length / cells : edge, cells};
  };
  const auto [width_x, nx] = direction(period.x());
  const auto [width_y, ny] = direction(period.y());
  return {width_x, width_y, nx, ny};
}

}  // namespace

CellGrid planar_cells(const Scene& scene, std::span<const BodyState> initial) {
  const double diameter = 2 * largest_radius(scene) * (1 + 1e-9);
  const CellPlan plan = scene.box ? plan_box(*scene.box, scene.gravity, initial, diameter)
                                  : plan_plane(scene.periodic, initial, diameter);
  return {initial.size(),
          plan.width_x,
          plan.width_y,
          plan.nx,
          plan.ny,
          !scene.box && scene.periodic.x() > 0,
          !scene.box && scene.periodic.y() > 0};
}

std::uint64_t morton_number(std::uint32_t x, std::uint32_t y) {
  const auto spread = [](std::uint64_t v) {
    v = (v | (v << 16)) & 0x0000FFFF0000FFFF;
    v = (v | (v << 8)) & 0x00FF00FF00FF00FF;
    v = (v | (v << 4)) & 0x0F0F0F0F0F0F0F0F;
    v = (v | (v << 2)) & 0x3333333333333333;
    return (v | (v << 1)) & 0x5555555555555555;
  };
  return spread(x) | (spread(y) << 1);
}

}  // namespace slipcheck
