#pragma once

#include <array>

#include "physics/motion/drive.h"

namespace slipcheck {

/// Friction against the velocity w relative to the substrate: p + s|w|, p [m/s²] and s [1/s]. It
/// holds for speeds in [slowest, fastest] [m/s], a piece of a table of rolling friction.
struct DryFriction {
  double constant = 0;  ///< p [m/s²]
  double slope = 0;     ///< s [1/s]
  double slowest = 0, fastest = 1e300;
};

/// A piece of ẇ = F(t) − (p + s|w|) ŵ as a power series in t.
///
/// Error bound: for s >= 0, p >= 0 two solutions approach each other (the friction is monotonic in
/// w), so that the error at the end is at most the integral of the defect ẇ − F + (p + s|w|) ŵ over
/// the piece. A piece ends where that, the defect at its end times its length, exceeds `tolerance`.
class SeriesSlide {
 public:
  static constexpr int kOrder = 20;
  using Series = std::array<double, kOrder + 1>;

  SeriesSlide() = default;
  /// From the velocity w [m/s], which may be zero where |F| >= p at once or rises beyond it.
  /// tolerance [m/s], > 0.
  SeriesSlide(const Drive& drive, const DryFriction& friction, const Vector2& velocity,
              double tolerance);

  /// How long the piece is valid [s]; 0 if not at all.
  double reach() const { return reach_; }
  Vector2 velocity(double t) const;      ///< w [m/s], t in [0, reach()]
  Vector2 displacement(double t) const;  ///< ∫w dt [m]

  /// The first time in (0, reach()] at which w goes against its first direction, or infinity. Only
  /// a w that goes through zero, or past it within a quarter turn, does so.
  double reversal() const;
  /// The first time in (0, reach()] at which |w| leaves [slowest, fastest], or infinity.
  double exit(double slowest, double fastest) const;

 private:
  void expand(const Drive& drive, const DryFriction& friction, const Vector2& velocity);
  void expand_from_rest(const Drive& drive, const DryFriction& friction);
  void expand_slow(const Drive& drive, const DryFriction& friction, double speed);
  void find_reach(const Drive& drive, const DryFriction& friction, double tolerance);

  Series x_{}, y_{};     // of w
  int first_power_ = 0;  // of the lowest term that is not zero
  double reach_ = 0;
};

}  // namespace slipcheck
