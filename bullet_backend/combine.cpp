#include "bullet_backend/combine.h"

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bullet_backend/balls.h"
#include "bullet_backend/coefficients.h"
#include "bullet_backend/convert.h"
#include "bullet_backend/surface_body.h"

namespace slipcheck::bullet {
namespace {

/// The two bodies of a contact, a ball first.
struct Pair {
  const btCollisionObject* ball;
  const btCollisionObject* other;
  const PairCoefficients& coefficients;

  int body() const { return ball->getUserIndex(); }
  int other_index() const { return other->getUserIndex(); }
  const BodyFields* fixed() const { return coefficients.fixed(body(), other_index()); }
};

Pair identify(const btCollisionObject* first, const btCollisionObject* second) {
  if (first->getUserIndex() < 0) std::swap(first, second);
  return {first, second, *static_cast<const PairCoefficients*>(first->getUserPointer())};
}

/// A surface beside the substrate; null for all else.
const SurfaceBody* surface_of(const Pair& pair) {
  if (pair.other_index() >= kSubstrate) return nullptr;
  return static_cast<const SurfaceBody*>(pair.other->getUserPointer());
}

Vector3 centre_of(const Pair& pair) {
  return from_bullet(pair.ball->getWorldTransform().getOrigin());
}

/// Of a plane or surface, or along the line of centres.
Vector3 normal_of(const Pair& pair) {
  if (const SurfaceBody* surface = surface_of(pair))
    return surface->nearest_now(centre_of(pair)).normal;
  if (pair.other_index() < 0) {
    const auto* plane = static_cast<const btStaticPlaneShape*>(pair.other->getCollisionShape());
    return from_bullet(plane->getPlaneNormal());
  }
  const Vector3 line = centre_of(pair) - from_bullet(pair.other->getWorldTransform().getOrigin());
  return (line - pair.coefficients.cell().shift(line)).normalized();
}

/// How a ball moves over a plane or surface.
struct OverPlane {
  double speed;       ///< of its centre
  double slip_speed;  ///< of the point that touches
  double onto;        ///< gravity towards the plane, >= 0
};

OverPlane over_plane(const Pair& pair) {
  const Vector3 n = normal_of(pair);
  const Sphere& body = pair.coefficients.body(pair.body());
  const BodyState ball = motion_of(*pair.ball);
  const SurfaceBody* surface = surface_of(pair);
  const Vector3 ground = surface ? surface->told_before(surface->nearest_now(centre_of(pair)).point)
                                 : pair.coefficients.ground_velocity();
  Vector3 v = ball.velocity - ground;
  v -= v.dot(n) * n;
  const double lever = body.shape == Shape::block ? 0 : body.radius;
  const Vector3 u = v - lever * ball.angular_velocity.cross(n);
  return {v.norm(), u.norm(), std::max(0.0, -n.dot(pair.coefficients.gravity()))};
}

/// Of the two surfaces on each other.
double slip_speed_of(const Pair& pair) {
  if (pair.other_index() < 0) return over_plane(pair).slip_speed;
  const Vector3 n = normal_of(pair);
  const BodyState a = motion_of(*pair.ball), b = motion_of(*pair.other);
  const double r_a = pair.coefficients.body(pair.body()).radius;
  const double r_b = pair.coefficients.body(pair.other_index()).radius;
  const Vector3 u =
      a.velocity - b.velocity - (r_a * a.angular_velocity + r_b * b.angular_velocity).cross(n);
  return (u - u.dot(n) * n).norm();
}

bool slips(const Pair& pair, const OverPlane& motion) {
  if (!surface_of(pair)) return pair.coefficients.slips(pair.body(), motion.slip_speed);
  return pair.coefficients.slips(pair.body(), pair.other_index(), motion.slip_speed, motion.onto);
}

bool slips(const Pair& pair) { return pair.other_index() < 0 && slips(pair, over_plane(pair)); }

double restitution_on(const Pair& pair, const SurfaceBody& surface) {
  const NearestPoint near = surface.nearest_now(centre_of(pair));
  const Vector3 velocity = motion_of(*pair.ball).velocity - surface.told_velocity(near.point);
  return pair.coefficients.restitution(pair.body(), pair.other_index(),
                                       std::abs(velocity.dot(near.normal)),
                                       -near.normal.dot(pair.coefficients.gravity()));
}

btScalar friction(const btCollisionObject* first, const btCollisionObject* second) {
  const Pair pair = identify(first, second);
  if (const BodyFields* fixed = pair.fixed()) return btScalar(fixed->friction);
  const bool law = pair.coefficients.has_friction_law(pair.body(), pair.other_index());
  return btScalar(pair.coefficients.friction(pair.body(), pair.other_index(), slips(pair),
                                             law ? slip_speed_of(pair) : 0));
}

btScalar restitution(const btCollisionObject* first, const btCollisionObject* second) {
  const Pair pair = identify(first, second);
  if (const BodyFields* fixed = pair.fixed()) return btScalar(fixed->restitution);
  if (const SurfaceBody* surface = surface_of(pair))
    return btScalar(restitution_on(pair, *surface));
  const Vector3 velocity = motion_of(*pair.ball).velocity - motion_of(*pair.other).velocity;
  const double approach_speed = std::abs(velocity.dot(normal_of(pair)));
  return btScalar(pair.coefficients.restitution(pair.body(), pair.other_index(), approach_speed));
}

btScalar rolling_friction(const btCollisionObject* first, const btCollisionObject* second) {
  const Pair pair = identify(first, second);
  if (const BodyFields* fixed = pair.fixed()) return btScalar(fixed->rolling_friction);
  if (pair.other_index() >= 0) return 0;
  const OverPlane motion = over_plane(pair);
  return btScalar(pair.coefficients.rolling_friction(pair.body(), pair.other_index(), motion.speed,
                                                     slips(pair, motion)));
}

btScalar spinning_friction(const btCollisionObject* first, const btCollisionObject* second) {
  const Pair pair = identify(first, second);
  if (const BodyFields* fixed = pair.fixed()) return btScalar(fixed->spinning_friction);
  return btScalar(pair.coefficients.spinning_friction(pair.body(), pair.other_index()));
}

}  // namespace

void combine_by_pair() {
  gCalculateCombinedFrictionCallback = friction;
  gCalculateCombinedRestitutionCallback = restitution;
  gCalculateCombinedRollingFrictionCallback = rolling_friction;
  gCalculateCombinedSpinningFrictionCallback = spinning_friction;
}

void combine_as_shipped() {
  gCalculateCombinedFrictionCallback = btManifoldResult::calculateCombinedFriction;
  gCalculateCombinedRestitutionCallback = btManifoldResult::calculateCombinedRestitution;
  gCalculateCombinedRollingFrictionCallback = btManifoldResult::calculateCombinedRollingFriction;
  gCalculateCombinedSpinningFrictionCallback = btManifoldResult::calculateCombinedSpinningFriction;
}

}  // namespace slipcheck::bullet
