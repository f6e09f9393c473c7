#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

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

/// Friction that falls with the speed of slip, μ = a + b e^(−c v); of pool balls
/// 9.951e-3 + 0.108 e^(−1.088 v/(m/s)) (Alciatore, TP A.14).
struct ExponentialFriction {
  double a = 0;  ///< [-], >= 0
  double b = 0;  ///< [-], >= 0
  double c = 0;  ///< [s/m], >= 0
};
/// A table of μ over the speed of slip: linear between its points and constant outside, as that of
/// rolling friction is.
using TabulatedFriction = RollingFriction;

/// Coulomb coefficient μ of an impact: a number >= 0 or a law over the speed of slip at the
/// beginning of the impact, which holds until its end.
struct FrictionLaw : std::variant<double, TabulatedFriction, ExponentialFriction> {
  FrictionLaw(double mu = 0) : variant(mu) {}                          // NOLINT: a number is a law
  FrictionLaw(TabulatedFriction table) : variant(std::move(table)) {}  // NOLINT
  FrictionLaw(ExponentialFriction law) : variant(law) {}               // NOLINT
};

/// Whether it is this number.
inline bool operator==(const FrictionLaw& law, double mu) {
  const double* number = std::get_if<double>(&law);
  return number && *number == mu;
}

/// μ at the speed of slip v [m/s], >= 0.
inline double friction_at(const FrictionLaw& law, double v) {
  if (const double* mu = std::get_if<double>(&law)) return *mu;
  if (const auto* table = std::get_if<TabulatedFriction>(&law)) return (*table)(v);
  const auto& falling = std::get<ExponentialFriction>(law);
  return falling.a + falling.b * std::exp(-falling.c * v);
}
/// The same law where speeds are counted in units of which `factor` make one of before.
FrictionLaw with_speeds_times(const FrictionLaw& law, double factor);

/// Whether there is friction at any speed.
inline bool has_friction(const FrictionLaw& law) {
  if (const double* mu = std::get_if<double>(&law)) return *mu > 0;
  if (const auto* table = std::get_if<TabulatedFriction>(&law)) return !table->is_zero();
  const auto& falling = std::get<ExponentialFriction>(law);
  return falling.a > 0 || falling.b > 0;
}

/// Two hard spheres that touch, L (5)-(12).
struct PairContact {
  RestitutionLaw restitution = 1.0;
  FrictionLaw friction = {};           ///< Coulomb's, between the spheres
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
