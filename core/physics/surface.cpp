#include "physics/surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace slipcheck {
namespace {

/// Between points that differ; at one point there is no direction but the given one.
NearestPoint from(const Vector3& point, const Vector3& to, const Vector3& otherwise) {
  const Vector3 way = to - point;
  const double distance = way.norm();
  return {point, distance > 0 ? Vector3(way / distance) : otherwise, distance};
}

NearestPoint nearest(const PlaneShape& plane, const Vector3& to) {
  const double height = plane.normal.dot(to - plane.point);
  return {to - height * plane.normal, plane.normal, height};
}

NearestPoint nearest(const RectangleShape& plate, const Vector3& to) {
  const Vector3 way = to - plate.centre;
  const auto part = [&](const Vector3& half) {
    return std::clamp(way.dot(half) / half.squaredNorm(), -1.0, 1.0);
  };
  return from(plate.centre + part(plate.half_length) * plate.half_length +
                  part(plate.half_width) * plate.half_width,
              to, plate.normal());
}

NearestPoint nearest(const RodShape& rod, const Vector3& to) {
  const Vector3 whole = rod.end - rod.begin;
  const double length = whole.norm();
  const Vector3 axis = whole / length;
  const double along = axis.dot(to - rod.begin);
  const Vector3 across = to - rod.begin - along * axis;
  const double off = across.norm();
  const Vector3 outward = off > 0 ? Vector3(across / off) : axis.unitOrthogonal();
  const double beyond = std::max(-along, along - length);  // of the nearer end
  const Vector3 end_normal = along > 0.5 * length ? axis : Vector3(-axis);
  if (beyond <= 0 && off - rod.radius >= beyond)
    return {rod.begin + along * axis + rod.radius * outward, outward, off - rod.radius};
  if (off <= rod.radius) return {to - beyond * end_normal, end_normal, beyond};
  const double to_end = std::clamp(along, 0.0, length);
  return from(rod.begin + to_end * axis + rod.radius * outward, to, outward);
}

NearestPoint nearest(const BallShape& ball, const Vector3& to) {
  const Vector3 way = to - ball.centre;
  const double off = way.norm();
  const Vector3 outward = off > 0 ? Vector3(way / off) : kUp;
  return {ball.centre + ball.radius * outward, outward, off - ball.radius};
}

}  // namespace

NearestPoint nearest_point(const SurfaceShape& shape, const Vector3& to) {
  return std::visit([&](const auto& each) { return nearest(each, to); }, shape);
}

SurfaceMotion SurfaceMotion::moving(SubstrateMotion course, const Vector3& first,
                                    const Vector3& second) {
  SurfaceMotion made;
  made.course_ = std::move(course);
  made.first_ = first;
  made.second_ = second;
  return made;
}

SurfaceMotion SurfaceMotion::belt(SubstrateMotion course, const Vector3& first,
                                  const Vector3& second) {
  SurfaceMotion made = moving(std::move(course), first, second);
  made.belt_ = true;
  return made;
}

SurfaceMotion SurfaceMotion::turning(const Vector3& pivot, const Vector3& rate) {
  SurfaceMotion made;
  made.pivot_ = pivot;
  made.rate_ = rate;
  return made;
}

Vector3 SurfaceMotion::turned(double angle, const Vector3& v) const {
  return Eigen::AngleAxisd(angle, rate_.normalized()) * v;
}

Vector3 SurfaceMotion::velocity(double t, const Vector3& at) const {
  return along(course_.velocity(t)) + rate_.cross(at - pivot_);
}

Vector3 SurfaceMotion::at_rest(double t, const Vector3& now) const {
  if (is_still() || belt_) return now;
  if (rate_.isZero(0)) return now - along(course_.position(t));
  return pivot_ + turned(-rate_.norm() * t, now - pivot_);
}

Vector3 SurfaceMotion::now(double t, const Vector3& at_rest) const {
  if (is_still() || belt_) return at_rest;
  if (rate_.isZero(0)) return at_rest + along(course_.position(t));
  return pivot_ + turned(rate_.norm() * t, at_rest - pivot_);
}

Vector3 SurfaceMotion::direction_now(double t, const Vector3& at_rest) const {
  return rate_.isZero(0) ? at_rest : turned(rate_.norm() * t, at_rest);
}

NearestPoint Surface::nearest(double t, const Vector3& to) const {
  if (motion.is_still()) return nearest_point(shape, to);
  NearestPoint found = nearest_point(shape, motion.at_rest(t, to));
  found.point = motion.now(t, found.point);
  found.normal = motion.direction_now(t, found.normal);
  return found;
}

}  // namespace slipcheck
