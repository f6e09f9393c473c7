#pragma once

#include "physics/vector.h"

namespace slipcheck {

/// Dry friction against a constant drive in closed form: ẇ = F − p ŵ, w the velocity relative to
/// the substrate, for a body that slides across a slope.
///
/// With dt = |w| dτ the equation is linear in (w, |w|), and with a = w·F̂ and b across it
///   |w| + a = P e^(−(p−F)τ),  |w| − a = Q e^(−(p+F)τ),  b = b_0 e^(−pτ),
///   t = ½ [P E(p−F) + Q E(p+F)],  E(k) = (1 − e^(−kτ))/k;
/// at τ → ∞ the motion ends if p > F.
class ConstantDriveSlide {
 public:
  ConstantDriveSlide() = default;
  /// drive F [m/s²], friction p [m/s²], >= 0, velocity w at t = 0 [m/s], not zero.
  ConstantDriveSlide(const Vector2& drive, double friction, const Vector2& velocity);

  /// When w reaches zero [s], or infinity.
  double end() const { return end_; }
  Vector2 velocity(double t) const;      ///< w [m/s], t in [0, end()]
  Vector2 displacement(double t) const;  ///< ∫w dt [m]

 private:
  double time_at(double tau) const;
  double tau_at(double t) const;

  Vector2 along_ = Vector2::UnitX();  // F̂
  double P_ = 0, Q_ = 0, b_ = 0;      // [m/s]
  double slow_ = 0, fast_ = 0;        // p − F, p + F [m/s²]
  double friction_ = 0;
  double end_ = 0;
};

}  // namespace slipcheck
