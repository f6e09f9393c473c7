#pragma once

#include <algorithm>
#include <cmath>

#include "physics/contact/capped_spring.h"
#include "physics/contact/elastic_pair.h"

namespace slipcheck {

// The springs of capped_spring.h between two bodies: what sets their stiffness, damping and caps.

/// Friction against sliding.
///
/// constant: k_t as it stands (Cundall and Strack 1979; LAMMPS's gran/hooke/history).
/// mindlin: k_t = 8 G* √(R_eff ξ) of spheres that do not slip (R. D. Mindlin, J. Appl. Mech. 16,
/// 259 (1949)), of which each further slip adds k_t du to the force; where the overlap falls, the
/// force falls with k_t (O. R. Walton 1993; C. Thornton et al., Powder Technol. 233, 30 (2013);
/// LAMMPS's `mindlin_rescale/force`). It cannot create energy.
/// mindlin_displacement: k_t of the present overlap times the whole displacement (LAMMPS's
/// gran/hertz/history and `mindlin`); a bent contact that is pressed harder gains energy.
struct SpringFriction {
  enum class Form { constant, mindlin, mindlin_displacement };
  Form form = Form::constant;
  double stiffness = 0;      ///< k_t [N/m], or of Mindlin k_t/√ξ = 8 G* √R_eff [N/m^1.5], >= 0
  double damping = 0;        ///< c_t [N s/m], >= 0
  double damping_ratio = 0;  ///< c_t over the normal dashpot's, which is added [-], >= 0
  double static_friction = 0;   ///< μ_s [-], >= kinetic_friction
  double kinetic_friction = 0;  ///< μ_k [-], >= 0

  /// k_t [N/m] at the overlap ξ [m].
  double stiffness_at(double overlap) const {
    return form == Form::constant ? stiffness : stiffness * std::sqrt(std::max(0.0, overlap));
  }
};

/// Resistance against rolling, or against drilling about the line of centres: a torque that grows
/// with the angle rolled up to `length` F_N and then is that. J. Ai et al., Powder Technol. 206,
/// 269 (2011), model C; Luding 2008, Sec. 2.5; LAMMPS's `rolling sds` and `twisting sds`.
struct SpringTorque {
  double stiffness = 0;  ///< [N m/rad], >= 0
  double damping = 0;    ///< [N m s/rad], >= 0
  double length = 0;     ///< largest torque over F_N [m], >= 0: μ_r R_eff where it rolls

  SpringNow at(double normal) const {
    return {stiffness, damping, length * normal, length * normal};
  }
};

/// What two bodies that touch remember of each other.
struct ContactMemory {
  SpringFriction sliding;
  SpringTorque rolling, drilling;
};

/// 8 G* √R_eff [N/m^1.5], k_t/√ξ of Mindlin's contact: 1/G* = Σ (2 − ν)/G, G = Y/(2 (1 + ν)).
inline double mindlin_modulus(const ElasticMaterial& first, const ElasticMaterial& second,
                              double effective_radius) {
  const auto compliance = [](const ElasticMaterial& m) {
    return (2 - m.poisson_ratio) * 2 * (1 + m.poisson_ratio) / m.young_modulus;
  };
  return 8 * std::sqrt(effective_radius) / (compliance(first) + compliance(second));
}

}  // namespace slipcheck
