#pragma once

namespace slipcheck::mujoco {

/// A spring and a damper per unit of mass: a = −k ξ − b ξ̇ of an overlap ξ while that pushes.
struct Spring {
  double stiffness = 0;  ///< k [1/s²]
  double damping = 0;    ///< b [1/s]
};

/// The rebound of such a spring that lets go where its force is zero, over the impact speed. With
/// ζ = b/(2 √k): e = exp(−2 ζ acos(ζ)/√(1 − ζ²)), and with acosh and ζ² − 1 beyond ζ = 1.
/// From ξ ∝ e^{−ζt} sin(√(1−ζ²) t), whose second derivative vanishes at √(1−ζ²) t = 2 acos ζ.
double rebound_of(double damping_ratio);

/// The spring with this restitution, in (0, 1], whose contact lasts `duration` [s], > 0.
Spring spring_of(double restitution, double duration);

}  // namespace slipcheck::mujoco
