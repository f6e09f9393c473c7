#pragma once

#include "scene/scaled_impact.h"

namespace slipcheck {

/// Up to where the printed law of asperities, B (35), cannot create energy.
///
/// An unbroken asperity is a spring whose stiffness (μ/ζ0) F_N follows the present F_N. With
/// m_eff ξ̈ = −F_N and the mass κ m_eff that it moves,
///   ζ̈ = (μ/(κ ζ0)) ξ̈ ζ,
/// and with the collision of F_N = E ξ^α in its own scales (scaled_impact.h)
///   ζ'' = −Λ x^α ζ, Λ = μ L/(κ ζ0).
/// A slip too slow to break the asperity leaves with ε^T = ζ'(end)/ζ'(0), which depends on Λ alone:
/// 1 at Λ = 0, falling to −1 at the Λ returned here and below −1 after it.
double largest_passive_bend(double alpha);

/// The impact speed [m/s] at which Λ reaches that bound: in faster impacts the printed law can
/// create energy. `at_one`: of the collision at 1 m/s; bend_per_length: μ/(κ ζ0) [1/m], > 0.
double passive_speed(const ImpactScales& at_one, double largest_bend, double bend_per_length);

}  // namespace slipcheck
