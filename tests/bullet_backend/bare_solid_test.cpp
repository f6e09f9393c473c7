// Blocks and cylinders against a world that is made by Bullet's own functions alone.

#include <btBulletDynamicsCommon.h>
#include <gtest/gtest.h>

#include <memory>

#include "bullet_backend/bullet_world.h"
#include "bullet_backend/combine.h"
#include "scene/scene.h"

namespace slipcheck::bullet {
namespace {

constexpr double kStep = 1.0 / 240;

/// A body of 0.2 m × 0.1 m × 0.05 m, or the cylinder in it that lies along x, on a plane.
Scene solid_scene(Shape shape, const BodyState& start) {
  Scene scene;
  const double height = shape == Shape::block ? 0.05 : 0.1;
  const double q = shape == Shape::block ? (0.04 + 0.01) / (12 * 0.025 * 0.025) : 0.5;
  scene.bodies = {{height / 2, 0.7, q, shape}};
  scene.extents = {Extent{{0.2, 0.1, height}, Vector2::UnitX()}};
  scene.initial = {start};
  scene.initial[0].position.z() = height / 2;
  scene.material = {0};
  SubstrateContact ground;
  ground.static_friction = ground.kinetic_friction = 0.3;
  scene.substrate = {ground};
  scene.pairs = {{}};
  scene.gravity = 9.81;
  return scene;
}

/// The same in Bullet as shipped; friction 1 of the plane, as coefficients are multiplied.
class BareWorld {
 public:
  explicit BareWorld(const Scene& scene) {
    const bool is_block = scene.bodies[0].shape == Shape::block;
    if (is_block)
      shape_ = std::make_unique<btBoxShape>(btVector3(0.1, 0.05, 0.025));
    else
      shape_ = std::make_unique<btCylinderShapeX>(btVector3(0.1, 0.05, 0.05));
    const double m = 0.7;
    const btVector3 inertia =
        is_block ? m / 12 * btVector3(0.01 + 0.0025, 0.04 + 0.0025, 0.04 + 0.01)
                 : m * btVector3(0.0025 / 2, 0.0025 / 4 + 0.04 / 12, 0.0025 / 4 + 0.04 / 12);
    body_ = std::make_unique<btRigidBody>(
        btRigidBody::btRigidBodyConstructionInfo(m, nullptr, shape_.get(), inertia));
    const BodyState& start = scene.initial[0];
    btTransform place = btTransform::getIdentity();
    place.setOrigin(btVector3(0, 0, start.position.z()));
    body_->setCenterOfMassTransform(place);
    body_->setLinearVelocity(btVector3(start.velocity.x(), start.velocity.y(), start.velocity.z()));
    body_->setFriction(0.3);
    body_->setActivationState(DISABLE_DEACTIVATION);
    plane_.setFriction(1);
    world_.setGravity(btVector3(0, 0, -9.81));
    world_.addRigidBody(&plane_);
    world_.addRigidBody(body_.get());
  }
  ~BareWorld() {
    world_.removeRigidBody(body_.get());
    world_.removeRigidBody(&plane_);
  }
  void step() { world_.stepSimulation(kStep, 0); }
  Vector3 position() const {
    const btVector3& x = body_->getCenterOfMassPosition();
    return {x.x(), x.y(), x.z()};
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btStaticPlaneShape half_space_{btVector3(0, 0, 1), 0};
  btRigidBody plane_{btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &half_space_)};
  std::unique_ptr<btConvexShape> shape_;
  std::unique_ptr<btRigidBody> body_;
};

class BareSolid : public testing::TestWithParam<Shape> {};

TEST_P(BareSolid, MovesAsInAWorldOfBulletsOwnFunctions) {
  BodyState start;
  start.velocity = GetParam() == Shape::block ? Vector3(2, 0, 0) : Vector3(0, 2, 0);
  const Scene scene = solid_scene(GetParam(), start);
  BulletWorld ours(scene, {}, kStep, scene.initial, 0);
  std::vector<Vector3> seen;
  Frame frame;
  for (int k = 0; k < 240; ++k) {
    ours.step();
    ours.read(frame);
    seen.push_back(frame.bodies[0].position);
  }
  combine_as_shipped();
  BareWorld bare(scene);
  for (const Vector3& ours_at : seen) {
    bare.step();
    // Rounding of the moments of inertia, which contacts amplify.
    ASSERT_LT((ours_at - bare.position()).norm(), 1e-9);
  }
  EXPECT_GT(seen.back().norm(), 0.5);
}

INSTANTIATE_TEST_SUITE_P(Shapes, BareSolid, testing::Values(Shape::block, Shape::cylinder));

}  // namespace
}  // namespace slipcheck::bullet
