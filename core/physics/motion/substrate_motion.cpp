#include "physics/motion/substrate_motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace slipcheck {
namespace {

Vector3 in_plane(const Vector2& v) { return {v.x(), v.y(), 0}; }

Vector2 slope(const SubstrateMotion::Point& a, const SubstrateMotion::Point& b) {
  return (b.position - a.position) / (b.time - a.time);
}

}  // namespace

SubstrateMotion SubstrateMotion::constant(const Vector2& velocity) {
  SubstrateMotion motion;
  motion.kind_ = velocity.isZero(0) ? Kind::still : Kind::constant;
  motion.vector_ = velocity;
  return motion;
}

SubstrateMotion SubstrateMotion::oscillation(const Vector2& amplitude, double frequency,
                                             double phase) {
  assert(frequency > 0);
  SubstrateMotion motion;
  motion.kind_ = amplitude.isZero(0) ? Kind::still : Kind::oscillation;
  motion.vector_ = amplitude;
  motion.frequency_ = frequency;
  motion.omega_ = 2 * std::numbers::pi * frequency;
  motion.phase_ = phase;
  return motion;
}

SubstrateMotion SubstrateMotion::table(std::vector<Point> points) {
  assert(std::ranges::is_sorted(points, std::ranges::less_equal{}, &Point::time) ||
         points.size() < 2);
  SubstrateMotion motion;
  motion.kind_ = points.empty() ? Kind::still : Kind::table;
  motion.points_ = std::move(points);
  return motion;
}

std::size_t SubstrateMotion::points_until(double t) const {
  const auto after = std::ranges::upper_bound(points_, t, {}, &Point::time);
  return static_cast<std::size_t>(after - points_.begin());
}

Vector2 SubstrateMotion::slope_after(std::size_t passed) const {
  if (passed == 0 || passed >= points_.size()) return Vector2::Zero();
  return slope(points_[passed - 1], points_[passed]);
}

Vector3 SubstrateMotion::position(double t) const {
  switch (kind_) {
    case Kind::constant:
      return in_plane(t * vector_);
    case Kind::oscillation:
      return in_plane(std::sin(omega_ * t + phase_) * vector_);
    case Kind::table: {
      const std::size_t passed = points_until(t);
      if (passed == 0) return in_plane(points_.front().position);
      const Point& last = points_[passed - 1];
      return in_plane(last.position + (t - last.time) * slope_after(passed));
    }
    case Kind::still:
      break;
  }
  return Vector3::Zero();
}

Vector3 SubstrateMotion::velocity(double t) const {
  switch (kind_) {
    case Kind::constant:
      return in_plane(vector_);
    case Kind::oscillation:
      return in_plane(omega_ * std::cos(omega_ * t + phase_) * vector_);
    case Kind::table:
      return in_plane(slope_after(points_until(t)));
    case Kind::still:
      break;
  }
  return Vector3::Zero();
}

Vector3 SubstrateMotion::acceleration(double t) const {
  if (kind_ != Kind::oscillation) return Vector3::Zero();
  return in_plane(-omega_ * omega_ * std::sin(omega_ * t + phase_) * vector_);
}

double SubstrateMotion::largest_speed() const {
  switch (kind_) {
    case Kind::constant:
      return vector_.norm();
    case Kind::oscillation:
      return omega_ * vector_.norm();
    case Kind::table: {
      double largest = 0;
      for (std::size_t k = 1; k < points_.size(); ++k)
        largest = std::max(largest, slope_after(k).norm());
      return largest;
    }
    case Kind::still:
      break;
  }
  return 0;
}

double SubstrateMotion::largest_acceleration() const {
  return kind_ == Kind::oscillation ? omega_ * omega_ * vector_.norm() : 0;
}

double SubstrateMotion::next_kink(double t) const {
  for (std::size_t k = points_until(t); k < points_.size(); ++k)
    if (slope_after(k) != slope_after(k + 1)) return points_[k].time;
  return std::numeric_limits<double>::infinity();
}

}  // namespace slipcheck
