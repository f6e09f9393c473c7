#pragma once

#include <cmath>

#include "physics/sphere.h"

namespace slipcheck {

// What two spheres that touch have in common, B (8), (21)-(24), (A13).

/// What a sphere is made of, as far as its contacts see it.
struct ElasticMaterial {
  double young_modulus = 0;     ///< Y [Pa], > 0
  double poisson_ratio = 0;     ///< ν [-], in (−1, 0.5]
  double dissipation_time = 0;  ///< A, dissipation_time() [s], >= 0

  /// (1 − ν²)/Y [1/Pa].
  double compliance() const { return (1 - poisson_ratio * poisson_ratio) / young_modulus; }
};

/// m_eff = m1 m2/(m1 + m2) [kg].
inline double effective_mass(const Sphere& first, const Sphere& second) {
  return first.mass * (second.mass / (first.mass + second.mass));
}

/// R_eff = R1 R2/(R1 + R2) [m].
inline double effective_radius(const Sphere& first, const Sphere& second) {
  return first.radius * (second.radius / (first.radius + second.radius));
}

/// κ of B (8) [-], in (0, 1): 1/κ = 1 + (m1 q1 + m2 q2)/(q1 q2 (m1 + m2)); 2/7 for solid spheres.
/// m_eff κ is the mass that a tangential force at the contact of two free spheres moves, as
/// 1/(m_eff κ) = Σ (1/m_i + R_i²/I_i).
inline double tangential_mass_ratio(const Sphere& first, const Sphere& second) {
  const double q1 = first.shape_factor, q2 = second.shape_factor;
  const double m1 = first.mass, m2 = second.mass;
  return 1 / (1 + (m1 * q1 + m2 * q2) / (q1 * q2 * (m1 + m2)));
}

/// E* [Pa]: 1/E* is the sum of both compliances.
inline double effective_modulus(const ElasticMaterial& first, const ElasticMaterial& second) {
  return 1 / (first.compliance() + second.compliance());
}

/// ρ of Hertz' F = ρ ξ^{3/2} [N/m^1.5]: (4/3) E* √R_eff, for one material 2 Y √R_eff/(3 (1 − ν²)).
inline double hertz_modulus(const ElasticMaterial& first, const ElasticMaterial& second,
                            double effective_radius) {
  return 4.0 / 3 * effective_modulus(first, second) * std::sqrt(effective_radius);
}

/// A [s] from the viscosities η1 of shear and η2 of compression [Pa s], >= 0; B (23) corrected:
///   A = (1 + ν)/(Y (1 − ν)) [(2/3)(1 − ν + ν²) η1 + (1 − 2ν)² η2].
///
/// A contact's stiffness is in proportion to S = Y/(1 − ν²) = E1 (E1 + 6 E2)/(2 E1 + 3 E2), with
/// E1 = Y/(1 + ν) and E2 = Y/(3 (1 − 2ν)). The energy of a deformation is of first order in E1 and
/// E2 and, at rest, stationary in the displacements: ∂S/∂E1 and ∂S/∂E2 are what shear and
/// compression have in it, so that the power lost is in proportion to η1 ∂S/∂E1 + η2 ∂S/∂E2 and
/// A = (η1 ∂S/∂E1 + η2 ∂S/∂E2)/S. η_i = τ E_i makes A = τ. Goldobin et al., Eur. Phys. J. E 38, 55
/// (2015), give the same and where (A24) goes wrong.
inline double dissipation_time(double eta1, double eta2, double young_modulus,
                               double poisson_ratio) {
  const double nu = poisson_ratio, compressed = 1 - 2 * nu;
  return (1 + nu) / (young_modulus * (1 - nu)) *
         (2.0 / 3 * (1 - nu + nu * nu) * eta1 + compressed * compressed * eta2);
}

/// A [s] of a pair, the mean of both weighted with their compliances c_i.
///
/// B's law says that a body whose surface is displaced by w_i presses back with p = p_i + A_i ṗ_i,
/// p_i being the elastic pressure of that displacement, w_i = c_i G p_i with an operator G of the
/// contact's shape alone. Both bodies see one p, so p_i = p − A_i ṗ to first order in A. Then
///   w_1 + w_2 = (c_1 + c_2) G (p − A ṗ) with A = (c_1 A_1 + c_2 A_2)/(c_1 + c_2),
/// the law of a pair with this A.
inline double effective_dissipation_time(const ElasticMaterial& first,
                                         const ElasticMaterial& second) {
  const double c1 = first.compliance(), c2 = second.compliance();
  return (c1 * first.dissipation_time + c2 * second.dissipation_time) / (c1 + c2);
}

/// Deepest overlap [m] of an elastic collision at the speed g [m/s], > 0: m g²/2 = (2/5) ρ ξ^{5/2},
/// so ξ = (m/k_H)^{2/5} g^{4/5} with k_H = (4/5) ρ.
inline double hertz_largest_overlap(double effective_mass, double hertz_modulus, double g) {
  return std::pow(effective_mass / (0.8 * hertz_modulus), 0.4) * std::pow(g, 0.8);
}

/// B (A13), the duration [s] of that collision: with x = ξ/ξ_max,
///   t_c = 2 (ξ_max/g) ∫_0^1 dx/√(1 − x^{5/2}) = (4/5) B(2/5, 1/2) ξ_max/g = 2.9432 ξ_max/g.
///
/// K (B1) with K's constants lacks a factor 2 in the force, which makes t_c 2^{2/5} too long.
inline double hertz_duration(double effective_mass, double hertz_modulus, double g) {
  const double beta = std::tgamma(0.4) * std::tgamma(0.5) / std::tgamma(0.9);
  return 0.8 * beta * hertz_largest_overlap(effective_mass, hertz_modulus, g) / g;
}

/// κ_v [m^-1/2 s^-2] of the series 1 − ε = 1.15344 A κ_v^{2/5} g^{1/5} − …: (3/2)^{3/2} (3/2)
/// ρ/m_eff, for one material (3/2)^{3/2} Y √R_eff/(m_eff (1 − ν²)).
inline double viscoelastic_constant(double effective_mass, double hertz_modulus) {
  return std::pow(1.5, 2.5) * hertz_modulus / effective_mass;
}

/// c_t [m/s], the transversal speed of sound √(Y/(2 ρ (1 + ν))), B (B3): (B11) asks for impacts far
/// slower.
inline double transversal_sound_speed(double young_modulus, double poisson_ratio, double density) {
  return std::sqrt(young_modulus / (2 * density * (1 + poisson_ratio)));
}

}  // namespace slipcheck
