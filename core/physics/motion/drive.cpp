#include "physics/motion/drive.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/numbers.h"

namespace slipcheck {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
/// A friction that holds gives way where the load exceeds its limit by more than rounding.
constexpr double kMargin = 1 + 1e-10;

/// The way from one angle forward to another, in [0, 2π).
double forward(double from, double to) {
  const double way = std::fmod(to - from, kTurn);
  return way < 0 ? way + kTurn : way;
}

}  // namespace

bool Drive::is_on_a_line() const {
  return std::abs(across(steady, swing)) <= 8 * kEpsilon * steady.norm() * swing.norm();
}

Vector2 Drive::at(double t) const {
  if (is_uniform()) return steady;
  return steady + std::sin(phase + omega * t) * swing;
}

Vector2 Drive::integral(double t) const {
  if (is_uniform()) return t * steady;
  // cos a − cos b without cancellation.
  const double half = 0.5 * omega * t;
  return t * steady + (2 * std::sin(half) * std::sin(phase + half) / omega) * swing;
}

Vector2 Drive::double_integral(double t) const {
  if (is_uniform()) return (0.5 * t * t) * steady;
  const double half = 0.5 * omega * t;
  const double sines = 2 * std::sin(half) * std::cos(phase + half);  // sin(phase + ω t) − sin phase
  return (0.5 * t * t) * steady + ((omega * t * std::cos(phase) - sines) / (omega * omega)) * swing;
}

double Drive::time_beyond(double limit) const {
  if (is_uniform()) return steady.norm() > kMargin * limit ? 0 : kNever;
  if (limit == 0) return 0;
  // |F|² − limit² = a s² + 2 b s + c <= 0 between two values of the sine.
  const double a = swing.squaredNorm();
  const double b = swing.dot(steady);
  const double c = steady.squaredNorm() - limit * limit;
  const double discriminant = b * b - a * c;
  if (discriminant <= 0) return 0;
  const double sum = -(b + std::copysign(std::sqrt(discriminant), b));
  const double low = std::min(sum / a, c / sum), high = std::max(sum / a, c / sum);
  const double s = std::sin(phase), rise = std::cos(phase);
  const double round_off = 1e-12 + 4 * phase_error;
  if (s > high + round_off || s < low - round_off) return 0;
  if ((s > high - round_off && rise > 0) || (s < low + round_off && rise < 0)) return 0;
  double way = kNever;
  if (high < 1) way = forward(phase, std::asin(std::max(high, -1.0)));
  if (low > -1)
    way = std::min(way, forward(phase, std::numbers::pi - std::asin(std::min(low, 1.0))));
  return way / omega;
}

}  // namespace slipcheck
