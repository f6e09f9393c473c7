#pragma once

#include <memory>

#include "bullet_backend/bullet_settings.h"
#include "bullet_backend/leave_outs.h"
#include "bullet_backend/periodic_cell.h"

class btDiscreteDynamicsWorld;
class btCollisionDispatcher;

namespace slipcheck::bullet {

/// An empty Bullet world with its solver, dispatcher and broadphase, set up as a profile asks. Some
/// of Bullet's settings are global; the last world made decides about them, so that there is at
/// most one at a time.
class DynamicsWorld {
 public:
  /// `margin_scale` as in margins.h; balls meet their images across the edges of `cell`, which must
  /// outlive this. Throws Refused where Bullet has no such solver.
  DynamicsWorld(const BulletSettings& settings, double margin_scale, const LeaveOuts& leaves,
                const PeriodicCell& cell);
  ~DynamicsWorld();
  DynamicsWorld(const DynamicsWorld&) = delete;
  DynamicsWorld& operator=(const DynamicsWorld&) = delete;

  btDiscreteDynamicsWorld& world() const;
  btCollisionDispatcher& dispatcher() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slipcheck::bullet
