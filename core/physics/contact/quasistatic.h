#pragma once

namespace slipcheck {

// The laws of B hold for quasistatic collisions: slow against sound, so that the stress is that of
// spheres at rest, and long against the viscous relaxation, so that the dissipation is of first
// order in the rate. Where "much smaller" ends is a choice of this project.

/// One collision against both conditions.
struct QuasistaticCheck {
  /// The waves that a collision leaves in the spheres take about (g/c_t)^(3/5) of its energy
  /// (Hunter 1957): some per cent at this ratio.
  static constexpr double kLargestSpeedRatio = 1e-4;
  /// The next order of the dissipation is about A/t_c of the first.
  static constexpr double kLargestTimeRatio = 0.1;

  double speed_ratio = 0;  ///< (g/c_t)² with the transversal speed of sound, B (B11): ≪ 1 [-]
  /// A/t_c, the viscous time over the duration, B (B12): ≪ 1 [-]. A is the mean of the relaxation
  /// times τ_vis of shear and compression that the contact's deformation takes.
  double time_ratio = 0;

  bool too_fast() const { return speed_ratio > kLargestSpeedRatio; }
  bool too_viscous() const { return time_ratio > kLargestTimeRatio; }
};

/// impact_speed g [m/s], sound c_t [m/s], dissipation_time A [s], collision_time t_c [s].
inline QuasistaticCheck quasistatic_check(double impact_speed, double sound,
                                          double dissipation_time, double collision_time) {
  const double ratio = impact_speed / sound;
  return {ratio * ratio, dissipation_time / collision_time};
}

}  // namespace slipcheck
