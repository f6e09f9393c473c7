#pragma once

namespace slipcheck {

// The largest time steps [s] with which explicit schemes integrate the linear contact
// ξ̈ + γ ξ̇ + ω0² ξ = 0 without growth of the amplitude. Each step is (ξ, ξ̇) → M (ξ, ξ̇) with a
// constant amplification matrix M, whose eigenvalues λ must all have |λ| <= 1. For a 2×2 matrix
// that is |det M| <= 1 and |tr M| <= 1 + det M.
//
// omega0 [1/s], > 0: ω0 = √(k/m̄), √(2k/m) for equal spheres. gamma [1/s], >= 0: γ_N.

/// Symplectic Euler: ξ̇ += −h (γ ξ̇ + ω0² ξ), then ξ += h ξ̇. det M = 1 − hγ and
/// tr M = 2 − hγ − h²ω0²; tr M = −1 − det M first, at h²ω0² + 2hγ = 4, where hγ is below 2:
///   h = (√(γ² + 4ω0²) − γ)/ω0², without damping 2/ω0.
double symplectic_euler_limit(double omega0, double gamma);

/// Velocity Verlet on the undamped contact. det M = 1 and tr M = 2 − h²ω0²: h = 2/ω0.
double velocity_verlet_limit(double omega0);

/// Explicit Euler: λ = 1 + hΛ with Λ = −γ/2 ± iω, |λ|² = 1 − hγ + h²ω0²: h = γ/ω0², without damping
/// 0. From critical damping on Λ is real and h = 2/|Λ| for the larger |Λ| = γ/2 + √(γ²/4 − ω0²).
double explicit_euler_limit(double omega0, double gamma);

/// The classical fourth-order Runge-Kutta scheme on the undamped contact. λ = Σ (ihω0)^k/k! up to
/// k = 4, |λ|² = 1 − (hω0)⁶/72 + (hω0)⁸/576: h = 2√2/ω0.
double runge_kutta_limit(double omega0);

}  // namespace slipcheck
