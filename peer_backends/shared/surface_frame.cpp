#include "peer_backends/shared/surface_frame.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <variant>

namespace slipcheck::peer {
namespace {

/// Those of the scene where the third is its.
Matrix3 axes_about(const Vector3& third) {
  Matrix3 axes = Matrix3::Identity();
  if (third == Vector3::UnitZ()) return axes;
  axes.col(2) = third;
  axes.col(0) = third.unitOrthogonal();
  axes.col(1) = third.cross(axes.col(0));
  return axes;
}

SurfaceFrame at_rest(const PlaneShape& plane) { return {plane.point, axes_about(plane.normal)}; }

SurfaceFrame at_rest(const RectangleShape& plate) {
  SurfaceFrame frame{plate.centre};
  frame.axes.col(0) = plate.half_length.normalized();
  frame.axes.col(1) = plate.half_width.normalized();
  frame.axes.col(2) = plate.normal();
  return frame;
}

SurfaceFrame at_rest(const RodShape& rod) {
  return {0.5 * (rod.begin + rod.end), axes_about((rod.end - rod.begin).normalized())};
}

SurfaceFrame at_rest(const BallShape& ball) { return {ball.centre}; }

}  // namespace

SurfaceFrame frame_at(const slipcheck::Surface& surface, double time) {
  SurfaceFrame frame = std::visit([](const auto& shape) { return at_rest(shape); }, surface.shape);
  frame.centre = surface.motion.now(time, frame.centre);
  for (int k = 0; k < 3; ++k)
    frame.axes.col(k) = surface.motion.direction_now(time, frame.axes.col(k));
  return frame;
}

Vector3 half_sizes(const RectangleShape& plate, double thickness) {
  const double length = plate.half_length.norm(), width = plate.half_width.norm();
  return {length, width, thickness * std::min(length, width)};
}

}  // namespace slipcheck::peer
