#pragma once

#include <cstddef>

#include "physics/contact/tangential_branch.h"
#include "physics/vector.h"
#include "scene/contact_scene.h"

namespace slipcheck {

// What a body and a contact are doing: between two events these stay as they are, and all forces
// are smooth functions of the state.

/// Direction of a dry friction's velocity, continued smoothly where the velocity passes through
/// zero: ±w/|w|, the sign being that of the reference direction.
inline Vector3 continued_direction(const Vector3& w, const Vector3& reference) {
  const double size = w.norm();
  if (!(size > 1e-290)) return reference;
  return w.dot(reference) < 0 ? Vector3(-w / size) : Vector3(w / size);
}

/// w/|w|, or any direction where there is none.
inline Vector3 direction_of(const Vector3& w) {
  return w.isZero(0) ? Vector3(Vector3::UnitX()) : Vector3(w.normalized());
}

inline Vector3 horizontal(const Vector3& v) { return {v.x(), v.y(), 0}; }

/// A body over or on the substrate.
struct BodyMode {
  enum class Kind {
    flying,
    sliding,
    rolling,  ///< without slip; moving or at rest
  };
  Kind kind = Kind::flying;
  Vector3 slip_direction = Vector3::UnitX();  ///< of u, while sliding
  /// The slip has just begun: too slow to have a direction, it follows the load.
  bool slip_begins = false;
  /// Rolling friction holds it: no velocity relative to the substrate (while sliding: no rolling
  /// rate).
  bool roll_held = false;
  Vector3 roll_direction = Vector3::UnitX();  ///< of v − v_S while rolling, of k̂×… see rolling_rate
  bool roll_begins = false;                   ///< it has just begun to roll, or to turn
  bool spin_held = false;                     ///< drilling friction holds Ω_z at 0
  double spin_sign = 1;                       ///< of Ω_z, while it is not held
  double normal_sign = 1;                     ///< of the substrate's normal force, where confined

  bool on_plane() const { return kind != Kind::flying; }
};

/// Two bodies in contact, first < second.
struct ContactMode {
  std::size_t first = 0, second = 0;
  std::size_t slot = 0;  ///< of its part of the state
  const SoftContact* law = nullptr;
  double reduced_mass = 0;   ///< m̄ [kg]
  double overlap_scale = 0;  ///< what the approach speed compresses elastically [m]
  double time_scale = 0;     ///< that over the approach speed [s]
  bool clamped = false;      ///< zero_force: they overlap without a force
  TangentialBranch branch;
};

}  // namespace slipcheck
