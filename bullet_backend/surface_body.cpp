#include "bullet_backend/surface_body.h"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <variant>

#include "bullet_backend/convert.h"

namespace slipcheck::bullet {
namespace {

/// A shape of Bullet's and where it lies in the scene's axes while its surface is at rest.
struct LaidShape {
  std::unique_ptr<btCollisionShape> shape;
  Vector3 origin;
  Matrix3 axes = Matrix3::Identity();
};

LaidShape laid(const PlaneShape& plane) {
  return {std::make_unique<btStaticPlaneShape>(to_bullet(plane.normal), btScalar(0)), plane.point};
}

LaidShape laid(const RectangleShape& plate) {
  auto hull = std::make_unique<btConvexHullShape>();
  hull->setMargin(0);
  for (const int along : {-1, 1})
    for (const int across : {-1, 1})
      hull->addPoint(to_bullet(along * plate.half_length + across * plate.half_width));
  return {std::move(hull), plate.centre};
}

LaidShape laid(const RodShape& rod) {
  const Vector3 whole = rod.end - rod.begin;
  const Vector3 half(rod.radius, rod.radius, 0.5 * whole.norm());
  auto cylinder = std::make_unique<btCylinderShapeZ>(to_bullet(half));
  cylinder->setMargin(0);
  Matrix3 axes;
  axes.col(2) = whole.normalized();
  axes.col(0) = axes.col(2).unitOrthogonal();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return {std::move(cylinder), 0.5 * (rod.begin + rod.end), axes};
}

LaidShape laid(const BallShape& ball) {
  return {std::make_unique<btSphereShape>(btScalar(ball.radius)), ball.centre};
}

btTransform transform_of(const Matrix3& axes, const Vector3& origin) {
  const auto at = [&](int row, int column) { return btScalar(axes(row, column)); };
  return btTransform(btMatrix3x3(at(0, 0), at(0, 1), at(0, 2), at(1, 0), at(1, 1), at(1, 2),
                                 at(2, 0), at(2, 1), at(2, 2)),
                     to_bullet(origin));
}

}  // namespace

struct SurfaceBody::Body {
  template <class Laid>
  explicit Body(Laid made)
      : shape(std::move(made.shape)),
        origin(made.origin),
        axes(made.axes),
        body(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, shape.get())) {}

  /// In the world at a time.
  btTransform place(const Surface& surface, const Matrix3& turn, double time) const {
    Matrix3 turned;
    for (int k = 0; k < 3; ++k)
      turned.col(k) = turn * surface.motion.direction_now(time, axes.col(k));
    return transform_of(turned, turn * surface.motion.now(time, origin));
  }

  std::unique_ptr<btCollisionShape> shape;
  Vector3 origin;  // in the scene's axes while the surface is at rest
  Matrix3 axes;
  btRigidBody body;
};

SurfaceBody::SurfaceBody(const Surface& surface, const WorldUnits& units,
                         const BulletSettings& settings, int index)
    : surface_(surface),
      turn_(units.turn),
      told_(settings.surface_velocity),
      body_(std::make_unique<Body>(
          std::visit([](const auto& shape) { return laid(shape); }, surface.shape))) {
  btRigidBody& body = body_->body;
  body.setUserIndex(index);
  body.setUserPointer(this);
  body.setContactProcessingThreshold(btScalar(settings.contact_processing_threshold));
  const btTransform place = body_->place(surface_, turn_, 0);
  body.setWorldTransform(place);
  body.setInterpolationWorldTransform(place);
  if (surface_.motion.is_still()) return;
  body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  body.setActivationState(DISABLE_DEACTIVATION);
}

SurfaceBody::~SurfaceBody() = default;

btRigidBody& SurfaceBody::body() const { return body_->body; }

Vector3 SurfaceBody::course_velocity(double time, double time_step) const {
  const SurfaceMotion& motion = surface_.motion;
  switch (told_) {
    case SurfaceVelocity::step_before:
      return (motion.way(time) - motion.way(time - time_step)) / time_step;
    case SurfaceVelocity::this_step:
      return (motion.way(time + time_step) - motion.way(time)) / time_step;
    case SurfaceVelocity::step_end:
      return motion.velocity(time + time_step, motion.pivot());
  }
  return Vector3::Zero();
}

void SurfaceBody::begin_step(double time, double time_step) {
  time_ = time;
  if (surface_.motion.is_still()) return;
  told_before_ = told_now_.value_or(turn_ * course_velocity(time - time_step, time_step));
  told_now_ = turn_ * course_velocity(time, time_step);
  const btTransform now = body_->place(surface_, turn_, time);
  btTransform then = body_->place(surface_, turn_, time - time_step);
  const Vector3 origin = from_bullet(now.getOrigin());
  then.setOrigin(to_bullet(origin - time_step * (*told_now_ + turning_at(origin))));
  body_->body.setWorldTransform(now);
  body_->body.setInterpolationWorldTransform(then);
}

void SurfaceBody::tell_velocity() const {
  if (is_still() || told_ == SurfaceVelocity::step_before) return;
  btRigidBody& body = body_->body;
  body.setLinearVelocity(
      to_bullet(told_velocity(from_bullet(body.getWorldTransform().getOrigin()))));
  body.setAngularVelocity(to_bullet(turn_ * surface_.motion.rate()));
}

NearestPoint SurfaceBody::nearest(double time, const Vector3& to) const {
  NearestPoint found = surface_.nearest(time, turn_.transpose() * to);
  found.point = turn_ * found.point;
  found.normal = turn_ * found.normal;
  return found;
}

Vector3 SurfaceBody::velocity(double time, const Vector3& at) const {
  return turn_ * surface_.motion.velocity(time, turn_.transpose() * at);
}

Vector3 SurfaceBody::turning_at(const Vector3& at) const {
  return turn_ * surface_.motion.rate().cross(turn_.transpose() * at - surface_.motion.pivot());
}

Vector3 SurfaceBody::told_velocity(const Vector3& at) const {
  return told_now_.value_or(Vector3::Zero()) + turning_at(at);
}

Vector3 SurfaceBody::told_before(const Vector3& at) const { return told_before_ + turning_at(at); }

double SurfaceBody::largest_speed(const Vector3& near) const {
  const SurfaceMotion& motion = surface_.motion;
  return motion.course().largest_speed() +
         motion.rate().norm() * (turn_.transpose() * near - motion.pivot()).norm();
}

}  // namespace slipcheck::bullet
