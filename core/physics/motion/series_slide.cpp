#include "physics/motion/series_slide.h"

#include <algorithm>
#include <cmath>

#include "physics/numbers.h"
#include "physics/safe_root.h"

namespace slipcheck {
namespace {

constexpr int kOrder = SeriesSlide::kOrder;
using Series = SeriesSlide::Series;

std::size_t at(int k) { return static_cast<std::size_t>(k); }

/// Coefficient k of the product of two series, terms from..k−from alone.
double product(const Series& a, const Series& b, int k, int from = 0) {
  double sum = 0;
  for (int j = from; j <= k - from; ++j) sum += a[at(j)] * b[at(k - j)];
  return sum;
}

/// The drive's two components.
struct DriveSeries {
  Series x{}, y{};

  explicit DriveSeries(const Drive& drive) {
    x[0] = drive.steady.x();
    y[0] = drive.steady.y();
    if (drive.is_uniform()) return;
    const double s = std::sin(drive.phase), c = std::cos(drive.phase);
    const std::array cycle{s, c, -s, -c};
    double power = 1;  // ω^k/k!
    for (int k = 0; k <= kOrder; ++k) {
      const double term = power * cycle[at(k % 4)];
      x[at(k)] += term * drive.swing.x();
      y[at(k)] += term * drive.swing.y();
      power *= drive.omega / (k + 1);
    }
  }
};

/// Length and direction of a vector series, order by order.
struct Polar {
  Series size{}, x{}, y{};

