#include "physics/motion/dry_slide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "physics/numbers.h"

namespace slipcheck {
namespace {

/// The zero of a continuous f in [low, high], f(low) > 0 >= f(high).
template <class Function, class Slope>
double bracketed_zero(const Function& f, const Slope& slope, double low, double high) {
  double t = 0.5 * (low + high);
  for (int n = 0; n < 200; ++n) {
    const double value = f(t);
    (value > 0 ? low : high) = t;
    double next = t - value / slope(t);
    // Near a double zero Newton's steps shorten by halves only; so does the bracket then.
    if (!(next > low && next < high) || n % 8 == 7) next = low + 0.5 * (high - low);
    if (std::abs(next - t) <= kEpsilon * t || next <= low || next >= high) return next;
    t = next;
  }
  return t;
}

/// When a straight y(t) = y_0 + ∫f dt − p t falls to zero within a period, or infinity. Its slope
/// is zero at two arcsines, and between them y is monotonic: no zero is missed. A y that starts at
/// zero first grows.
double straight_stop(const Drive& drive, const Vector2& line, double p, double y_0, double period) {
  const double f = drive.steady.dot(line), swing = drive.swing.dot(line);
  std::array<double, 4> times{0, period, period, period};
  if (std::abs(swing) > std::abs(p - f)) {
    const double angle = std::asin((p - f) / swing);
    const auto time_of = [&](double phase) {
      const double turns = (phase - drive.phase) / (2 * std::numbers::pi);
      return (turns - std::floor(turns)) * period;
    };
    times[1] = time_of(angle);
    times[2] = time_of(std::numbers::pi - angle);
    if (times[1] > times[2]) std::swap(times[1], times[2]);
  }
  const auto y = [&](double t) { return y_0 + drive.integral(t).dot(line) - p * t; };
  const auto rate = [&](double t) { return drive.at(t).dot(line) - p; };
  bool grown = y_0 > 0;
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    const double low = times[k], high = times[k + 1];
    if (!(high > low)) continue;
    const double y_low = low > 0 ? y(low) : y_0, y_high = y(high);
    if (y_high <= 0 && grown) return y_low > 0 ? bracketed_zero(y, rate, low, high) : low;
    grown = grown || y_high > 0;
    // It never grew beyond rounding.
    if (y_high <= 0 && low > 0) return high;
  }
  return kNever;
}

}  // namespace

DrySlide::DrySlide(const Drive& drive, const DryFriction& friction, const Vector2& velocity,
                   double scale) {
  const bool constant = friction.slope == 0;
  if (constant && friction.constant == 0) {
    path_ = StraightSlide{drive, velocity, Vector2::Zero()};
    duration_ = kNever;
    return;
  }
  const Vector2 F = drive.at(0);
  const double speed = velocity.norm();
  direction_ = speed > 0 ? Vector2(velocity / speed)
                         : (F.isZero(0) ? Vector2(Vector2::UnitX()) : Vector2(F.normalized()));
  // A speed that only falls stays in its piece of the friction.
  const bool stays =
      friction.slowest <= 0 && (friction.fastest >= 1e300 || drive.largest() <= friction.constant);
  if (constant && stays) {
    // The line of the drive, if it keeps to one.
    Vector2 line =
        drive.steady.squaredNorm() > drive.swing.squaredNorm() ? drive.steady : drive.swing;
    line = line.isZero(0) ? direction_ : Vector2(line.normalized());
    if (drive.is_on_a_line() && std::abs(across(velocity, line)) <= 32 * kEpsilon * scale) {
      direction_ = direction_.dot(line) < 0 ? Vector2(-line) : line;
      go_straight(drive, friction.constant, velocity);
      return;
    }
    if (drive.is_uniform()) {
      const ConstantDriveSlide slide(F, friction.constant, velocity);
      duration_ = slide.end();
      stops_ = std::isfinite(duration_);
      path_ = slide;
      return;
    }
  }
  go_in_a_piece(drive, friction, velocity, scale);
}

