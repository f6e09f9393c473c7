#pragma once

#include "physics/vector.h"

namespace slipcheck {

/// What a body is. A block slides on a face and never turns; a cylinder lies on its side and moves
/// across its axis.
enum class Shape { sphere, block, cylinder };

/// A homogeneous or hollow sphere, or what slides and rolls by the same laws.
struct Sphere {
  double radius = 0;              ///< R [m], > 0; of a block half its height
  double mass = 0;                ///< m [kg], > 0
  double shape_factor = 2.0 / 5;  ///< q = I/(m R²) [-], > 0: 2/5 solid, 2/3 shell, 1/2 disk, 1 ring
  Shape shape = Shape::sphere;

  /// I = q m R² [kg m²]; of a cylinder about its axis, of a block about the vertical.
  double moment_of_inertia() const { return shape_factor * mass * radius * radius; }
  /// K's A = m R²/I = 1/q [-]: how much more friction changes the slip than the velocity. 0 for a
  /// block, which friction does not turn.
  double inverse_shape_factor() const { return shape == Shape::block ? 0 : 1 / shape_factor; }
};

/// The extent of a block or cylinder.
struct Extent {
  /// Lengths of a block's edges along its first horizontal axis, the second one and z; of a
  /// cylinder its length and, twice, its diameter [m], > 0.
  Vector3 size = Vector3::Zero();
  Vector2 axis = Vector2::UnitX();  ///< where the first one points, a unit vector in the plane
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

/// The same of a body: a block's face moves with its centre.
inline Vector3 slip_velocity(const BodyState& state, const Sphere& body) {
  return body.shape == Shape::block ? state.velocity : slip_velocity(state, body.radius);
}

/// Angular velocity [rad/s] of rolling without slip at horizontal velocity v [m/s] relative to the
/// substrate: Ω = k̂×v/R, from u = 0.
inline Vector3 rolling_angular_velocity(const Vector3& v, double radius) {
  return Vector3(-v.y(), v.x(), 0) / radius;
}

}  // namespace slipcheck