  void start(const Series& wx, const Series& wy) {
    size[0] = std::hypot(wx[0], wy[0]);
    x[0] = wx[0] / size[0];
    y[0] = wy[0] / size[0];
  }
  /// Order k >= 1 from that of w.
  void extend(const Series& wx, const Series& wy, int k) {
    const double square = product(wx, wx, k) + product(wy, wy, k);
    size[at(k)] = (square - product(size, size, k, 1)) / (2 * size[0]);
    double rest_x = wx[at(k)], rest_y = wy[at(k)];
    for (int j = 0; j < k; ++j) {
      rest_x -= x[at(j)] * size[at(k - j)];
      rest_y -= y[at(j)] * size[at(k - j)];
    }
    x[at(k)] = rest_x / size[0];
    y[at(k)] = rest_y / size[0];
  }
};

/// Value and slope of Σ c_k t^k.
double value(const Series& c, double t) {
  double sum = c[at(kOrder)];
  for (int k = kOrder; k-- > 0;) sum = sum * t + c[at(k)];
  return sum;
}
double slope(const Series& c, double t) {
  double sum = kOrder * c[at(kOrder)];
  for (int k = kOrder - 1; k >= 1; --k) sum = sum * t + k * c[at(k)];
  return sum;
}
/// Bounds of the value and of the derivatives in [0, t].
struct Bounds {
  double value = 0, slope = 0, curvature = 0;
  Bounds(const Series& c, double t) {
    for (int k = kOrder; k >= 0; --k) {
      const double size = std::abs(c[at(k)]);
      value = value * t + size;
      if (k >= 1) slope = slope * t + k * size;
      if (k >= 2) curvature = curvature * t + k * (k - 1) * size;
    }
  }
};

}  // namespace

SeriesSlide::SeriesSlide(const Drive& drive, const DryFriction& law, const Vector2& velocity,
                         double tolerance) {
  const double speed = velocity.norm();
  const Vector2 F = drive.at(0);
  DryFriction friction = law;
  // What begins to move does so where |F| reaches p, up to the rounding of the time.
  if (speed == 0) friction.constant = std::min(friction.constant, F.norm());
  if (speed > 0) {
    expand(drive, friction, velocity);
  } else {
    expand_from_rest(drive, friction);
  }
  find_reach(drive, friction, tolerance);
  // A slow body whose direction has come to follow the drive is stiff: the series in its direction
  // is short. There its slow motion is as good as exact and lasts longer.
  if (drive.is_uniform()) return;
  const bool is_short = !(reach_ * drive.omega > 0.05);
  const double size = F.norm();
  const double turn = speed * drive.largest_rate() / (size * size);
  const bool follows =
      turn < 0.05 && velocity.dot(F) >= 0 &&
      std::abs(velocity.x() * F.y() - velocity.y() * F.x()) <= 3 * turn * speed * size;
  if (!is_short || !follows || friction.constant <= 0) return;
  const SeriesSlide direct = *this;
  expand_slow(drive, friction, speed);
  reach_ = 0;
  if ((Vector2(x_[0], y_[0]) - velocity).norm() <= 0.5 * tolerance)
    find_reach(drive, friction, 0.5 * tolerance);
  if (!(reach_ > direct.reach_)) *this = direct;
}

/// (k+1) w_{k+1} = F_k − p ŵ_k − s w_k.
void SeriesSlide::expand(const Drive& drive, const DryFriction& friction, const Vector2& velocity) {
  const DriveSeries F(drive);
  Polar w;
  x_[0] = velocity.x();
  y_[0] = velocity.y();
  w.start(x_, y_);
  for (int k = 0; k < kOrder; ++k) {
    if (k > 0) w.extend(x_, y_, k);
    const double n = k + 1;
    x_[at(k + 1)] = (F.x[at(k)] - friction.constant * w.x[at(k)] - friction.slope * x_[at(k)]) / n;
    y_[at(k + 1)] = (F.y[at(k)] - friction.constant * w.y[at(k)] - friction.slope * y_[at(k)]) / n;
  }
}

/// w = t y(t) with ŷ_0 = F̂ and |y_0| = |F| − p. In order k the direction is
/// ŷ_k = (1 − ŷ_0 ŷ_0ᵀ) y_k/|y_0| + what follows from lower orders, so that
///   (k+1) y_k + (p/|y_0|)(1 − ŷ_0 ŷ_0ᵀ) y_k = F_k − p known_k − s y_{k−1}.
void SeriesSlide::expand_from_rest(const Drive& drive, const DryFriction& friction) {
  const DriveSeries F(drive);
  const double p = friction.constant, size = std::hypot(F.x[0], F.y[0]);
  const double start = size - p;
  first_power_ = 1;
  if (!(start > 1e-9 * size)) return;
  Series yx{}, yy{};
  yx[0] = start / size * F.x[0];
  yy[0] = start / size * F.y[0];
  Polar y;
  y.start(yx, yy);
  const Vector2 along(y.x[0], y.y[0]), across(-along.y(), along.x());
  for (int k = 1; k < kOrder; ++k) {
    y.extend(yx, yy, k);  // with y_k = 0: what follows from lower orders
    const Vector2 right(F.x[at(k)] - p * y.x[at(k)] - friction.slope * yx[at(k - 1)],
                        F.y[at(k)] - p * y.y[at(k)] - friction.slope * yy[at(k - 1)]);
    const Vector2 term =
        (right.dot(along) / (k + 1)) * along + (right.dot(across) / (k + 1 + p / start)) * across;
    yx[at(k)] = term.x();
    yy[at(k)] = term.y();
    y.extend(yx, yy, k);
  }
  x_[0] = y_[0] = 0;
  for (int k = 0; k < kOrder; ++k) {
    x_[at(k + 1)] = yx[at(k)];
    y_[at(k + 1)] = yy[at(k)];
  }
}

/// The motion on which the direction d follows the drive, ρ ḋ = F − (F·d) d, found as the fixed
/// point of d = (F − ρ ḋ)/|F − ρ ḋ|, ρ̇ = F·d − p − s ρ. Also from rest where |F| just passes p,
/// where w starts with t².
void SeriesSlide::expand_slow(const Drive& drive, const DryFriction& friction, double speed) {
  const DriveSeries F(drive);
  Series dx{}, dy{}, rho{};
  Series vx = F.x, vy = F.y;
  double before = kNever;
  for (int n = 0; n <= 2 * kOrder; ++n) {
    Polar d;
    d.start(vx, vy);
    for (int k = 1; k <= kOrder; ++k) d.extend(vx, vy, k);
    dx = d.x;
    dy = d.y;
    rho[0] = speed;
    for (int k = 0; k < kOrder; ++k) {
      double rate = product(F.x, dx, k) + product(F.y, dy, k) - friction.slope * rho[at(k)];
      if (k == 0) {
        rate -= friction.constant;
        if (speed == 0) rate = std::max(rate, 0.0);
      }
      rho[at(k + 1)] = rate / (k + 1);
    }
    // F − ρ ḋ.
    Series turning_x{}, turning_y{};
    for (int k = 0; k < kOrder; ++k) {
      turning_x[at(k)] = (k + 1) * dx[at(k + 1)];
      turning_y[at(k)] = (k + 1) * dy[at(k + 1)];
    }
    double change = 0, scale = 1 / drive.omega;
    double power = 1;
    for (int k = 0; k <= kOrder; ++k) {
      const double x = F.x[at(k)] - product(rho, turning_x, k);
      const double y = F.y[at(k)] - product(rho, turning_y, k);
      change = std::max(change, power * (std::abs(x - vx[at(k)]) + std::abs(y - vy[at(k)])));
      vx[at(k)] = x;
      vy[at(k)] = y;
      power *= 0.05 * scale;  // weighed as on a short piece
    }
    if (change == 0 || (n > kOrder && change >= before)) break;
    before = change;
  }
  for (int k = 0; k <= kOrder; ++k) {
    x_[at(k)] = product(rho, dx, k);
    y_[at(k)] = product(rho, dy, k);
  }
  first_power_ = 0;
  if (speed == 0) first_power_ = rho[1] > 0 ? 1 : 2;
}

void SeriesSlide::find_reach(const Drive& drive, const DryFriction& friction, double tolerance) {
  reach_ = 0;
  const Vector2 first(x_[at(first_power_)], y_[at(first_power_)]);
  if (first.isZero(0)) return;
  // No longer than anything here takes: `tolerance` is a small part of the speeds' scale.
  double h = 1e15 * tolerance / (drive.largest() + std::abs(friction.constant));
  for (int k = kOrder - 1; k <= kOrder; ++k) {
    const double size = std::hypot(x_[at(k)], y_[at(k)]);
    if (size > 0) h = std::min(h, std::pow(tolerance / size, 1.0 / k));
  }
  if (!std::isfinite(h)) return;
  for (int n = 0; n < 40; ++n, h *= 0.75) {
    const Vector2 w = velocity(h);
    const double speed = w.norm();
    if (!(speed > 0)) continue;
    const double side = w.dot(first) < 0 ? -1 : 1;
    const Vector2 rate(slope(x_, h), slope(y_, h));
    const Vector2 defect =
        rate - drive.at(h) + (side * friction.constant / speed + friction.slope) * w;
    if (defect.norm() * h <= tolerance) {
      reach_ = h;
      return;
    }
  }
}

Vector2 SeriesSlide::velocity(double t) const { return {value(x_, t), value(y_, t)}; }

Vector2 SeriesSlide::displacement(double t) const {
  double x = 0, y = 0;
  for (int k = kOrder; k >= 0; --k) {
    x = x * t + x_[at(k)] / (k + 1);
    y = y * t + y_[at(k)] / (k + 1);
  }
  return {x * t, y * t};
}

double SeriesSlide::reversal() const {
  const double dx = x_[at(first_power_)], dy = y_[at(first_power_)];
  Series along{};
  for (int k = first_power_; k <= kOrder; ++k)
    along[at(k - first_power_)] = dx * x_[at(k)] + dy * y_[at(k)];
  const Bounds bounds(along, reach_);
  if (bounds.value <= 2 * along[0]) return kNever;
  return first_zero(
      [&](double t, double& rate) {
        rate = slope(along, t);
        return value(along, t);
      },
      bounds.curvature, reach_);
}

double SeriesSlide::exit(double slowest, double fastest) const {
  const Bounds x(x_, reach_), y(y_, reach_);
  const double curvature =
      2 * (x.slope * x.slope + y.slope * y.slope + x.value * x.curvature + y.value * y.curvature);
  const auto crossing = [&](double speed, double sign) {
    return first_zero(
        [&](double t, double& rate) {
          const Vector2 w = velocity(t);
          rate = sign * 2 * (w.x() * slope(x_, t) + w.y() * slope(y_, t));
          const double size = w.norm();
          return sign * (size - speed) * (size + speed);
        },
        curvature, reach_);
  };
  double first = kNever;
  if (fastest < std::hypot(x.value, y.value)) first = crossing(fastest, -1);
  if (slowest > 0) first = std::min(first, crossing(slowest, 1));
  return first;
}

}  // namespace slipcheck
