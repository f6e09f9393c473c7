#pragma once

#include <algorithm>
#include <cmath>
#include <variant>

namespace slipcheck {

/// When a soft contact counts as ended.
enum class ContactEnd {
  zero_overlap,  ///< ξ = 0: the force may attract at the very end
  zero_force,    ///< F_N = 0 while it falls: K's clamp; F_N is never negative
};

// Normal forces between two spheres over the overlap ξ [m], >= 0, and its rate ξ̇ [m/s], > 0 while
// they approach. F_N [N] is repulsive where positive. Each law also tells its elastic part and the
// energy stored in it; what is left of F_N dissipates; and what has the sign of dF_N/dt where the
// rate itself changes at `acceleration` [m/s²]: dF_N/dt times the power of ξ that takes a
// singularity at ξ = 0 away. For ξ slightly below 0, where an integrator
// looks before it finds the end of a contact, every law goes on smoothly (odd in ξ).

/// K (2): F_N = k ξ + c ξ̇ with c = γ_N m̄.
struct LinearForce {
  double stiffness = 0;  ///< k [N/m], > 0
  double damping = 0;    ///< c = γ_N m̄ [N s/m], >= 0

  double elastic(double overlap) const { return stiffness * overlap; }
  double energy(double overlap) const { return 0.5 * stiffness * overlap * overlap; }
  double operator()(double overlap, double rate) const {
    return stiffness * overlap + damping * rate;
  }
  double growth(double, double rate, double acceleration) const {
    return stiffness * rate + damping * acceleration;
  }
};

/// Elastic spheres, the limit A = 0 of B (24): F_N = ρ ξ^{3/2}, ρ = (4/3) E* √R_eff.
struct HertzForce {
  double modulus = 0;  ///< ρ [N/m^1.5], > 0

  double elastic(double overlap) const { return modulus * overlap * std::sqrt(std::abs(overlap)); }
  double energy(double overlap) const { return 0.4 * overlap * elastic(overlap); }
  double operator()(double overlap, double) const { return elastic(overlap); }
  double growth(double, double rate, double) const { return rate; }
};

/// K (B1): F_N = E ξ^α + η ξ^γ ξ̇.
struct PowerForce {
  double modulus = 0;    ///< E [N/m^α], > 0
  double viscosity = 0;  ///< η [N s/m^(1+γ)], >= 0
  double alpha = 1.5;    ///< [-], >= 1
  double gamma = 0.5;    ///< [-], >= 0

  double elastic(double overlap) const {
    return modulus * std::copysign(std::pow(std::abs(overlap), alpha), overlap);
  }
  double energy(double overlap) const { return overlap * elastic(overlap) / (1 + alpha); }
  double operator()(double overlap, double rate) const {
    return elastic(overlap) + viscosity * std::pow(std::abs(overlap), gamma) * rate;
  }
  double growth(double overlap, double rate, double acceleration) const {
    if (viscosity == 0) return rate;
    // E α ξ^(α−1) ξ̇ + η (γ ξ^(γ−1) ξ̇² + ξ^γ ξ̈)
    const double lowest = std::min(alpha, gamma), size = std::abs(overlap);
    return modulus * alpha * std::pow(size, alpha - lowest) * rate +
           viscosity * std::pow(size, gamma - lowest) *
               (gamma * rate * rate + overlap * acceleration);
  }
};

/// B (24): F_N = ρ (ξ^{3/2} + (3/2) A √ξ ξ̇), A the dissipation time of B (23).
struct ViscoelasticForce {
  double modulus = 0;           ///< ρ [N/m^1.5], > 0
  double dissipation_time = 0;  ///< A [s], >= 0

  double elastic(double overlap) const { return modulus * overlap * std::sqrt(std::abs(overlap)); }
  double energy(double overlap) const { return 0.4 * overlap * elastic(overlap); }
  double operator()(double overlap, double rate) const {
    return modulus * std::sqrt(std::abs(overlap)) * (overlap + 1.5 * dissipation_time * rate);
  }
  double growth(double overlap, double rate, double acceleration) const {
    // (3/2) ρ (√ξ ξ̇ + A (ξ̇²/(2√ξ) + √ξ ξ̈))
    return overlap * rate + dissipation_time * (0.5 * rate * rate + overlap * acceleration);
  }
};

/// B (25), of which (24) is the expansion to first order in A: F_N = ρ (ξ + A ξ̇)^{3/2}.
struct CompactViscoelasticForce {
  double modulus = 0;           ///< ρ [N/m^1.5], > 0
  double dissipation_time = 0;  ///< A [s], >= 0

  double elastic(double overlap) const { return modulus * overlap * std::sqrt(std::abs(overlap)); }
  double energy(double overlap) const { return 0.4 * overlap * elastic(overlap); }
  double operator()(double overlap, double rate) const {
    return elastic(overlap + dissipation_time * rate);
  }
  double growth(double, double rate, double acceleration) const {
    return rate + dissipation_time * acceleration;
  }
};

using NormalForce =
    std::variant<LinearForce, HertzForce, PowerForce, ViscoelasticForce, CompactViscoelasticForce>;

/// F_N [N] of whichever law.
inline double normal_force(const NormalForce& law, double overlap, double rate) {
  return std::visit([&](const auto& force) { return force(overlap, rate); }, law);
}

/// What has the sign of dF_N/dt, of whichever law.
inline double force_growth(const NormalForce& law, double overlap, double rate,
                           double acceleration) {
  return std::visit([&](const auto& force) { return force.growth(overlap, rate, acceleration); },
                    law);
}

}  // namespace slipcheck
