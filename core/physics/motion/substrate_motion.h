#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "physics/vector.h"

namespace slipcheck {

/// Prescribed horizontal motion of the substrate, x_S(t), K (11)-(15).
class SubstrateMotion {
 public:
  enum class Kind { still, constant, oscillation, table };
  struct Point {
    double time;       ///< [s]
    Vector2 position;  ///< [m]
  };

  /// At rest.
  SubstrateMotion() = default;
  /// velocity [m/s], the same for all times.
  static SubstrateMotion constant(const Vector2& velocity);
  /// x_S = amplitude sin(2π frequency t + phase): amplitude [m], frequency [Hz] > 0, phase [rad].
  static SubstrateMotion oscillation(const Vector2& amplitude, double frequency, double phase);
  /// Linear between points of rising times, at rest outside.
  static SubstrateMotion table(std::vector<Point> points);

  /// A motion that never moves may be `still` however it was made.
  Kind kind() const { return kind_; }
  /// Velocity [m/s] of a constant motion, amplitude [m] of an oscillation.
  const Vector2& vector() const { return vector_; }
  double frequency() const { return frequency_; }               ///< [Hz]
  double phase() const { return phase_; }                       ///< [rad]
  const std::vector<Point>& points() const { return points_; }  ///< of a table

  bool is_still() const { return kind_ == Kind::still; }
  /// The acceleration is zero but for jumps of the velocity.
  bool is_uniform_between_kinks() const { return kind_ != Kind::oscillation; }

  Vector3 position(double t) const;      ///< [m]
  Vector3 velocity(double t) const;      ///< [m/s]; at a kink the one after it
  Vector3 acceleration(double t) const;  ///< [m/s²]; without the jumps at kinks
  /// Largest |velocity| [m/s] at any time.
  double largest_speed() const;
  /// Largest |acceleration| [m/s²] at any time, without the jumps at kinks.
  double largest_acceleration() const;
  /// The first time after t [s] at which the velocity jumps, or infinity.
  double next_kink(double t) const;

 private:
  /// How many of the table's points lie at or before t.
  std::size_t points_until(double t) const;
  /// Velocity on the table once this many points have passed.
  Vector2 slope_after(std::size_t passed) const;

  Kind kind_ = Kind::still;
  Vector2 vector_ = Vector2::Zero();  // velocity or amplitude
  double frequency_ = 0, omega_ = 0, phase_ = 0;
  std::vector<Point> points_;
};

}  // namespace slipcheck
