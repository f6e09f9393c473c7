#pragma once

#include <memory>
#include <span>
#include <vector>

#include "scenario/hard_scene.h"

class btDiscreteDynamicsWorld;
class btRigidBody;

namespace slipcheck::bullet {

/// What the balls of a world bounce off: the plane z = 0, or the floor, walls and lid of a box. All
/// are half-spaces (btStaticPlaneShape): at 240 Hz and 1 m/s a ball of 0.5 mm goes through four
/// times its diameter in a step, and would leave a box made of slabs on their far side. Their user
/// indices are kFloor, kWall (twice) and kLid of coefficients.h.
///
/// What is shaken is kinematic, as Bullet's manual has it: never asleep, and moved by a motion
/// state that Bullet asks at the start of each step. There it is told where the floor is at that
/// instant, to which the balls' positions belong too. From this and the place before Bullet makes
/// the velocity that contacts feel, (z_f(t) - z_f(t - dt))/dt: half a step old when the step
/// begins.
class Surfaces {
 public:
  /// Adds the scene's surfaces to `world`, which must outlive them, where they are at `time` [s].
  Surfaces(btDiscreteDynamicsWorld& world, const HardScene& scene, double time, double time_step);
  ~Surfaces();
  Surfaces(const Surfaces&) = delete;
  Surfaces& operator=(const Surfaces&) = delete;

  /// The time at which the next step begins [s].
  void set_time(double time);

  std::span<btRigidBody* const> bodies() const { return bodies_; }

 private:
  struct Parts;
  btDiscreteDynamicsWorld& world_;
  std::unique_ptr<Parts> parts_;
  std::vector<btRigidBody*> bodies_;
};

}  // namespace slipcheck::bullet
