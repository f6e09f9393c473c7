#include "bullet_backend/vertical_plane.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace slipcheck::bullet {
namespace {

constexpr double kRounding = 1e-13;  // of the largest of its kind

/// Horizontal vectors of one kind, which have to be parallel to those of all others.
using Vectors = std::vector<Vector2>;

Vector2 largest_of(const Vectors& vectors) {
  Vector2 largest = Vector2::Zero();
  for (const Vector2& vector : vectors)
    if (vector.squaredNorm() > largest.squaredNorm()) largest = vector;
  return largest;
}

double across(const Vector2& vector, const Vector2& line) {
  return std::abs(vector.x() * line.y() - vector.y() * line.x());
}

Vectors of_substrate(const SubstrateMotion& motion) {
  Vectors vectors = {motion.vector()};
  for (const SubstrateMotion::Point& point : motion.points())
    vectors.push_back(point.position - motion.points().front().position);
  return vectors;
}

}  // namespace

std::optional<Vector2> line_of_motion(const Scene& scene, std::span<const BodyState> states) {
  Vectors ways, velocities, spins;
  double upright = 0, spin = 0;
  for (const BodyState& state : states) {
    ways.push_back((state.position - states.front().position).head<2>());
    velocities.push_back(state.velocity.head<2>());
    const Vector3& omega = state.angular_velocity;
    spins.emplace_back(omega.y(), -omega.x());
    upright = std::max(upright, std::abs(omega.z()));
    spin = std::max(spin, omega.norm());
  }
  if (!(upright <= kRounding * spin)) return std::nullopt;
  const Vectors kinds[] = {ways, velocities, spins, {scene.downhill}, of_substrate(scene.motion)};
  Vector2 line = Vector2::Zero();
  for (const Vectors& kind : kinds) {
    const Vector2 largest = largest_of(kind);
    if (line == Vector2::Zero() && largest != Vector2::Zero()) line = largest.normalized();
  }
  if (line == Vector2::Zero()) line = Vector2::UnitY();
  for (const Vectors& kind : kinds) {
    const double limit = kRounding * largest_of(kind).norm();
    for (const Vector2& vector : kind)
      if (!(across(vector, line) <= limit)) return std::nullopt;
  }
  return line;
}

}  // namespace slipcheck::bullet