void DrySlide::go_straight(const Drive& drive, double friction, const Vector2& velocity) {
  const double y = velocity.dot(direction_);
  path_ = StraightSlide{drive, velocity, friction * direction_};
  if (drive.is_uniform()) {
    const double decline = friction - drive.steady.dot(direction_);
    duration_ = decline > 0 && y > 0 ? y / decline : kNever;
    stops_ = std::isfinite(duration_);
    return;
  }
  const double period = 2 * std::numbers::pi / drive.omega;
  duration_ = straight_stop(drive, direction_, friction, y, period);
  stops_ = std::isfinite(duration_);
  if (!stops_) duration_ = period;
}

/// The longest of what is at hand: a series, or the closed form with the drive as it is halfway.
/// The latter is in error by at most the integral of |F(t) − F(h/2)|, max|Ḟ| h²/4, and goes on to
/// the very end of the motion, where a series cannot go: w has a branch point there.
void DrySlide::go_in_a_piece(const Drive& drive, const DryFriction& friction,
                             const Vector2& velocity, double scale) {
  const double F = drive.largest();
  double slowness = 0;  // a time of the drive
  if (!drive.is_uniform()) slowness = 1 / drive.omega;
  if (friction.slope != 0) slowness = std::max(slowness, 1 / std::abs(friction.slope));
  const double tolerance = kTolerance * std::max(scale, F * slowness);

  const double speed = velocity.norm();
  const double change = drive.largest_rate() +
                        std::abs(friction.slope) *
                            (F + std::abs(friction.constant) + std::abs(friction.slope) * speed);
  const double frozen_reach = change > 0 ? 2 * std::sqrt(tolerance / change)
                                         : 1e6 * tolerance / (F + std::abs(friction.constant));
  ConstantDriveSlide frozen;
  const auto freeze = [&](double h) {
    return ConstantDriveSlide(drive.at(0.5 * h) - friction.slope * velocity, friction.constant,
                              velocity);
  };
  if (speed > 0) {
    frozen = freeze(frozen_reach);
    if (friction.slowest <= 0 && frozen.end() <= frozen_reach) {
      path_ = freeze(frozen.end());
      duration_ = std::get<ConstantDriveSlide>(path_).end();
      stops_ = true;
      return;
    }
  }
  const SeriesSlide series(drive, friction, velocity, tolerance);
  if (series.reach() >= frozen_reach) {
    path_ = series;
    duration_ = series.reach();
    const double reversal = series.reversal();
    if (reversal <= duration_ && series.velocity(reversal).norm() <= 2 * tolerance) {
      duration_ = reversal;
      stops_ = true;
    }
    const double room = 32 * kEpsilon * scale;
    const double exit =
        series.exit(friction.slowest > 0 ? std::min(friction.slowest, speed) - room : 0.0,
                    std::max(friction.fastest, speed) + room);
    if (exit < duration_) {
      duration_ = exit;
      stops_ = false;
    }
  } else if (speed > 0) {
    path_ = frozen;
    duration_ = frozen_reach;
  } else {
    // From rest, straight along the drive.
    const Vector2 middle = drive.at(0.5 * frozen_reach);
    direction_ = middle.normalized();
    Drive constant;
    constant.steady = std::max(middle.norm(), friction.constant) * direction_;
    path_ = StraightSlide{constant, velocity, friction.constant * direction_};
    duration_ = frozen_reach;
  }
}

Vector2 DrySlide::velocity(double t) const {
  if (const StraightSlide* s = std::get_if<StraightSlide>(&path_))
    return s->start + s->drive.integral(t) - t * s->friction;
  if (const auto* slide = std::get_if<ConstantDriveSlide>(&path_)) return slide->velocity(t);
  return std::get<SeriesSlide>(path_).velocity(t);
}

Vector2 DrySlide::displacement(double t) const {
  if (const StraightSlide* s = std::get_if<StraightSlide>(&path_))
    return t * s->start + s->drive.double_integral(t) - (0.5 * t * t) * s->friction;
  if (const auto* slide = std::get_if<ConstantDriveSlide>(&path_)) return slide->displacement(t);
  return std::get<SeriesSlide>(path_).displacement(t);
}

}  // namespace slipcheck
