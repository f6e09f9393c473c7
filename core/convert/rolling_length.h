#pragma once

#include "physics/sphere.h"

namespace slipcheck {

/// Rolling friction as engines take it that limit the torque by a length times the normal force: ρ
/// [m] of Bullet (setRollingFriction), ODE (dContactRolling), MuJoCo (third friction, condim 6). A
/// sphere on which the torque ρ N acts while it rolls slows by ρ N/((1 + q) m R), q = I/(m R²), and
/// by the scene's μ_r by μ_r N/m:
///   ρ = (1 + q) μ_r R.
double rolling_length(const Sphere& sphere, double coefficient);  ///< [m]
double rolling_coefficient(const Sphere& sphere, double length);  ///< μ_r [-]

}  // namespace slipcheck
