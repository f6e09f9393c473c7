#pragma once

namespace slipcheck {

/// The linear spring and dashpot of K (2) between two spheres, F_N = k ξ + γ_N m̄ ξ̇ with the overlap
/// ξ and the reduced mass m̄, as a collision of given speed sees it: ξ̈ + γ_N ξ̇ + ω0² ξ = 0.
///
/// Symbols: ω0 = √(k/m̄) (√(2k/m) for equal masses), ω = √(ω0² − γ_N²/4), ε = γ_N/ω0.
class LinearContact {
 public:
  /// When the contact counts as ended.
  enum class End {
    zero_overlap,  ///< ξ = 0: the force attracts at the very end
    zero_force,    ///< F_N = 0: K's clamp
  };

  /// reduced_mass [kg] and stiffness k [N/m] > 0; damping_rate γ_N [1/s] in [0, 2 ω0).
  LinearContact(double reduced_mass, double stiffness, double damping_rate, End end);

  /// The contact that has these, by the end rule's own relation. restitution e_n in (0, 1],
  /// collision_time t_col [s] or stiffness [N/m] > 0. Under zero_force, e_n below e^−2 would need
  /// more than critical damping: std::domain_error, with the range that can be reached.
  static LinearContact with_collision_time(double reduced_mass, double restitution,
                                           double collision_time, End end);
  static LinearContact with_stiffness(double reduced_mass, double restitution, double stiffness,
                                      End end);

  double reduced_mass() const { return reduced_mass_; }             ///< m̄ [kg]
  double stiffness() const { return stiffness_; }                   ///< k [N/m]
  double damping_rate() const { return damping_rate_; }             ///< γ_N [1/s]
  double contact_frequency() const { return omega0_; }              ///< ω0 [1/s]
  double damping_ratio() const { return damping_rate_ / omega0_; }  ///< ε [-]

  /// Duration of a collision [s], the same for all speeds: π/ω under zero_overlap.
  double collision_time() const;
  /// e_n [-]: exp(−γ_N t_col/2) under zero_overlap, slightly larger for the same γ_N under
  /// zero_force.
  double restitution() const;
  /// Largest overlap [m] of a collision that begins with the speed v [m/s].
  double largest_overlap(double v) const;

 private:
  double reduced_mass_, stiffness_, damping_rate_;
  double omega0_, omega_;
  End end_;
};

/// C = π A γ_S/(2 ω0), K (55): to first order the share of Ω_i + Ω_j that the vertical rubbing
/// takes from each; exactly ½ (1 − e^(−2C)) without the Coulomb cap.
double rubbing_constant(double A, double tangential_damping_rate, double contact_frequency);
double rubbed_share(double rubbing_constant);

}  // namespace slipcheck
