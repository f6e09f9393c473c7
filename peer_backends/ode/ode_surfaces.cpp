#include "peer_backends/ode/ode_surfaces.h"

#include <algorithm>
#include <variant>

namespace slipcheck::ode {
namespace {

/// Of a plate, of its shorter side: ODE passes over boxes that have none.
constexpr double kThickness = 1e-12;

dGeomID geom_of(dSpaceID space, const PlaneShape& plane) {
  const Vector3& n = plane.normal;
  return dCreatePlane(space, n.x(), n.y(), n.z(), n.dot(plane.point));
}

dGeomID geom_of(dSpaceID space, const RectangleShape& plate) {
  const double length = 2 * plate.half_length.norm(), width = 2 * plate.half_width.norm();
  return dCreateBox(space, length, width, kThickness * std::min(length, width));
}

dGeomID geom_of(dSpaceID space, const RodShape& rod) {
  return dCreateCylinder(space, rod.radius, (rod.end - rod.begin).norm());
}

dGeomID geom_of(dSpaceID space, const BallShape& ball) { return dCreateSphere(space, ball.radius); }

/// Where a geom's own centre and axes are while its surface is at rest; the third is a plate's
/// normal and a cylinder's axis.
struct Frame3 {
  Vector3 centre;
  Matrix3 axes = Matrix3::Identity();
};

Frame3 frame_of(const RectangleShape& plate) {
  Frame3 frame{plate.centre};
  frame.axes.col(0) = plate.half_length.normalized();
  frame.axes.col(1) = plate.half_width.normalized();
  frame.axes.col(2) = plate.normal();
  return frame;
}

Frame3 frame_of(const RodShape& rod) {
  Frame3 frame{0.5 * (rod.begin + rod.end)};
  frame.axes.col(2) = (rod.end - rod.begin).normalized();
  frame.axes.col(0) = frame.axes.col(2).unitOrthogonal();
  frame.axes.col(1) = frame.axes.col(2).cross(frame.axes.col(0));
  return frame;
}

Frame3 frame_of(const BallShape& ball) { return {ball.centre}; }

void lay_plane(dGeomID geom, const PlaneShape& plane, const SurfaceMotion& motion, double time) {
  const Vector3 n = motion.direction_now(time, plane.normal);
  dGeomPlaneSetParams(geom, n.x(), n.y(), n.z(), n.dot(motion.now(time, plane.point)));
}

void lay_frame(dGeomID geom, const Frame3& frame, const SurfaceMotion& motion, double time) {
  const Vector3 at = motion.now(time, frame.centre);
  dGeomSetPosition(geom, at.x(), at.y(), at.z());
  dMatrix3 rotation = {};
  for (int column = 0; column < 3; ++column) {
    const Vector3 axis = motion.direction_now(time, frame.axes.col(column));
    for (int row = 0; row < 3; ++row) rotation[4 * row + column] = axis[row];
  }
  dGeomSetRotation(geom, rotation);
}

}  // namespace

dGeomID make_geom(dSpaceID space, const SurfaceShape& shape) {
  return std::visit([&](const auto& each) { return geom_of(space, each); }, shape);
}

void lay(dGeomID geom, const Surface& surface, double time) {
  if (const auto* plane = std::get_if<PlaneShape>(&surface.shape))
    lay_plane(geom, *plane, surface.motion, time);
  else if (const auto* plate = std::get_if<RectangleShape>(&surface.shape))
    lay_frame(geom, frame_of(*plate), surface.motion, time);
  else if (const auto* rod = std::get_if<RodShape>(&surface.shape))
    lay_frame(geom, frame_of(*rod), surface.motion, time);
  else
    lay_frame(geom, frame_of(std::get<BallShape>(surface.shape)), surface.motion, time);
}

}  // namespace slipcheck::ode
