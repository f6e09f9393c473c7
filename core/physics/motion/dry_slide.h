#pragma once

#include <variant>

#include "physics/motion/constant_drive_slide.h"
#include "physics/motion/drive.h"
#include "physics/motion/series_slide.h"

namespace slipcheck {

/// w = w_0 + ∫F dt − p ŵ t along a line.
struct StraightSlide {
  Drive drive;
  Vector2 start = Vector2::Zero();     ///< w_0 [m/s]
  Vector2 friction = Vector2::Zero();  ///< p ŵ [m/s²]
};

/// A velocity w relative to the substrate under dry friction and a drive,
///   ẇ = F(t) − (p + s|w|) ŵ:
/// the slip of a sliding sphere (F = downhill − a_S, p = (1+A) μ_k g) or the velocity of one that
/// rolls against rolling friction (F = A/(1+A) (downhill − a_S), p + s|w| = μ_r g).
///
/// Exact where w keeps to a line and s = 0, and for a constant F with s = 0. Elsewhere a piece of
/// it as a series, in error by at most kTolerance times the speeds' scale.
class DrySlide {
 public:
  static constexpr double kTolerance = 1e-13;

  DrySlide() = default;
  /// velocity: w at t = 0 [m/s]; if zero, |F| is at p or beyond and moves the body off.
  /// scale: of the speeds in the scene [m/s], > 0 unless nothing moves.
  DrySlide(const Drive& drive, const DryFriction& friction, const Vector2& velocity, double scale);

  /// How long this holds [s], > 0, maybe infinite.
  double duration() const { return duration_; }
  /// w is zero at the end.
  bool stops() const { return stops_; }
  /// w keeps to the line of `direction()`, and the friction is constant.
  bool is_straight() const { return std::holds_alternative<StraightSlide>(path_); }
  const Vector2& direction() const { return direction_; }  ///< ŵ at the start

  Vector2 velocity(double t) const;      ///< w [m/s], t in [0, duration()]
  Vector2 displacement(double t) const;  ///< ∫w dt [m]

 private:
  void go_straight(const Drive& drive, double friction, const Vector2& velocity);
  void go_in_a_piece(const Drive& drive, const DryFriction& friction, const Vector2& velocity,
                     double scale);

  std::variant<StraightSlide, ConstantDriveSlide, SeriesSlide> path_;
  Vector2 direction_ = Vector2::UnitX();
  double duration_ = 0;
  bool stops_ = false;
};

}  // namespace slipcheck
