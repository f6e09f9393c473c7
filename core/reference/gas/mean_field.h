#pragma once

#include <span>
#include <vector>

#include "physics/granular_gas.h"
#include "reference/gas/gas.h"

namespace slipcheck {

/// T and T_rot [J].
struct GasTemperatures {
  double translation = 0, rotation = 0;
};

/// Change of both with the collisions of a particle, if velocities and spins are Maxwellian and
/// independent: Huthmann and Zippelius' mean field with any law.
///
/// In units of √(2T/m) the normal speed has the density x exp(−x²/2); each component of u_t is
/// normal with the variance σ² = (2/m)(T + T_rot/q), of which c = T/(T + T_rot/q) is of the
/// velocities. A collision with e and η at (u_n, u_t) changes the energies by
///   ΔE     = −(m/4)(1 − e²) u_n² + m u_t² (η² − c η),
///   ΔE_rot = m u_t² (η²/q − (1 − c) η),
/// averaged by Simpson's rule.
GasCooling mean_field_cooling(const GasLaw& law, const Sphere& sphere, int dimensions,
                              const GasTemperatures& now);

/// Both temperatures at rising times [s] > 0, from those of the setup at time 0: dτ/dt is the
/// collision rate of a Maxwellian.
std::vector<GasTemperatures> mean_field_course(const GasLaw& law, const GasSetup& setup,
                                               std::span<const double> times);

}  // namespace slipcheck
