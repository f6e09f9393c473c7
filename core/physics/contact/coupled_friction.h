#pragma once

namespace slipcheck {

/// Friction of a disc that slides and spins at once, per μ N: each element of the contact rubs
/// against its own velocity (Contensou 1963, Zhuravlev 1998).
struct CoupledFriction {
  double force;   ///< |F|/(μ N) against the slip [-], in [0, 1]; 1 without spin
  double torque;  ///< |M|/(μ N a_c) against the spin [-], >= 0; 2/3 (uniform pressure) or 3π/16
                  ///< (Hertzian) without slip
};

enum class DiscPressure { uniform, hertzian };

/// slip |u| [m/s] of the disc's centre and rim speed a_c |Ω_z| [m/s], both >= 0, not both 0. The
/// exact integral over the disc in closed form.
CoupledFriction coupled_friction(DiscPressure pressure, double slip, double rim_speed);

}  // namespace slipcheck
