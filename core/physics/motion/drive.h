#pragma once

#include "physics/vector.h"

namespace slipcheck {

/// What drives a body on the substrate, per unit mass: downhill − a_S(t), gravity along the plane
/// against the substrate's acceleration,
///   F(t) = steady + swing sin(ω t + phase),
/// t counted from the start of a phase.
struct Drive {
  Vector2 steady = Vector2::Zero();  ///< [m/s²]
  Vector2 swing = Vector2::Zero();   ///< [m/s²]; ω² amplitude of an oscillating substrate
  double omega = 0;                  ///< ω [rad/s], > 0 where there is a swing
  double phase = 0;                  ///< [rad], in [−π, π]
  double phase_error = 0;            ///< of the phase, by the rounding of the time [rad]

  bool is_uniform() const { return swing.isZero(0); }
  bool is_zero() const { return is_uniform() && steady.isZero(0); }
  /// Both parts act along one line, up to rounding.
  bool is_on_a_line() const;
  /// Largest |F| and |Ḟ| at any time [m/s²], [m/s³]; bounds.
  double largest() const { return steady.norm() + swing.norm(); }
  double largest_rate() const { return omega * swing.norm(); }

  Vector2 at(double t) const;
  Vector2 integral(double t) const;         ///< of F over [0, t] [m/s]
  Vector2 double_integral(double t) const;  ///< of that [m]

  /// F times a factor.
  Drive scaled(double factor) const {
    return {factor * steady, factor * swing, omega, phase, phase_error};
  }

  /// The first t >= 0 at which |F| grows beyond `limit` [m/s²], >= 0: what holds gives way. 0 if it
  /// is beyond by more than rounding, or is just about to be; infinity if it never is.
  /// |F|² is quadratic in s = sin(ω t + phase), so that the time is an arcsine.
  double time_beyond(double limit) const;
};

}  // namespace slipcheck
