#pragma once

#include <stdexcept>
#include <string>

#include "physics/contact/normal_force.h"

namespace slipcheck {

/// A law of normal force without its units. With the overlap in L and the time in T = L/v, where
/// m v² = E L^(1+α) for the impact speed v and the elastic force E ξ^α, a collision begins with
/// x = 0, ẋ = 1 and obeys
///   ẍ = −x^α − D x^γ ẋ, or for B (25) ẍ = −(x + D ẋ)^{3/2}:
/// all that depends on masses, moduli and speed is the one number D.
struct ScaledLaw {
  double alpha = 1.5;    ///< [-], >= 1
  double gamma = 0.5;    ///< [-], >= 0
  bool compact = false;  ///< B (25)

  /// D is in proportion to v^p [-]; B (24): 1/5, spring and dashpot: 0.
  double speed_exponent() const {
    return compact ? (alpha - 1) / (1 + alpha) : (1 + 2 * gamma - alpha) / (1 + alpha);
  }
};

/// −ẍ of the scaled law at x and ẋ, odd in x.
double scaled_force(const ScaledLaw& law, double D, double x, double rate);

/// A function of its sign without the power of x that vanishes at the first touch.
double scaled_force_sign(const ScaledLaw& law, double D, double x, double rate);

/// What turns a collision into one of the scaled law and back.
struct ImpactScales {
  ScaledLaw law;
  double dissipation = 0;  ///< D [-], >= 0
  double length = 1;       ///< L [m]
  double time = 1;         ///< T [s]
};

/// reduced_mass [kg] and speed [m/s] > 0.
ImpactScales impact_scales(const NormalForce& force, double reduced_mass, double speed);

/// The force with its dissipative coefficient (c, η, A) set so that D is this at these scales.
/// HertzForce has none and stays.
NormalForce with_dissipation(NormalForce force, double reduced_mass, double speed, double D);

/// One collision along the line of centres.
struct Impact {
  double restitution = 1;         ///< −ξ̇ at the end over the impact speed [-], in [0, 1]
  double duration = 0;            ///< [s]; infinite, with restitution 0, if the spheres stay
  double largest_overlap = 0;     ///< [m]
  double largest_overlap_at = 0;  ///< time after the first touch [s]
};

/// The collision of the scaled law, integrated to the relative tolerance; its lengths and times are
/// in L and T. From D = 1e7 on every law gives back less than 1e-7 of the impact speed: that counts
/// as spheres that stay, restitution 0 and infinite times. Throws IntegrationFailure.
Impact scaled_impact(const ScaledLaw& law, double D, ContactEnd end, double tolerance);

/// No dissipation gives this restitution.
struct UnreachableRestitution : std::domain_error {
  explicit UnreachableRestitution(const std::string& reachable)
      : std::domain_error("restitution " + reachable), rule(reachable) {}
  std::string rule;  ///< "must be in [0.1, 1]"
};

/// The D at which the scaled law has this restitution, in (0, 1]. Throws UnreachableRestitution
/// where there is none.
double dissipation_for(const ScaledLaw& law, ContactEnd end, double restitution);

}  // namespace slipcheck
