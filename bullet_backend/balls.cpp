#include "bullet_backend/balls.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <btBulletDynamicsCommon.h>

#include "bullet_backend/convert.h"
#include "physics/solid.h"

namespace slipcheck::bullet {
namespace {

const Extent* extent_of(const Scene& scene, std::size_t body) {
  return scene.extents.empty() || !scene.extents[body] ? nullptr : &*scene.extents[body];
}

std::unique_ptr<btConvexShape> make_shape(const Scene& scene, std::size_t body) {
  const Extent* extent = extent_of(scene, body);
  if (!extent) return std::make_unique<btSphereShape>(btScalar(scene.bodies[body].radius));
  const btVector3 half = to_bullet(extent->size / 2);
  if (scene.bodies[body].shape == Shape::block) return std::make_unique<btBoxShape>(half);
  return std::make_unique<btCylinderShapeX>(half);
}

/// About the body's own axes; of a sphere whatever mass distribution the scene gives it.
btVector3 inertia_of(const Scene& scene, std::size_t body) {
  const Sphere& sphere = scene.bodies[body];
  if (const Extent* extent = extent_of(scene, body))
    return to_bullet(moments_of_inertia(sphere, *extent));
  const auto inertia = static_cast<btScalar>(sphere.moment_of_inertia());
  return btVector3(inertia, inertia, inertia);
}

/// From the body's own axes to the world's.
btQuaternion orientation_of(const Scene& scene, std::size_t body, const Eigen::Matrix3d& turn) {
  const Extent* extent = extent_of(scene, body);
  if (!extent) return btQuaternion::getIdentity();
  const Eigen::Quaterniond q(Eigen::Matrix3d(turn * turn_of(*extent).toRotationMatrix()));
  return {btScalar(q.x()), btScalar(q.y()), btScalar(q.z()), btScalar(q.w())};
}

/// What rigid bodies and multibodies have in common.
void set_up(btCollisionObject& object, int index, const BulletSettings& settings) {
  object.setUserIndex(index);
  object.setContactProcessingThreshold(btScalar(settings.contact_processing_threshold));
  if (!settings.sleeping) object.setActivationState(DISABLE_DEACTIVATION);
  if (settings.contact_stiffness > 0 && settings.contact_damping > 0)
    object.setContactStiffnessAndDamping(btScalar(settings.contact_stiffness),
                                         btScalar(settings.contact_damping));
  if (settings.friction_anchor)
    object.setCollisionFlags(object.getCollisionFlags() |
                             btCollisionObject::CF_HAS_FRICTION_ANCHOR);
}

class RigidBalls final : public Balls {
 public:
  RigidBalls(btDiscreteDynamicsWorld& world, const Scene& scene, std::span<const BodyState> states,
             const Eigen::Matrix3d& turn, const BulletSettings& settings)
      : world_(world) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const Sphere& sphere = scene.bodies[i];
      const auto radius = static_cast<btScalar>(sphere.radius);
      shapes_.push_back(make_shape(scene, i));
      btRigidBody::btRigidBodyConstructionInfo info(btScalar(sphere.mass), nullptr,
                                                    shapes_.back().get(), inertia_of(scene, i));
      info.m_startWorldTransform.setRotation(orientation_of(scene, i, turn));
      info.m_startWorldTransform.setOrigin(to_bullet(states[i].position));
      info.m_linearDamping = btScalar(settings.linear_damping);
      info.m_angularDamping = btScalar(settings.angular_damping);
      info.m_linearSleepingThreshold = btScalar(settings.linear_sleeping_threshold);
      info.m_angularSleepingThreshold = btScalar(settings.angular_sleeping_threshold);
      balls_.push_back(std::make_unique<btRigidBody>(info));
      btRigidBody& ball = *balls_.back();
      objects_.push_back(&ball);
      set_up(ball, static_cast<int>(i), settings);
      ball.setLinearVelocity(to_bullet(states[i].velocity));
      ball.setAngularVelocity(to_bullet(states[i].angular_velocity));
      ball.setCcdMotionThreshold(btScalar(settings.ccd_motion_threshold));
      ball.setCcdSweptSphereRadius(btScalar(settings.ccd_swept_radius) * radius);
      if (scene.box) {
        ball.setLinearFactor(btVector3(1, 0, 1));
        ball.setAngularFactor(btVector3(0, 1, 0));
      }
      world_.addRigidBody(&ball);
    }
  }
  ~RigidBalls() override {
    for (const auto& ball : balls_) world_.removeRigidBody(ball.get());
  }

