#include "physics/motion/constant_drive_slide.h"

#include <algorithm>
#include <cmath>

#include "physics/numbers.h"

namespace slipcheck {
namespace {

/// E(k) = (1 − e^(−kτ))/k, τ maybe infinite where k > 0.
double decayed(double k, double tau) {
  if (std::abs(k) * tau < 1e-300) return tau;
  return -std::expm1(-k * tau) / k;
}

Vector2 turned(const Vector2& v) { return {-v.y(), v.x()}; }

}  // namespace

ConstantDriveSlide::ConstantDriveSlide(const Vector2& drive, double friction,
                                       const Vector2& velocity)
    : friction_(friction) {
  const double F = drive.norm(), speed = velocity.norm();
  along_ = F > 0 ? Vector2(drive / F) : Vector2(velocity / speed);
  const double a = velocity.dot(along_);
  b_ = velocity.dot(turned(along_));
  // |w| ± a without cancellation.
  P_ = a > 0 ? speed + a : b_ * b_ / (speed - a);
  Q_ = a > 0 ? b_ * b_ / (speed + a) : speed - a;
  slow_ = friction - F;
  fast_ = friction + F;
  end_ = slow_ > 0 ? 0.5 * (P_ / slow_ + Q_ / fast_) : kNever;
}

double ConstantDriveSlide::time_at(double tau) const {
  return 0.5 * (P_ * decayed(slow_, tau) + Q_ * decayed(fast_, tau));
}

/// Newton's steps inside a bracket. Towards an end they go on the logarithm of the time left, which
/// is nearly linear in τ.
double ConstantDriveSlide::tau_at(double t) const {
  if (!(t > 0)) return 0;
  if (!(t < end_)) return kNever;
  // t exceeds either of its two parts; each bounds τ.
  const auto bound = [&](double part, double k) {
    if (!(part > 0)) return kNever;
    const double x = 2 * k * t / part;
    if (std::abs(x) < 1e-300) return 2 * t / part;
    return x < 1 ? -std::log1p(-x) / k : kNever;
  };
  double low = 0, high = std::min(bound(P_, slow_), bound(Q_, fast_));
  const bool ends = slow_ > 0;
  if (ends) {
    // P e^(−slow τ) + Q e^(−fast τ) falls at most as fast as its first and slowest part.
    const double left = (end_ - t) / end_;
    if (!(left > 0)) return kNever;
    high = std::min(high, -std::log(left) / slow_);
  }
  double tau = ends ? 0 : high;
  if (!std::isfinite(tau)) tau = 0;
  for (int n = 0; n < 100; ++n) {
    const double e1 = P_ * std::exp(-slow_ * tau), e2 = Q_ * std::exp(-fast_ * tau);
    const double speed = 0.5 * (e1 + e2);
    const double missing = t - time_at(tau);
    if (std::abs(missing) <= 4e-16 * t) break;
    (missing > 0 ? low : high) = tau;
    double step = missing / speed;
    if (ends) {
      const double left = 0.5 * (e1 / slow_ + e2 / fast_);
      if (left > 0 && left > missing) step = -std::log1p(-missing / left) * left / speed;
    }
    double next = tau + step;
    if (!(next > low && next < high))
      next = std::isfinite(high) ? 0.5 * (low + high) : 2 * tau + 1 / fast_;
    if (std::abs(next - tau) <= 1e-15 * tau || next == tau) break;
    tau = next;
  }
  return tau;
}

Vector2 ConstantDriveSlide::velocity(double t) const {
  const double tau = tau_at(t);
  if (tau == kNever) return Vector2::Zero();
  const double a = 0.5 * (P_ * std::exp(-slow_ * tau) - Q_ * std::exp(-fast_ * tau));
  return a * along_ + (b_ * std::exp(-friction_ * tau)) * turned(along_);
}

Vector2 ConstantDriveSlide::displacement(double t) const {
  const double tau = tau_at(t);
  // ∫ a |w| dτ and ∫ b |w| dτ.
  const double a = 0.25 * (P_ * P_ * decayed(2 * slow_, tau) - Q_ * Q_ * decayed(2 * fast_, tau));
  const double b =
      0.5 * b_ * (P_ * decayed(friction_ + slow_, tau) + Q_ * decayed(friction_ + fast_, tau));
  return a * along_ + b * turned(along_);
}

}  // namespace slipcheck
