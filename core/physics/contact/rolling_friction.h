#pragma once

#include <cstddef>
#include <vector>

namespace slipcheck {

/// Rolling friction μ_r as a function of the speed |v − v_S|, K (16): |a_R| = μ_r |F_N|/m.
/// Linear between the points of a table and constant beyond its ends; a constant is a table of one
/// point.
class RollingFriction {
 public:
  struct Point {
    double speed;        ///< [m/s], >= 0, rising from point to point
    double coefficient;  ///< μ_r [-], >= 0
  };

  /// μ_r = 0.
  RollingFriction() : points_{{0, 0}} {}
  explicit RollingFriction(double coefficient) : points_{{0, coefficient}} {}
  /// points: at least one, speeds rising strictly.
  explicit RollingFriction(std::vector<Point> points) : points_(std::move(points)) {}

  /// μ_r at a speed [m/s], >= 0.
  double operator()(double speed) const;

  /// Largest μ_r at any speed up to `speed` [m/s].
  double largest_up_to(double speed) const;

  bool is_zero() const;
  bool is_constant() const { return points_.size() == 1; }
  const std::vector<Point>& points() const { return points_; }

  /// The piece of the table in which a body that moves at `speed` [m/s], > 0, and slows down is:
  /// μ_r(v) = coefficient + slope (v − speed) for lower_speed <= v <= speed.
  struct Piece {
    double coefficient;  ///< μ_r at the speed itself [-]
    double slope;        ///< dμ_r/dv [s/m]
    double lower_speed;  ///< [m/s]
  };
  Piece piece_below(double speed) const;

 private:
  std::vector<Point> points_;
};

}  // namespace slipcheck
