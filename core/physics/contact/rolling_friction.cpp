#include "physics/contact/rolling_friction.h"

#include <algorithm>
#include <limits>

namespace slipcheck {

double RollingFriction::operator()(double speed) const {
  const auto above = std::upper_bound(points_.begin(), points_.end(), speed,
                                      [](double v, const Point& point) { return v < point.speed; });
  if (above == points_.begin()) return points_.front().coefficient;
  if (above == points_.end()) return points_.back().coefficient;
  const Point& low = *(above - 1);
  const double fraction = (speed - low.speed) / (above->speed - low.speed);
  return low.coefficient + fraction * (above->coefficient - low.coefficient);
}

double RollingFriction::largest_up_to(double speed) const {
  // Piecewise linear: the largest value is at the end or at a point before it.
  double largest = (*this)(speed);
  for (const Point& point : points_)
    if (point.speed <= speed) largest = std::max(largest, point.coefficient);
  return std::max(largest, (*this)(0));
}

bool RollingFriction::is_zero() const {
  return std::all_of(points_.begin(), points_.end(),
                     [](const Point& point) { return point.coefficient == 0; });
}

RollingFriction::Piece RollingFriction::piece_below(double speed) const {
  const double coefficient = (*this)(speed);
  // The last point that lies below the speed starts the piece that the body is in. A body that has
  // just slowed down to a point may still be a rounding error above it.
  const double clearly_below = speed * (1 - 8 * std::numeric_limits<double>::epsilon());
  const auto at_or_above =
      std::lower_bound(points_.begin(), points_.end(), clearly_below,
                       [](const Point& point, double v) { return point.speed < v; });
  if (at_or_above == points_.begin()) return {coefficient, 0, 0};
  const Point& low = *(at_or_above - 1);
  if (at_or_above == points_.end()) return {coefficient, 0, low.speed};
  const double slope =
      (at_or_above->coefficient - low.coefficient) / (at_or_above->speed - low.speed);
  return {coefficient, slope, low.speed};
}

}  // namespace slipcheck
