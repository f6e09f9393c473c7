#include "bullet_backend/image_contacts.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <btBulletCollisionCommon.h>

#include "bullet_backend/convert.h"

namespace slipcheck::bullet {
namespace {

double radius_of(const btCollisionObject& ball) {
  return static_cast<const btSphereShape*>(ball.getCollisionShape())->getRadius();
}

Vector3 centre_of(const btCollisionObject& ball) {
  return from_bullet(ball.getWorldTransform().getOrigin());
}

}  // namespace

ImageContacts::ImageContacts(const PeriodicCell& cell, btCollisionDispatcher& dispatcher)
    : cell_(&cell), dispatcher_(&dispatcher), near_(cell) {}

ImageContacts::~ImageContacts() { clear(); }

void ImageContacts::clear() {
  for (btCollisionAlgorithm* algorithm : algorithms_) {
    algorithm->~btCollisionAlgorithm();
    dispatcher_->freeCollisionAlgorithm(algorithm);
  }
  algorithms_.clear();
}

void ImageContacts::find(const std::vector<btCollisionObject*>& balls,
                         const btDispatcherInfo& info) {
  clear();
  near_.clear();
  for (const btCollisionObject* ball : balls)
    near_.add(centre_of(*ball), Vector3::Zero(), radius_of(*ball));
  near_.for_each([&](std::size_t i, std::size_t j) {
    btCollisionObject &first = *balls[std::min(i, j)], &second = *balls[std::max(i, j)];
    const Vector3 apart = centre_of(first) - centre_of(second);
    const Vector3 shift = cell_->shift(apart);
    if (shift.isZero(0)) return;  // Bullet's own
    const double reach = radius_of(first) + radius_of(second);
    if ((apart - shift).squaredNorm() > reach * reach) return;
    touch(first, second, shift, info);
  });
}

void ImageContacts::touch(btCollisionObject& first, btCollisionObject& second, const Vector3& shift,
                          const btDispatcherInfo& info) {
  const btTransform& there = second.getWorldTransform();
  btTransform image = there;
  image.setOrigin(there.getOrigin() + to_bullet(shift));
  const btCollisionObjectWrapper a(nullptr, first.getCollisionShape(), &first,
                                   first.getWorldTransform(), -1, -1);
  const btCollisionObjectWrapper b(nullptr, second.getCollisionShape(), &second, image, -1, -1);
  btCollisionAlgorithm* algorithm =
      dispatcher_->findAlgorithm(&a, &b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
  algorithms_.push_back(algorithm);
  btManifoldResult result(&a, &b);
  algorithm->processCollision(&a, &b, info, &result);
  btPersistentManifold& manifold = *result.getPersistentManifold();
  const bool in_order = manifold.getBody0() == &first;
  for (int k = 0; k < manifold.getNumContacts(); ++k) {
    btManifoldPoint& point = manifold.getContactPoint(k);
    btVector3& place = in_order ? point.m_positionWorldOnB : point.m_positionWorldOnA;
    place -= to_bullet(shift);
    (in_order ? point.m_localPointB : point.m_localPointA) = there.invXform(place);
  }
}

}  // namespace slipcheck::bullet
