#pragma once

#include <cmath>
#include <type_traits>

#include "physics/vector.h"

namespace slipcheck {

// Friction with memory: a spring that is stretched by what slides, rolls or drills, beside a
// dashpot, and that gives way at a cap. P. A. Cundall and O. D. L. Strack, Géotechnique 29, 47
// (1979); here in the form of S. Luding, Granular Matter 10, 235 (2008), Sec. 2.3, (19)-(23), which
// is also that of LAMMPS's pair style gran/hooke/history.
//
// V is Vector3 across the line of centres for sliding and rolling, double along it for drilling.

/// The spring of one contact at one instant; forces are torques where it turns.
struct SpringNow {
  double stiffness = 0;  ///< k [N/m] or [N m], >= 0
  double damping = 0;    ///< c [N s/m] or [N m s], >= 0
  double holds = 0;      ///< most force while it sticks, μ_s F_N [N] or [N m]
  double slides = 0;     ///< force while it slides, μ_k F_N, <= holds
};

/// What the contact remembers.
template <class V>
struct SpringMemory {
  V stretch;  ///< s [m] or [rad]
  bool slides = false;
};

template <class V>
struct SpringResponse {
  V force;    ///< on the first body [N] or [N m]
  V elastic;  ///< −k s, of that the part of the spring
  V cut;      ///< by how much the spring was cut back [m] or [rad]
};

/// Takes the spring on by `way` [m] or [rad] to an instant at which the contact slides at `rate`
/// [m/s] or [rad/s].
///
/// With s grown by the way f = −k s − c u. Below the cap that is the force. Above it the contact
/// slides: f = f̂ times the cap, and s is cut back to −(f + c u)/k, which gives that force; it
/// sticks again once |f| falls to the sliding cap.
template <class V>
SpringResponse<V> respond(const SpringNow& law, const V& way, const V& rate,
                          SpringMemory<V>& memory) {
  memory.stretch += way;
  const V elastic = -law.stiffness * memory.stretch, force = elastic - law.damping * rate;
  const auto size = [&] {
    if constexpr (std::is_same_v<V, double>)
      return std::abs(force);
    else
      return force.norm();
  }();
  if (size <= (memory.slides ? law.slides : law.holds)) {
    memory.slides = false;
    return {force, elastic, V(0 * way)};
  }
  memory.slides = true;
  const V capped = (law.slides / size) * force;
  if (law.stiffness == 0) return {capped, elastic, V(0 * way)};
  const V left = (-1 / law.stiffness) * (capped + law.damping * rate);
  const V cut = memory.stretch - left;
  memory.stretch = left;
  return {capped, V(-law.stiffness * left), cut};
}

/// Carries what lies across the line of centres from its direction `before` to `now`, both unit,
/// by the least rotation between them, and turns it around it by `angle` [rad], small.
inline Vector3 carried(const Vector3& across, const Vector3& before, const Vector3& now,
                       double angle) {
  const Vector3 tilted = across - across.dot(now) / (1 + before.dot(now)) * Vector3(before + now);
  return (1 - 0.5 * angle * angle) * tilted + angle * now.cross(tilted);
}

}  // namespace slipcheck
