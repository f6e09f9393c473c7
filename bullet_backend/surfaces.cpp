#include "bullet_backend/surfaces.h"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <optional>

#include "bullet_backend/coefficients.h"
#include "bullet_backend/convert.h"

namespace slipcheck::bullet {

struct Surfaces::Parts {
  struct Surface {
    Surface(const btVector3& normal, btScalar offset)
        : shape(normal, offset),
          body(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &shape)) {}
    btStaticPlaneShape shape;
    btRigidBody body;
  };

  SubstrateMotion motion;
  ShakenFloor floor;
  Eigen::Matrix3d turn;
  SurfaceVelocity told;
  std::vector<std::unique_ptr<Surface>> surfaces;
  std::vector<btRigidBody*> moving;
  std::optional<Vector3> told_now;
  Vector3 told_before = Vector3::Zero();

  Vector3 position(double t) const { return motion.position(t) + Vector3(0, 0, floor.height(t)); }
  Vector3 velocity(double t, double dt) const {
    switch (told) {
      case SurfaceVelocity::step_before:
        return (position(t) - position(t - dt)) / dt;
      case SurfaceVelocity::this_step:
        return (position(t + dt) - position(t)) / dt;
      case SurfaceVelocity::step_end:
        return motion.velocity(t + dt) + Vector3(0, 0, floor.velocity(t + dt));
    }
    return Vector3::Zero();
  }
};

Surfaces::Surfaces(btDiscreteDynamicsWorld& world, const Scene& scene, const WorldUnits& units,
                   const BulletSettings& settings)
    : world_(world), parts_(std::make_unique<Parts>()) {
  parts_->motion = scene.motion;
  parts_->floor = scene.box ? scene.box->floor : ShakenFloor{};
  parts_->turn = units.turn;
  parts_->told = settings.surface_velocity;
  // Half-spaces normal·r <= offset.
  const auto add = [&](const Vector3& normal, double offset, int index, bool moves) {
    parts_->surfaces.push_back(
        std::make_unique<Parts::Surface>(to_bullet(units.turn * normal), btScalar(offset)));
    btRigidBody& body = parts_->surfaces.back()->body;
    body.setUserIndex(index);
    body.setContactProcessingThreshold(btScalar(settings.contact_processing_threshold));
    if (moves) {
      body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
      body.setActivationState(DISABLE_DEACTIVATION);
      parts_->moving.push_back(&body);
    }
    world.addRigidBody(&body);
    bodies_.push_back(&body);
  };
  const bool shaken = !parts_->floor.is_still();
  if (scene.has_substrate) add(Vector3::UnitZ(), 0, kFloor, shaken || !scene.motion.is_still());
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
    beside_.push_back(
        std::make_unique<SurfaceBody>(scene.surfaces[k], units, settings, surface_touch(k)));
    bodies_.push_back(&beside_.back()->body());
    world.addRigidBody(bodies_.back());
  }
  if (std::ranges::any_of(beside_, [](const auto& surface) { return !surface->is_still(); }))
    world.setInternalTickCallback(
        [](btDynamicsWorld* turning, btScalar) {
          const auto* surfaces = static_cast<const Surfaces*>(turning->getWorldUserInfo());
          for (const auto& surface : surfaces->beside_) surface->tell_velocity();
        },
        this, true);
  if (!scene.box) return;
  const Box& box = *scene.box;
  const bool with_walls = shaken && box.moving_walls;
  add(Vector3::UnitX(), 0, kWall, with_walls);
  add(-Vector3::UnitX(), -box.width, kWall, with_walls);
  if (box.lid) add(-Vector3::UnitZ(), -*box.lid, kLid, with_walls);
}

Surfaces::~Surfaces() {
  for (btRigidBody* body : bodies_) world_.removeRigidBody(body);
}

const Vector3& Surfaces::told_before() const { return parts_->told_before; }

Vector3 Surfaces::displacement(const btRigidBody& surface, double time) const {
  if (!surface.isKinematicObject()) return Vector3::Zero();
  return parts_->turn * Vector3(0, 0, parts_->floor.height(time));
}

Vector3 Surfaces::velocity(const btRigidBody& surface, double time) const {
  if (!surface.isKinematicObject()) return Vector3::Zero();
  return parts_->turn * Vector3(0, 0, parts_->floor.velocity(time));
}

void Surfaces::begin_step(double time, double time_step) {
  for (const auto& surface : beside_) surface->begin_step(time, time_step);
  if (parts_->moving.empty()) return;
  // A plane that moves along itself stays where it is.
  const Vector3 place(0, 0, parts_->floor.height(time));
  const Vector3 velocity = parts_->velocity(time, time_step);
  parts_->told_before =
      parts_->told_now.value_or(parts_->turn * parts_->velocity(time - time_step, time_step));
  parts_->told_now = parts_->turn * velocity;
  const Vector3 before = place - time_step * velocity;
  btTransform now = btTransform::getIdentity(), then = now;
  now.setOrigin(to_bullet(parts_->turn * place));
  then.setOrigin(to_bullet(parts_->turn * before));
  for (btRigidBody* body : parts_->moving) {
    body->setWorldTransform(now);
    body->setInterpolationWorldTransform(then);
  }
}

}  // namespace slipcheck::bullet
