#pragma once

#include <algorithm>
#include <optional>
#include <variant>

#include "physics/contact/elastic_pair.h"
#include "physics/contact/hard_contact.h"
#include "reference/pair/pair_map.h"

namespace slipcheck {

/// How two equal spheres part: u_n' = −e u_n, u_t' = u_t − 2 η/κ u_t at the contact point.
struct GasBounce {
  double restitution = 1;  ///< e [-]
  double stick = 0;  ///< η = κ (1 − ε^T)/2 [-]: the impulse along the surface is −m η u_t
};

/// The collision of two equal spheres of a gas: L's hard rule, or B's map.
struct GasLaw {
  PairContact hard;
  std::optional<PairMap> map;  ///< in place of the hard rule
  double kappa = 2.0 / 7;      ///< tangential_mass_ratio() of the two [-]

  bool rough() const {
    return map || (has_friction(hard.friction) && hard.tangential_restitution > -1);
  }
  /// Whether e, β0 and μ are numbers, so that the gas has no speed of its own.
  bool constant() const {
    return !map && std::holds_alternative<double>(hard.restitution) &&
           std::holds_alternative<double>(hard.friction);
  }
  double largest_stick() const { return 0.5 * kappa * (1 + hard.tangential_restitution); }

  /// At the normal and tangential speeds of the contact point [m/s], >= 0. L's cap |P_t| <= μ P_n
  /// with P_n = (m/2) (1 + e) u_n is η u_t <= (μ/2) (1 + e) u_n.
  GasBounce at(double u_n, double u_t) const {
    if (map) {
      const PairMap::Restitution both = map->at(u_n, u_t);
      return {both.normal, 0.5 * kappa * (1 - both.tangential)};
    }
    const double e = restitution_at(hard.restitution, u_n);
    if (!rough()) return {e, 0};
    const double cap = 0.5 * friction_at(hard.friction, u_t) * (1 + e) * u_n,
                 most = largest_stick();
    return {e, cap < most * u_t ? cap / u_t : most};
  }
};

inline GasLaw hard_gas(const PairContact& contact, const Sphere& sphere) {
  return {contact, std::nullopt, tangential_mass_ratio(sphere, sphere)};
}

}  // namespace slipcheck
