#pragma once

namespace slipcheck {

/// What a gas of spheres in a plane needs for the ratio of its energies.
struct RoughGas {
  double restitution = 0.9;           ///< e [-], in [0, 1]
  double friction = 0.5;              ///< μ [-], > 0
  double tangential_restitution = 0;  ///< β0 [-], in (−1, 1]
  double shape_factor = 0.4;          ///< q [-], > 0

  /// K/R by L (15): (2/q + 1/μ)/(1 + β0).
  double ratio_15() const;

  /// K/R where collisions leave the mean rotational energy as it is, if all velocities and spins
  /// are Maxwellian and independent (molecular chaos), and nothing but collisions of two spheres
  /// turns them. Of two equal spheres with S = R(ω1 + ω2) and u_t = v_t − S, a collision adds
  ///   −P_t S + P_t²/(q m),  P_t = −sgn(u_t) min[½ κ m (1+β0)|u_t|, ½ μ m (1+e)|u_n|];
  /// its mean over the collisions' u_n, in proportion to u_n exp(−u_n²/(4 T)), and over u_t and S
  /// vanishes. An extension; relative error of the quadrature below 1e-3.
  double ratio_of_chaos() const;

  /// The same for μ → ∞, where all spheres stick: (2/q)(1 + 2q − β0)/(1 + β0).
  double ratio_of_sticking_chaos() const;
};

}  // namespace slipcheck
