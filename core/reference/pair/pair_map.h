#pragma once

#include "physics/sphere.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// What one collision of two free spheres does.
struct PairCollision {
  double normal_restitution = 0;      ///< ε^N = −g_N'/g_N [-]
  double tangential_restitution = 0;  ///< ε^T = g_T'/g_T at the contact point [-]
  double duration = 0;                ///< from the first touch to the end of the contact [s]
  double energy_change = 0;           ///< kinetic, after minus before [J]
};

/// The collision of these masses m_eff and κ m_eff [kg] that had these speeds [m/s], > 0, and has
/// these restitutions and this duration [s].
inline PairCollision pair_collision(double mass, double tangential_mass, double normal_speed,
                                    double tangential_speed, double normal_restitution,
                                    double tangential_restitution, double duration) {
  const auto change = [](double m, double before, double ratio) {
    return 0.5 * m * before * before * (ratio - 1) * (ratio + 1);
  };
  return {normal_restitution, tangential_restitution, duration,
          change(mass, normal_speed, normal_restitution) +
              change(tangential_mass, tangential_speed, tangential_restitution)};
}

/// A collision without substrate and gravity in which the line of centres keeps its direction, the
/// limit of a contact much shorter than the time in which the spheres pass each other (B, Sec. IV):
///   ξ̈ = −F_N/m_eff,  u̇ = F_T/(κ m_eff)  (elastic_pair.h),
/// from ξ = 0, ξ̇ = g_N, u = g_T to the contact's end. F_T acts on the first body: to F_T/m_eff from
/// the centres the spins add R²/I F_T each, because −R n×F_T turns both spheres and
/// d(−RΩ×n)/dt = (R²/I) (n×F_T)×n = (R²/I) F_T. CVODE integrates between the contact's
/// changes (Coulomb's cap, breaking asperities, F_N at its largest), which are found as roots.
///
/// normal_speed g_N, tangential_speed g_T [m/s], > 0. tolerance: relative, in [1e-13, 1e-3]. Where
/// F_N attracts, a passive asperity does not act. A contact so damped that the spheres stay has the
/// restitution 0 and an infinite duration. Throws IntegrationFailure.
PairCollision collide_freely(const SoftContact& contact, const Sphere& first, const Sphere& second,
                             double normal_speed, double tangential_speed,
                             double tolerance = 1e-12);

}  // namespace slipcheck
