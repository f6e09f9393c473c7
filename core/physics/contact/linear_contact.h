#pragma once

#include "physics/contact/normal_force.h"

namespace slipcheck {

/// The linear spring and dashpot of K (2) between two spheres, F_N = k ξ + γ_N m̄ ξ̇ with the overlap
/// ξ and the reduced mass m̄, as a collision of given speed sees it: ξ̈ + γ_N ξ̇ + ω0² ξ = 0.
///
/// Symbols: ω0 = √(k/m̄) (√(2k/m) for equal masses), ω = √(ω0² − γ_N²/4), ε = γ_N/ω0. The deepest
/// overlap is reached after τ = atan(2ω/γ_N)/ω. F_N, in proportion to −ξ̈, is zero after 2τ, where
/// ξ̇ = −v exp(−γ_N τ); ξ is zero after π/ω. From critical damping on, γ_N >= 2 ω0, ω is imaginary,
/// τ = atanh(2|ω|/γ_N)/|ω|, and ξ falls to zero for ever.
class LinearContact {
 public:
  using End = ContactEnd;

  /// reduced_mass [kg] and stiffness k [N/m] > 0; damping_rate γ_N [1/s] >= 0.
  LinearContact(double reduced_mass, double stiffness, double damping_rate, End end);

  /// The contact that has these, by the end rule's own relation. restitution e_n in (0, 1],
  /// collision_time t_col [s] or stiffness [N/m] > 0. Either end rule reaches all of (0, 1]; under
  /// zero_force e_n <= e^−2 takes critical damping and more.
  static LinearContact with_collision_time(double reduced_mass, double restitution,
                                           double collision_time, End end);
  static LinearContact with_stiffness(double reduced_mass, double restitution, double stiffness,
                                      End end);
  /// The contact of this damping_rate [1/s], >= 0, that lasts collision_time [s], > 0.
  static LinearContact with_damping_rate(double reduced_mass, double damping_rate,
                                         double collision_time, End end);

  double reduced_mass() const { return reduced_mass_; }                   ///< m̄ [kg]
  double stiffness() const { return stiffness_; }                         ///< k [N/m]
  double damping_rate() const { return damping_rate_; }                   ///< γ_N [1/s]
  double contact_frequency() const { return omega0_; }                    ///< ω0 [1/s]
  double damping_ratio() const { return damping_rate_ / omega0_; }        ///< ε [-]
  bool is_over_critical() const { return damping_rate_ >= 2 * omega0_; }  ///< critical or more

  /// Duration of a collision [s], the same for all speeds: π/ω under zero_overlap, infinite from
  /// critical damping on; 2τ under zero_force.
  double collision_time() const;
  /// e_n [-]: exp(−γ_N t_col/2) under either rule, so slightly larger for the same γ_N under
  /// zero_force; 0 where the collision never ends.
  double restitution() const;
  /// Largest overlap [m] of a collision that begins with the speed v [m/s].
  double largest_overlap(double v) const;

 private:
  double deepest_after() const;  ///< τ [s]

  double reduced_mass_, stiffness_, damping_rate_;
  double omega0_, omega_;  ///< ω or |ω|
  End end_;
};

/// C = π A γ_S/(2 ω0), K (55): to first order the share of Ω_i + Ω_j that the vertical rubbing
/// takes from each; exactly ½ (1 − e^(−2C)) without the Coulomb cap.
double rubbing_constant(double A, double tangential_damping_rate, double contact_frequency);
double rubbed_share(double rubbing_constant);

}  // namespace slipcheck
