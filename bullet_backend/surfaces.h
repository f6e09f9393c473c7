#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bullet_backend/surface_body.h"
#include "bullet_backend/world_units.h"

class btDiscreteDynamicsWorld;
class btRigidBody;

namespace slipcheck::bullet {

/// What the balls of a world bounce off: a plane and surfaces beside it (surface_body.h), or the
/// floor, walls and lid of a box. Plane and box are half-spaces (btStaticPlaneShape): at 240 Hz and
/// 1 m/s a ball of 0.5 mm goes through four times its diameter in a step, and would leave a box
/// made of slabs on their far side. Their user indices are kFloor, kWall (twice) and kLid of
/// coefficients.h, those of surfaces surface_touch().
///
/// What moves is kinematic and never asleep. Bullet makes the velocity that contacts feel from two
/// places of such a body, and so each step begins with two that give the velocity which the
/// settings ask for: `step_before` is what a motion state results in, (x(t) − x(t − dt))/dt, half
/// a step old when the step begins.
class Surfaces {
 public:
  /// Adds the scene's surfaces to `world`, which must outlive them; all in the world's units.
  Surfaces(btDiscreteDynamicsWorld& world, const Scene& scene, const WorldUnits& units,
           const BulletSettings& settings);
  ~Surfaces();
  Surfaces(const Surfaces&) = delete;
  Surfaces& operator=(const Surfaces&) = delete;

  /// A step of length `time_step` begins at `time`.
  void begin_step(double time, double time_step);

  /// What Bullet was told of the velocity of what moves in the step before the one that begins:
  /// what stuck to it then goes with this now. At first what it would have been told.
  const Vector3& told_before() const;

  /// How far one of planes() has moved off its plane at `time`, and how fast it does, as
  /// the scene has it: a plane that moves along itself stays where it is.
  Vector3 displacement(const btRigidBody& surface, double time) const;
  Vector3 velocity(const btRigidBody& surface, double time) const;

  std::span<btRigidBody* const> bodies() const { return bodies_; }
  /// Of these the plane, or what makes the box.
  std::span<btRigidBody* const> planes() const {
    return std::span(bodies_).first(bodies_.size() - beside_.size());
  }
  /// The scene's surfaces beside the plane, in their order.
  std::span<const std::unique_ptr<SurfaceBody>> beside() const { return beside_; }

 private:
  struct Parts;
  btDiscreteDynamicsWorld& world_;
  std::unique_ptr<Parts> parts_;
  std::vector<btRigidBody*> bodies_;
  std::vector<std::unique_ptr<SurfaceBody>> beside_;
};

}  // namespace slipcheck::bullet
