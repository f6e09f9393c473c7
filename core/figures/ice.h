#pragma once

#include <compare>
#include <cstddef>
#include <string>
#include <vector>

#include "physics/contact/elastic_pair.h"
#include "physics/contact/normal_force.h"

namespace slipcheck {

/// B's spheres of ice at low temperature, Figs. 1, 2.
struct IceParameters {
  double young_modulus = 1e10;  ///< Y [Pa]
  double poisson_ratio = 0.3;   ///< ν [-]
  double density = 1000;        ///< ρ [kg/m³]
  double radius = 1e-2;         ///< R [m]
};
inline constexpr IceParameters kIce{};
Sphere ice_sphere();
std::string ice_caption();

/// What the normal law sees of two bodies of ice.
struct IceImpact {
  double mass;     ///< m_eff [kg]
  double modulus;  ///< ρ of Hertz' law [N/m^1.5]
};
IceImpact ice_on_wall();  ///< R_eff = R, m_eff = m: as it was measured
IceImpact ice_pair();     ///< R_eff = R/2, m_eff = m/2

/// A law of viscous spheres, and when its contact ends.
struct IceLaw {
  bool compact;    ///< B (25), else (24)
  ContactEnd end;  ///< under zero_overlap (24) attracts at the end

  NormalForce force(const IceImpact& ice, double dissipation_time) const;
  /// ε^N [-] at A [s] and an impact speed [m/s].
  double restitution(const IceImpact& ice, double dissipation_time, double speed) const;

  auto operator<=>(const IceLaw&) const = default;
};
inline constexpr IceLaw kIceLaw{true, ContactEnd::zero_force};  ///< with which B's figures are made
inline constexpr IceLaw kExpandedIceLaw{false, ContactEnd::zero_overlap};

/// ε of Bridges, Hatzes and Lin, and the speeds [m/s] at which they measured.
double measured_restitution(double speed);
inline constexpr double kSlowestIce = 0.015e-2, kFastestIce = 5e-2;
inline constexpr std::size_t kIceSpeeds = 41;  ///< of a fit

struct IceFit {
  double dissipation_time = 0;  ///< A [s]
  double deviation = 0;         ///< root mean square of ε^N [-]
};
/// A by least squares of ε^N over these speeds [m/s].
IceFit fitted(const IceLaw& law, const IceImpact& ice, const std::vector<double>& speeds);
/// That of a law for two spheres at speeds even in v, computed when first asked for: B Fig. 2 takes
/// the A of Fig. 1.
IceFit ice_pair_fit(const IceLaw& law = kIceLaw);

}  // namespace slipcheck
