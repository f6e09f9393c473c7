#pragma once

#include "physics/contact/linear_contact.h"

namespace slipcheck {

/// What the vertical rubbing of one collision starts from. Both spheres roll along the line of
/// centres; their surfaces pass each other there with S = |v_i + v_j|, one going up and the other
/// down.
struct RubbingStart {
  double closing_speed = 0;  ///< v_rel = v_i − v_j [m/s], > 0
  double surface_speed = 0;  ///< S [m/s], >= 0
  double damping_rate = 0;   ///< γ_S [1/s], >= 0
  double friction = 0;       ///< ν_s [-], >= 0; infinite: no cap
  /// B = A_i/m_i + A_j/m_j [1/kg], > 0: Ṡ = −B F_R. 2A/m for equal spheres.
  double mobility = 0;
  double lifted_mass = 0;  ///< of the sphere that F_R lifts, the faster one [kg], > 0
  double gravity = 0;      ///< [m/s²], >= 0
  bool confined = false;   ///< it never leaves the plane
};

/// The vertical rubbing F_R of K (6)-(9) during one collision with the linear law.
struct Rubbing {
  double impulse = 0;         ///< ∫ F_R dt [N s], >= 0
  double share = 0;           ///< c in RΔΩ = −c (v_i + v_j), the mean of both spheres [-], >= 0
  double lift_off_time = 0;   ///< since the first touch [s]; infinite: the sphere stays down
  double lift_off_speed = 0;  ///< v^z when the contact ends [m/s], >= 0
};

/// Follows F_R = min(γ_S m̄ w, ν_s |F_N|), w the vertical velocity of one surface past the other,
/// from the first touch to the end of the contact. F_N is known in closed form, and with
/// J = ∫ |F_N| dt = m̄ (v_rel − ξ̇) (after F_N = 0 counted the other way) so is w on each stretch:
///   below the cap  w = w_1 e^(−a (t − t_1)),  a = γ_S m̄ B,
///   at the cap     w = w_1 − B ν_s (J − J_1).
/// Where F_R exceeds the weight of the lifted sphere, that leaves the substrate and its rise is
/// part of w: B grows by 1/m and gravity adds +g to ẇ. K leaves this out, as `confined` does. The
/// ends of the stretches are sign changes of γ_S m̄ w − ν_s |F_N| and F_R − m g, looked for on 512
/// panels and found to rounding by halving. A sphere that has left the substrate stays in the air
/// while the contact lasts.
/// The contact must end: collision_time() finite.
Rubbing rub(const LinearContact& contact, const RubbingStart& start);

}  // namespace slipcheck
