#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>

#include "bullet_backend/coefficients.h"
#include "bullet_backend/profiles.h"
#include "engine/engine.h"

namespace slipcheck::bullet {

/// One Bullet world: the scene's spheres on a static plane z = 0, in SI.
class BulletWorld {
 public:
  /// `scene` and `coefficients` must outlive the world; the latter serve the default profile. Sets
  /// Bullet's combine callbacks as the profile needs them.
  BulletWorld(const HardScene& scene, Profile profile, const PairCoefficients& coefficients,
              std::span<const BodyState> states);
  ~BulletWorld();

  /// One step of exactly `time_step` [s], without substeps.
  void step(double time_step);

  /// The state after the last step.
  void read(Frame& frame) const;

  /// The settings in force, see settings.h.
  std::map<std::string, Setting> settings(double time_step) const;

 private:
  struct Parts;
  const HardScene& scene_;
  Profile profile_;
  std::unique_ptr<Parts> parts_;
};

/// Bullet's version, "3.24".
std::string bullet_version();

/// "single" or "double".
std::string bullet_precision();

/// Whether Bullet takes this for no time at all and would not step.
bool is_no_time(double time_step);

}  // namespace slipcheck::bullet
