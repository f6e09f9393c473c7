#include "bullet_backend/surfaces.h"

#include <btBulletDynamicsCommon.h>

#include "bullet_backend/coefficients.h"

namespace slipcheck::bullet {
namespace {

/// Tells Bullet where the floor is.
class FloorMotion final : public btMotionState {
 public:
  FloorMotion(const ShakenFloor& floor, double time) : floor_(floor), time_(time) {}

  void set_time(double time) { time_ = time; }

  btTransform at(double time) const {
    return btTransform(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(floor_.height(time))));
  }
  void getWorldTransform(btTransform& transform) const override { transform = at(time_); }
  void setWorldTransform(const btTransform&) override {}  // nothing moves it but itself

 private:
  ShakenFloor floor_;
  double time_;
};

}  // namespace

struct Surfaces::Parts {
  struct Surface {
    Surface(const btVector3& normal, double offset, btMotionState* motion)
        : shape(normal, btScalar(offset)),
          body(btRigidBody::btRigidBodyConstructionInfo(0, motion, &shape)) {}
    btStaticPlaneShape shape;
    btRigidBody body;
  };

  Parts(const HardScene& scene, double time)
      : motion(scene.box ? scene.box->floor : ShakenFloor{}, time) {}

  FloorMotion motion;
  std::vector<std::unique_ptr<Surface>> surfaces;
};

Surfaces::Surfaces(btDiscreteDynamicsWorld& world, const HardScene& scene, double time,
                   double time_step)
    : world_(world), parts_(std::make_unique<Parts>(scene, time)) {
  // Half-spaces normal·r <= offset.
  const auto add = [&](const btVector3& normal, double offset, int index, bool shaken) {
    FloorMotion* motion = shaken ? &parts_->motion : nullptr;
    parts_->surfaces.push_back(std::make_unique<Parts::Surface>(normal, offset, motion));
    btRigidBody& body = parts_->surfaces.back()->body;
    body.setUserIndex(index);
    if (shaken) {
      body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
      body.setActivationState(DISABLE_DEACTIVATION);
      // So that it has its velocity in the first step too.
      body.setInterpolationWorldTransform(motion->at(time - time_step));
    }
    world.addRigidBody(&body);
    bodies_.push_back(&body);
  };
  const bool shaken = scene.box && !scene.box->floor.is_still();
  add(btVector3(0, 0, 1), 0, kFloor, shaken);
  if (!scene.box) return;
  const Box& box = *scene.box;
  const bool with_walls = shaken && box.moving_walls;
  add(btVector3(1, 0, 0), 0, kWall, with_walls);
  add(btVector3(-1, 0, 0), -box.width, kWall, with_walls);
  if (box.lid) add(btVector3(0, 0, -1), -*box.lid, kLid, with_walls);
}

Surfaces::~Surfaces() {
  for (btRigidBody* body : bodies_) world_.removeRigidBody(body);
}

void Surfaces::set_time(double time) { parts_->motion.set_time(time); }

}  // namespace slipcheck::bullet
