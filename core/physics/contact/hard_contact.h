#pragma once

#include <algorithm>
#include <cmath>
#include <variant>

#include "physics/contact/rolling_friction.h"
#include "physics/contact/tabulated_restitution.h"

namespace slipcheck {

/// Restitution that falls with the impact speed as a power law,
/// e = min(1, coefficient (g/speed)^−exponent); Bridges, Hatzes and Lin: 0.32 (v/(1 cm/s))^−0.234.
struct PowerLawRestitution {
  double coefficient = 0.32;  ///< [-], > 0
  double exponent = 0.234;    ///< [-], >= 0
  double speed = 0.01;        ///< reference speed [m/s], > 0
};

/// Coefficient of normal restitution: a number in [0, 1] or a law over the impact speed.
using RestitutionLaw = std::variant<double, PowerLawRestitution, TabulatedRestitution>;

/// e at the normal impact speed g [m/s], > 0.
inline double restitution_at(const RestitutionLaw& law, double g) {
  if (const double* e = std::get_if<double>(&law)) return *e;
  if (const auto* table = std::get_if<TabulatedRestitution>(&law)) return (*table)(g);
  const auto& power = std::get<PowerLawRestitution>(law);
  return std::min(1.0, power.coefficient * std::pow(g / power.speed, -power.exponent));
}

/// Two hard spheres that touch, L (5)-(12).
struct PairContact {
  RestitutionLaw restitution = 1.0;
  double friction = 0;                 ///< Coulomb coefficient μ between the spheres [-], >= 0
  double tangential_restitution = -1;  ///< β0, cap of β in u_t' = −β u_t [-], in [−1, 1]
};

/// A sphere of one material on the substrate.
struct SubstrateContact {
  double static_friction = 0;   ///< μ_s [-], >= kinetic_friction
  double kinetic_friction = 0;  ///< μ_k [-], >= 0
  RollingFriction rolling;      ///< μ_r
  /// Drilling torque about the vertical per normal force [m], >= 0, uncoupled from the sliding:
  /// (2/3) μ_k a_c for a uniform contact disc of radius a_c, (3π/16) μ_k a_c for a Hertzian one.
  double drilling_length = 0;
  /// Radius a_c of a contact disc on which sliding and drilling share the friction (Contensou,
  /// Zhuravlev; coupled_friction.h) [m]; 0: uncoupled. `drilling_length` is then that of pure
  /// drilling.
  double coupled_radius = 0;
  bool hertzian_pressure = false;      ///< on that disc; uniform otherwise
  bool rolling_while_sliding = false;  ///< rolling friction acts on a sliding body too
  double restitution = 0;  ///< for a body that comes down on the substrate [-], in [0, 1]
};

}  // namespace slipcheck
