#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>

#include "bullet_backend/coefficients.h"
#include "bullet_backend/profiles.h"
#include "engine/engine.h"

namespace slipcheck::bullet {

/// One Bullet world: the scene's spheres on a static plane z = 0, or in a box, where they are held
/// in the plane y = 0 and spin about y alone; in SI.
class BulletWorld {
 public:
  /// `scene` and `coefficients` must outlive the world; the latter serve the default profile. Sets
  /// Bullet's combine callbacks as the profile needs them. The states are those at `time` [s], by
  /// which a box is shaken; steps are of exactly `time_step` [s].
  BulletWorld(const HardScene& scene, Profile profile, const PairCoefficients& coefficients,
              double time_step, std::span<const BodyState> states, double time);
  ~BulletWorld();

  /// One step, without substeps.
  void step();

  /// The state after the last step. A box's floor counts as substrate; touches with its walls and
  /// lid are left out.
  void read(Frame& frame) const;

  /// The settings in force, see settings.h.
  std::map<std::string, Setting> settings() const;

 private:
  struct Parts;
  const HardScene& scene_;
  Profile profile_;
  double time_step_, start_time_;  // [s]
  std::size_t steps_ = 0;
  std::unique_ptr<Parts> parts_;
};

/// Bullet's version, "3.24".
std::string bullet_version();

/// "single" or "double".
std::string bullet_precision();

/// Whether Bullet takes this for no time at all and would not step.
bool is_no_time(double time_step);

}  // namespace slipcheck::bullet
