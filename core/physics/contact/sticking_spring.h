#pragma once

namespace slipcheck {

/// The tangential spring and dashpot of a contact that sticks, per mass κ m_eff that it moves:
/// u̇ = −ω² s − 2 ζ ω u, ṡ = u.
struct StickingSpring {
  double frequency = 0;  ///< ω [1/s]
  double damping = 0;    ///< ζ [-]
};

/// The spring that after a collision of `duration` [s], > 0, leaves −β of a slip that sticks all
/// through it; β in [−1, 1).
///
/// From s = 0, u(t)/u(0) = e^(−a φ) (cos φ − a sin φ), φ = ω √(1 − ζ²) t, a = ζ/√(1 − ζ²), which
/// falls from 1 to −e^(−a φ') at φ' = π − 2 atan a. The damping is a = 1/2, or less where β asks
/// for more of the slip: then half of what that extreme allows. Without damping −β = cos(π √(k_t/(κ
/// k_n))) for a linear contact of an undamped k_n: 1 for k_t/k_n = κ, 2/7 for solid spheres.
StickingSpring sticking_spring(double beta, double duration);

}  // namespace slipcheck
