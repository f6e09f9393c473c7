#pragma once

namespace slipcheck {

// The laws of B hold for quasistatic collisions: slow against sound, so that the stress is that of
// spheres at rest, and long against the viscous relaxation, so that the dissipation is of first
// order in the rate. Where "much smaller" ends is a choice of this project.

/// One collision against both conditions.
struct QuasistaticCheck {
  /// The waves that a collision leaves in the spheres take about (g/c)^(3/5) of its energy (Hunter
  /// 1957): some per cent at this ratio.
  static constexpr double kLargestSpeedRatio = 0.01;
  /// The next order of the dissipation is about A/t_c of the first.
  static constexpr double kLargestTimeRatio = 0.1;

  double speed_ratio = 0;  ///< g/c, c = √(Y/ρ), B (11): ≪ 1 [-]
  double time_ratio = 0;   ///< A/t_c, the viscous time over the duration, B (12): ≪ 1 [-]

  bool too_fast() const { return speed_ratio > kLargestSpeedRatio; }
  bool too_viscous() const { return time_ratio > kLargestTimeRatio; }
};

/// impact_speed g [m/s], sound c [m/s], dissipation_time A [s], collision_time t_c [s].
inline QuasistaticCheck quasistatic_check(double impact_speed, double sound,
                                          double dissipation_time, double collision_time) {
  return {impact_speed / sound, dissipation_time / collision_time};
}

}  // namespace slipcheck
