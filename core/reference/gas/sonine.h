#pragma once

namespace slipcheck {

/// Of a distribution of velocities c = v/√(2T/m), f = (Maxwellian) (1 + a_2 S_2(c²) + a_3 S_3(c²)),
/// S_n the Laguerre polynomials L_n^(D/2−1):
///   ⟨c⁴⟩ = D (D+2)/4 (1 + a_2),  ⟨c⁶⟩ = D (D+2)(D+4)/8 (1 + 3 a_2 − a_3).
struct SonineCoefficients {
  double a2 = 0, a3 = 0;  ///< [-]
};

/// Those of the homogeneous cooling state of smooth spheres of constant e in [0, 1], with both
/// terms: Brilliantov and Poeschel, Europhys. Lett. 74, 424 (2006), and in the linear form of
/// Santos and Montanero, Granular Matter 11, 157 (2009). In the cooling state all ⟨c^n⟩ stand
/// still,
///   μ_n = (n/D) μ_2 ⟨c^n⟩,
/// μ_n being what collisions take from ⟨c^n⟩. For n = 4 and 6, linear in a_2 and a_3, these are two
/// equations. With a_2 alone n = 4 gives van_noije_ernst().
///
/// The μ_n are integrals of polynomials over Maxwellians, with the flux |r_x| along the line of
/// centres x: Gauss' rules of seven points are exact but for rounding.
SonineCoefficients sonine_cooling_state(int dimensions, double e);

}  // namespace slipcheck