  BodyState state(std::size_t body) const override {
    const btRigidBody& ball = *balls_[body];
    return {from_bullet(ball.getCenterOfMassPosition()), from_bullet(ball.getLinearVelocity()),
            from_bullet(ball.getAngularVelocity())};
  }

 private:
  btDiscreteDynamicsWorld& world_;
  std::vector<std::unique_ptr<btConvexShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> balls_;
};

class MultibodyBalls final : public Balls {
 public:
  MultibodyBalls(btMultiBodyDynamicsWorld& world, const Scene& scene,
                 std::span<const BodyState> states, const Eigen::Matrix3d& turn,
                 const BulletSettings& settings)
      : world_(world) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const Sphere& sphere = scene.bodies[i];
      const bool fixed_base = false;
      shapes_.push_back(make_shape(scene, i));
      balls_.push_back(std::make_unique<btMultiBody>(0, btScalar(sphere.mass), inertia_of(scene, i),
                                                     fixed_base, settings.sleeping));
      btMultiBody& ball = *balls_.back();
      ball.setLinearDamping(btScalar(settings.multibody_linear_damping));
      ball.setAngularDamping(btScalar(settings.multibody_angular_damping));
      ball.setMaxCoordinateVelocity(btScalar(settings.multibody_velocity_limit));
      ball.setSleepThreshold(btScalar(settings.multibody_sleeping_threshold));
      ball.setSleepTimeout(btScalar(settings.sleeping_time));
      ball.finalizeMultiDof();
      const btQuaternion orientation = orientation_of(scene, i, turn);
      ball.setBasePos(to_bullet(states[i].position));
      ball.setWorldToBaseRot(orientation.inverse());
      ball.setBaseVel(to_bullet(states[i].velocity));
      ball.setBaseOmega(to_bullet(states[i].angular_velocity));
      colliders_.push_back(std::make_unique<btMultiBodyLinkCollider>(&ball, -1));
      btMultiBodyLinkCollider& collider = *colliders_.back();
      objects_.push_back(&collider);
      collider.setCollisionShape(shapes_.back().get());
      btTransform place = btTransform::getIdentity();
      place.setOrigin(to_bullet(states[i].position));
      place.setRotation(orientation);
      collider.setWorldTransform(place);
      set_up(collider, static_cast<int>(i), settings);
      ball.setBaseCollider(&collider);
      world_.addCollisionObject(&collider, btBroadphaseProxy::DefaultFilter,
                                btBroadphaseProxy::AllFilter);
      world_.addMultiBody(&ball);
    }
  }
  ~MultibodyBalls() override {
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      world_.removeMultiBody(balls_[i].get());
      world_.removeCollisionObject(colliders_[i].get());
    }
  }

  BodyState state(std::size_t body) const override {
    const btMultiBody& ball = *balls_[body];
    return {from_bullet(ball.getBasePos()), from_bullet(ball.getBaseVel()),
            from_bullet(ball.getBaseOmega())};
  }

 private:
  btMultiBodyDynamicsWorld& world_;
  std::vector<std::unique_ptr<btConvexShape>> shapes_;
  std::vector<std::unique_ptr<btMultiBody>> balls_;
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;
};

}  // namespace

std::unique_ptr<Balls> make_balls(btDiscreteDynamicsWorld& world, const Scene& scene,
                                  std::span<const BodyState> states, const Eigen::Matrix3d& turn,
                                  const BulletSettings& settings) {
  if (settings.body == BodyKind::rigid)
    return std::make_unique<RigidBalls>(world, scene, states, turn, settings);
  return std::make_unique<MultibodyBalls>(static_cast<btMultiBodyDynamicsWorld&>(world), scene,
                                          states, turn, settings);
}

BodyState motion_of(const btCollisionObject& object) {
  BodyState state;
  if (const btRigidBody* body = btRigidBody::upcast(&object)) {
    state.velocity = from_bullet(body->getLinearVelocity());
    state.angular_velocity = from_bullet(body->getAngularVelocity());
  } else if (const auto* collider = btMultiBodyLinkCollider::upcast(&object)) {
    state.velocity = from_bullet(collider->m_multiBody->getBaseVel());
    state.angular_velocity = from_bullet(collider->m_multiBody->getBaseOmega());
  }
  return state;
}

}  // namespace slipcheck::bullet
