#pragma once

#include <cmath>
#include <string>

#include "studies/gas/gas_run.h"

namespace slipcheck::test {

/// Solid spheres of 1 mm and 1 mg that begin at 1 m/s.
inline GasSetup small_gas(int dimensions, std::size_t particles) {
  GasSetup setup;
  setup.sphere = {1e-3, 1e-6, 0.4};
  setup.dimensions = dimensions;
  setup.particles = particles;
  return setup;
}

inline GasLaw smooth(double e) { return hard_gas({.restitution = e}, small_gas(3, 16).sphere); }
inline GasLaw rough(double e, double friction, double beta0) {
  return hard_gas({.restitution = e, .friction = friction, .tangential_restitution = beta0},
                  small_gas(3, 16).sphere);
}

/// T and T_rot [J] of all particles.
inline GasTemperatures temperatures(const Gas& gas) {
  const GasSetup& setup = gas.setup();
  const double D = setup.dimensions, n = static_cast<double>(setup.particles);
  GasTemperatures sum;
  for (std::size_t k = 0; k < setup.particles; ++k) {
    const BodyState state = gas.particle(k);
    sum.translation += setup.sphere.mass * state.velocity.squaredNorm();
    sum.rotation += setup.sphere.moment_of_inertia() * state.angular_velocity.squaredNorm();
  }
  return {sum.translation / (n * D), sum.rotation / (n * D * (D - 1) / 2)};
}

/// Statements of this name, in their order.
inline std::vector<GasStatement> stated(const GasRun& run, const std::string& name) {
  std::vector<GasStatement> found;
  for (const GasStatement& each : run.statements)
    if (each.name == name) found.push_back(each);
  return found;
}
inline constexpr const char* kCooling = "cooling per collision";
inline constexpr const char* kExponent = "exponent of T(t)";

}  // namespace slipcheck::test
