#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bullet_backend/bullet_settings.h"
#include "engine/engine.h"

namespace slipcheck::bullet {

/// One Bullet world: the scene's spheres on a plane, or in a box, where they stay in the plane
/// y = 0 and spin about y alone. While it lives this thread flushes denormal numbers to zero, where
/// the settings ask for it.
class BulletWorld {
 public:
  /// `scene` and the states are SI; the states are those at `time` [s], by which surfaces move;
  /// steps are of exactly `time_step` [s]. Sets Bullet's combine callbacks. Throws Refused.
  BulletWorld(const Scene& scene, const BulletSettings& settings, double time_step,
              std::span<const BodyState> states, double time);
  ~BulletWorld();

  /// One step.
  void step();

  /// The state after the last step. A box's floor counts as substrate; touches with its walls and
  /// lid are left out.
  void read(Frame& frame) const;

  /// As Engine::parts().
  std::span<const Frame> parts() const;

  /// The settings in force, see applied.h.
  Settings applied() const;

  /// What Bullet leaves out, each with the reason, see leave_outs.h.
  std::vector<std::string> left_out() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Bullet's version, "3.24".
std::string bullet_version();

/// "single" or "double".
std::string bullet_precision();

/// Whether Bullet takes this for no time at all and would not step.
bool is_no_time(double time_step);

}  // namespace slipcheck::bullet
