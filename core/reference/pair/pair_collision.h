#pragma once

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

}  // namespace slipcheck
