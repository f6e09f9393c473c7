#include "bullet_backend/combine.h"

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>

#include "bullet_backend/coefficients.h"

namespace slipcheck::bullet {
namespace {

/// The two bodies of a contact, a ball first.
struct Pair {
  const btRigidBody* ball;
  const btRigidBody* other;
  const PairCoefficients& coefficients;

  int body_index() const { return ball->getUserIndex(); }
  int other_index() const { return other->getUserIndex(); }
};

Pair identify(const btCollisionObject* first, const btCollisionObject* second) {
  if (first->getUserIndex() < 0) std::swap(first, second);
  return {btRigidBody::upcast(first), btRigidBody::upcast(second),
          *static_cast<const PairCoefficients*>(first->getUserPointer())};
}

btScalar friction(const btCollisionObject* first, const btCollisionObject* second) {
  const Pair pair = identify(first, second);
  return btScalar(pair.coefficients.friction(pair.body_index(), pair.other_index()));
}

btScalar restitution(const btCollisionObject* first, const btCollisionObject* second) {
  const Pair pair = identify(first, second);
  btVector3 normal(0, 0, 1);
  if (pair.other_index() == kWall) {
    normal = btVector3(1, 0, 0);
  } else if (pair.other_index() >= 0) {
    normal = pair.ball->getCenterOfMassPosition() - pair.other->getCenterOfMassPosition();
    normal.safeNormalize();
  }
  const btVector3 velocity = pair.ball->getLinearVelocity() - pair.other->getLinearVelocity();
  const double approach_speed = std::abs(double(velocity.dot(normal)));
  return btScalar(
      pair.coefficients.restitution(pair.body_index(), pair.other_index(), approach_speed));
}

btScalar rolling_friction(const btCollisionObject* first, const btCollisionObject* second) {
  const Pair pair = identify(first, second);
  const btVector3& velocity = pair.ball->getLinearVelocity();
  const double speed = std::hypot(double(velocity.x()), double(velocity.y()));
  return btScalar(pair.coefficients.rolling_friction(pair.body_index(), pair.other_index(), speed));
}

btScalar spinning_friction(const btCollisionObject* first, const btCollisionObject* second) {
  const Pair pair = identify(first, second);
  return btScalar(pair.coefficients.spinning_friction(pair.body_index(), pair.other_index()));
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
