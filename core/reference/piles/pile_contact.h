#pragma once

#include <cstdint>
#include <type_traits>

#include "physics/contact/capped_spring.h"
#include "reference/piles/pile_law.h"

namespace slipcheck {

/// How the surface of a contact's first body moves against the second's.
struct PileMotion {
  Vector3 normal = kUp;            ///< unit, from the second to the first
  double overlap = 0;              ///< ξ [m]
  double closing = 0;              ///< −n·v [m/s]
  Vector3 slip = Vector3::Zero();  ///< across n [m/s]
  Vector3 spin = Vector3::Zero();  ///< Ω of the first against the second [rad/s]
  /// Half a step before, and the mean spin of both about n [rad/s].
  Vector3 slip_before = Vector3::Zero(), spin_before = Vector3::Zero();
  double turning_before = 0;
  double speed = 0;  ///< of the centre over the second [m/s]
  /// Of the matter of a surface half a step before.
  Vector3 carried_by = Vector3::Zero(), turned_by = Vector3::Zero();
};

/// On the first of the two.
struct PileForce {
  Vector3 all = Vector3::Zero();     ///< [N]
  Vector3 across = Vector3::Zero();  ///< of that the part across n, which turns both [N]
  Vector3 torque = Vector3::Zero();  ///< against rolling and drilling [N m]

  PileForce operator+(const PileForce& o) const {
    return {all + o.all, across + o.across, torque + o.torque};
  }
  PileForce operator-(const PileForce& o) const {
    return {all - o.all, across - o.across, torque - o.torque};
  }
  friend PileForce operator*(double factor, const PileForce& f) {
    return {factor * f.all, factor * f.across, factor * f.torque};
  }
};

/// On the first of the two, against rolling and drilling.
struct PileCouples {
  Vector3 rolling = Vector3::Zero(), drilling = Vector3::Zero();  ///< [N m]
};

/// What resists rolling and drilling.
struct PileTurning {
  SpringMemory<Vector3> rolling{Vector3::Zero()};
  SpringMemory<double> drilling{0};
  Vector3 rolling_dashpot = Vector3::Zero();  ///< [N m]
  double drilling_dashpot = 0;                ///< [N m]
};
struct NoPileTurning {};

/// Of a hard contact, as long as it may be an impact and no more.
struct PileImpact {
  double until = 0;                  ///< [s]; from then on it lasts
  double friction = 0;               ///< μ
  Vector3 leaves = Vector3::Zero();  ///< −β0 u_t, the slip that is left where it sticks [m/s]
};

/// Two that touch, and what they remember of each other. kTurns: rolling or drilling is resisted.
template <bool kTurns>
struct PileContact : std::conditional_t<kTurns, PileTurning, NoPileTurning> {
  std::uint32_t first = 0;  ///< as of PileNear
  int second = kSubstrate;
  bool touching = false;
  double impulse = 0;  ///< normal, since it was shown [N s]
  /// What a hard contact's normal spring is longer by than the bodies overlap, since it was
  /// prepared, until it opens [m].
  double offset = 0;
  const PileLaw* law = nullptr;

  // As of the instant before.
  double overlap = 0;  ///< with the offset
  Vector3 normal = kUp;
  PileForce force;
  double normal_force = 0;
  double normal_dashpot = 0;                  ///< the part of it that the overlap's rate makes [N]
  double stiffness = 0;                       ///< k_t [N/m]
  Vector3 sliding_dashpot = Vector3::Zero();  ///< the tangential force without the spring's [N]
  SpringMemory<Vector3> sliding{Vector3::Zero()};
  PileImpact impact;
};

inline double work_of(double force, double way) { return force * way; }
inline double work_of(const Vector3& force, const Vector3& way) { return force.dot(way); }

template <class V>
double spring_energy(double stiffness, const V& stretch) {
  return 0.5 * stiffness * work_of(stretch, stretch);
}

}  // namespace slipcheck
