#pragma once

#include <cmath>
#include <numbers>

namespace slipcheck {

// A homogeneous gas of equal spheres (D = 3) or disks (D = 2) of mass m and diameter d that lose
// energy when they collide. Temperatures are energies, T = m ⟨v²⟩/D and T_rot = I ⟨ω²⟩/D_rot [J],
// D_rot = D (D − 1)/2.

/// χ(φ) [-], how much more often spheres that fill the share φ of the space meet than points would:
/// Carnahan and Starling, J. Chem. Phys. 51, 635 (1969); disks: Henderson, Mol. Phys. 30, 971
/// (1975), right to 1 % up to φ = 0.6.
inline double contact_correlation(int dimensions, double filled) {
  const double free = 1 - filled;
  return dimensions == 2 ? (1 - 7 * filled / 16) / (free * free)
                         : (1 - 0.5 * filled) / (free * free * free);
}

/// Number density [1/m^D].
inline double gas_density(int dimensions, double filled, double diameter) {
  return dimensions == 2 ? 4 * filled / (std::numbers::pi * diameter * diameter)
                         : 6 * filled / (std::numbers::pi * diameter * diameter * diameter);
}

/// n χ σ_T [1/m]: a particle that passes the others at g [m/s] collides at g times this rate.
/// σ_T = π d², of disks 2 d.
inline double collisions_on_the_way(int dimensions, double filled, double diameter) {
  const double section = dimensions == 2 ? 2 * diameter : std::numbers::pi * diameter * diameter;
  return gas_density(dimensions, filled, diameter) * contact_correlation(dimensions, filled) *
         section;
}

/// ⟨g⟩ [m/s] of two particles of a Maxwellian: √(π T/m) for D = 2, 4 √(T/(π m)) for D = 3.
inline double mean_relative_speed(int dimensions, double temperature_by_mass) {
  return dimensions == 2 ? std::sqrt(std::numbers::pi * temperature_by_mass)
                         : 4 * std::sqrt(temperature_by_mass / std::numbers::pi);
}

/// −d ln T/dτ [-] of smooth spheres of constant e, τ the collisions of a particle. A collision
/// takes (m/4) (1 − e²) u_n², in the mean (1 − e²) T (1 + 3 a_2/16)/(1 − a_2/16), from two of the D
/// T/2: a_2 changes ⟨g³⟩ and ⟨g⟩ so (van Noije and Ernst).
inline double haff_cooling(int dimensions, double e, double a2 = 0) {
  return (1 - e * e) / dimensions * (1 + 3 * a2 / 16) / (1 - a2 / 16);
}

/// a_2 of the homogeneous cooling state, ⟨v⁴⟩ = (D + 2)/D ⟨v²⟩² (1 + a_2), of smooth spheres of
/// constant e, to first order in a_2: van Noije and Ernst, Granular Matter 1, 57 (1998).
inline double van_noije_ernst(int dimensions, double e) {
  const double D = dimensions;
  return 16 * (1 - e) * (1 - 2 * e * e) / (9 + 24 * D + (8 * D - 41) * e + 30 * e * e * (1 - e));
}

/// The same equation for a_2 made linear after division by 1 + a_2, which is nearer for small e:
/// Montanero and Santos, Granular Matter 2, 53 (2000).
inline double montanero_santos(int dimensions, double e) {
  const double D = dimensions;
  return 16 * (1 - e) * (1 - 2 * e * e) / (25 + 24 * D - (57 - 8 * D) * e - 2 * e * e * (1 - e));
}

/// How temperatures change with the collisions τ of a particle [J].
struct GasCooling {
  double translation = 0;  ///< dT/dτ
  double rotation = 0;     ///< dT_rot/dτ
};

/// The mean field of rough spheres of constant e and β = −ε^T without Coulomb friction: Huthmann
/// and Zippelius, Phys. Rev. E 56, R6275 (1997); Luding, Huthmann, McNamara and Zippelius, Phys.
/// Rev. E 58, 3416 (1998). With η = q (1 + β)/(2 q + 2) a collision of two particles of Maxwellians
/// changes the energies by
///   ΔE     = −(1 − e²) T + 2 (D − 1) η ((η − 1) T + η T_rot/q),
///   ΔE_rot = (2 (D − 1) η/q) (η T + (η/q − 1) T_rot).
inline GasCooling huthmann_zippelius(int dimensions, double e, double beta, double q, double T,
                                     double T_rot) {
  const double D = dimensions, D_t = D - 1, D_rot = 0.5 * D * (D - 1);
  const double eta = q * (1 + beta) / (2 * q + 2);
  return {(-(1 - e * e) * T + 2 * D_t * eta * ((eta - 1) * T + eta * T_rot / q)) / D,
          2 * D_t * eta / q * (eta * T + (eta / q - 1) * T_rot) / D_rot};
}

}  // namespace slipcheck
