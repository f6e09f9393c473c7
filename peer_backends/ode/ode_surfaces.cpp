#include "peer_backends/ode/ode_surfaces.h"

#include <variant>

#include "peer_backends/shared/surface_frame.h"

namespace slipcheck::ode {
namespace {

/// Of a plate, of its shorter side: ODE passes over boxes that have none.
constexpr double kThickness = 1e-12;

dGeomID geom_of(dSpaceID space, const PlaneShape& plane) {
  const Vector3& n = plane.normal;
  return dCreatePlane(space, n.x(), n.y(), n.z(), n.dot(plane.point));
}

dGeomID geom_of(dSpaceID space, const RectangleShape& plate) {
  const Vector3 half = peer::half_sizes(plate, kThickness);
  return dCreateBox(space, 2 * half.x(), 2 * half.y(), 2 * half.z());
}

dGeomID geom_of(dSpaceID space, const RodShape& rod) {
  return dCreateCylinder(space, rod.radius, (rod.end - rod.begin).norm());
}

dGeomID geom_of(dSpaceID space, const BallShape& ball) { return dCreateSphere(space, ball.radius); }

void lay_plane(dGeomID geom, const PlaneShape& plane, const SurfaceMotion& motion, double time) {
  const Vector3 n = motion.direction_now(time, plane.normal);
  dGeomPlaneSetParams(geom, n.x(), n.y(), n.z(), n.dot(motion.now(time, plane.point)));
}

void lay_frame(dGeomID geom, const peer::SurfaceFrame& frame) {
  const Vector3& at = frame.centre;
  dGeomSetPosition(geom, at.x(), at.y(), at.z());
  dMatrix3 rotation = {};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) rotation[4 * row + column] = frame.axes(row, column);
  dGeomSetRotation(geom, rotation);
}

}  // namespace

dGeomID make_geom(dSpaceID space, const SurfaceShape& shape) {
  return std::visit([&](const auto& each) { return geom_of(space, each); }, shape);
}

void lay(dGeomID geom, const Surface& surface, double time) {
  if (const auto* plane = std::get_if<PlaneShape>(&surface.shape))
    lay_plane(geom, *plane, surface.motion, time);
  else
    lay_frame(geom, peer::frame_at(surface, time));
}

}  // namespace slipcheck::ode
