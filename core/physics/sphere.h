#pragma once

#include "physics/vector.h"

namespace slipcheck {

/// A homogeneous or hollow sphere.
struct Sphere {
  double radius = 0;              ///< R [m], > 0
  double mass = 0;                ///< m [kg], > 0
  double shape_factor = 2.0 / 5;  ///< q = I/(m R²) [-], > 0: 2/5 solid, 2/3 shell, 1/2 disk, 1 ring

  /// I = q m R² [kg m²].
  double moment_of_inertia() const { return shape_factor * mass * radius * radius; }
  /// K's A = m R²/I = 1/q [-].
  double inverse_shape_factor() const { return 1 / shape_factor; }
};

/// The state of one sphere at one instant.
struct BodyState {
  Vector3 position = Vector3::Zero();          ///< centre [m]
  Vector3 velocity = Vector3::Zero();          ///< of the centre [m/s]
  Vector3 angular_velocity = Vector3::Zero();  ///< [rad/s]
};

/// Velocity [m/s] of the sphere's lowest point, v + R k̂×Ω: on a still substrate the slip velocity
/// u of K (11), (18) together with the vertical velocity.
inline Vector3 slip_velocity(const BodyState& state, double radius) {
  const Vector3& w = state.angular_velocity;
  return state.velocity + radius * Vector3(-w.y(), w.x(), 0);
}

/// Angular velocity [rad/s] of rolling without slip at horizontal velocity v [m/s] relative to the
/// substrate: Ω = k̂×v/R, from u = 0.
inline Vector3 rolling_angular_velocity(const Vector3& v, double radius) {
  return Vector3(-v.y(), v.x(), 0) / radius;
}

}  // namespace slipcheck
