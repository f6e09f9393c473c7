#include "reference/events/surface_place.h"

#include <cmath>

namespace slipcheck {
namespace {

/// The course of a surface's matter along two axes of a plane.
SubstrateMotion course_along(const SurfaceMotion& motion, const Matrix3& axes) {
  const auto along = [&](const Vector2& v) -> Vector2 {
    return (axes.transpose() * (v.x() * motion.first() + v.y() * motion.second())).head<2>();
  };
  const SubstrateMotion& course = motion.course();
  switch (course.kind()) {
    case SubstrateMotion::Kind::still:
      break;
    case SubstrateMotion::Kind::constant:
      return SubstrateMotion::constant(along(course.vector()));
    case SubstrateMotion::Kind::oscillation:
      return SubstrateMotion::oscillation(along(course.vector()), course.frequency(),
                                          course.phase());
    case SubstrateMotion::Kind::table: {
      std::vector<SubstrateMotion::Point> points = course.points();
      for (SubstrateMotion::Point& point : points) point.position = along(point.position);
      return SubstrateMotion::table(std::move(points));
    }
  }
  return {};
}

bool is_along(const SurfaceMotion& motion, const Vector3& normal) {
  constexpr double kRightAngle = 1e-9;
  const Vector2& vector = motion.course().vector();
  const Vector3 way = vector.x() * motion.first() + vector.y() * motion.second();
  const bool table = motion.course().kind() == SubstrateMotion::Kind::table;
  return table ? std::abs(normal.dot(motion.first())) + std::abs(normal.dot(motion.second())) <=
                     kRightAngle
               : std::abs(normal.dot(way)) <= kRightAngle * way.norm();
}

}  // namespace

Matrix3 axes_about(const Vector3& normal) {
  if (normal == kUp) return Matrix3::Identity();
  Matrix3 axes;
  axes.col(2) = normal;
  axes.col(0) = normal.unitOrthogonal();
  axes.col(1) = normal.cross(axes.col(0));
  return axes;
}

SurfacePlace::SurfacePlace(const Surface& of, int touched_as, const Vector3& weight)
    : surface(of),
      touch(touched_as),
      bend(of.motion.is_belt() ? 0 : of.motion.course().largest_acceleration()) {
  const auto lay = [&](const Matrix3& along, const Vector3& through) {
    axes = along;
    origin = through;
    motion = course_along(surface.motion, along);
    const Vector3 local = along.transpose() * weight;
    gravity = -local.z();
    downhill = local.head<2>();
    carries = surface.motion.rate().isZero(0) && is_along(surface.motion, along.col(2));
  };
  if (const auto* plane = std::get_if<PlaneShape>(&surface.shape)) {
    lay(axes_about(plane->normal), plane->point);
  } else if (const auto* plate = std::get_if<RectangleShape>(&surface.shape)) {
    // That face which is above.
    Matrix3 face;
    face.col(0) = plate->half_length.normalized();
    face.col(1) = plate->half_width.normalized();
    face.col(2) = face.col(0).cross(face.col(1));
    if (face.col(2).dot(weight) > 0) face.rightCols<2>() *= -1;
    lay(face, plate->centre);
    half = {plate->half_length.norm(), plate->half_width.norm()};
    const bool stays = surface.motion.is_still() || surface.motion.is_belt();
    carries = carries && stays;
  }
  carries = carries && gravity > 0;
}

Vector3 SurfacePlace::velocity(double now, const Vector3& at) const {
  // What turns here turns in its place.
  if (surface.motion.is_belt() || !surface.motion.rate().isZero(0)) return Vector3::Zero();
  return surface.motion.velocity(now, at);
}

auto SurfacePlace::beside(double radius, const PathPoint& body, double now) const -> Beside {
  Beside found;
  found.near = surface.nearest(now, body.position);
  found.gap = found.near.distance - radius;
  found.opening = found.near.normal.dot(body.velocity - velocity(now, found.near.point));
  return found;
}

BodyState SurfacePlace::to_local(const BodyState& state) const {
  const Matrix3 back = axes.transpose();
  return {back * (state.position - origin), back * state.velocity, back * state.angular_velocity};
}

BodyState SurfacePlace::from_local(const BodyState& state) const {
  return {origin + axes * state.position, axes * state.velocity, axes * state.angular_velocity};
}

}  // namespace slipcheck
