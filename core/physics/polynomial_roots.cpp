#include "physics/polynomial_roots.h"

#include <algorithm>
#include <cmath>

#include "physics/numbers.h"

namespace slipcheck {
namespace {

template <std::size_t N>
double value(const std::array<double, N>& c, double t) {
  double sum = c[N - 1];
  for (std::size_t k = N - 1; k-- > 0;) sum = sum * t + c[k];
  return sum;
}

template <std::size_t N>
std::array<double, N - 1> derivative(const std::array<double, N>& c) {
  std::array<double, N - 1> d;
  for (std::size_t k = 1; k < N; ++k) d[k - 1] = static_cast<double>(k) * c[k];
  return d;
}

/// The root of f in [low, high], where f is monotonic and changes sign. Newton's step where it
/// stays inside the bracket and at least halves it every other time, bisection elsewhere.
template <std::size_t N>
double bracketed_root(const std::array<double, N>& f, double low, double high) {
  const auto slope = derivative(f);
  const double f_low = value(f, low);
  if (f_low == 0) return low;
  const bool falls = f_low > 0;
  double t = 0.5 * (low + high);
  double step = high - low, step_before = step;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const double f_t = value(f, t);
    if (f_t == 0) return t;
    ((f_t > 0) == falls ? low : high) = t;
    const double newton = t - f_t / value(slope, t);
    const bool usable = newton > low && newton < high && std::abs(newton - t) < 0.5 * step_before;
    const double next = usable ? newton : low + 0.5 * (high - low);
    step_before = step;
    step = std::abs(next - t);
    if (next == t || next <= low || next >= high) return next;
    t = next;
  }
  return t;
}

/// The k-th root of x >= 0, k from 1 to 4, without pow().
double root(double x, int k) {
  if (k == 1) return x;
  if (k == 3) return std::cbrt(x);
  return k == 2 ? std::sqrt(x) : std::sqrt(std::sqrt(x));
}

/// Fujiwara's bound on the modulus of the roots.
double root_bound(const Quartic& f) {
  int degree = 4;
  while (degree > 0 && f[static_cast<std::size_t>(degree)] == 0) --degree;
  const double lead = std::abs(f[static_cast<std::size_t>(degree)]);
  double bound = 0;
  for (int k = 1; k <= degree; ++k)
    bound = std::max(bound, root(std::abs(f[static_cast<std::size_t>(degree - k)]) / lead, k));
  return 2 * bound;
}

/// Real roots of a quadratic in (0, limit), in order; at most two.
struct Roots {
  std::array<double, 3> at;
  int count = 0;
  void add(double t) { at[static_cast<std::size_t>(count++)] = t; }
};

Roots quadratic_roots(const std::array<double, 3>& c, double limit) {
  Roots roots;
  const auto add_inside = [&](double t) {
    if (t > 0 && t < limit) roots.add(t);
  };
  if (c[2] == 0) {
    if (c[1] != 0) add_inside(-c[0] / c[1]);
    return roots;
  }
  const double discriminant = c[1] * c[1] - 4 * c[2] * c[0];
  if (discriminant < 0) return roots;
  // The larger root in modulus first: no cancellation.
  const double sum = -0.5 * (c[1] + std::copysign(std::sqrt(discriminant), c[1]));
  double first = sum / c[2];
  double second = sum != 0 ? c[0] / sum : 0;
  if (first > second) std::swap(first, second);
  add_inside(first);
  if (second != first) add_inside(second);
  return roots;
}

/// Real roots of a cubic in (0, limit) at which it changes sign, in order.
Roots cubic_roots(const std::array<double, 4>& c, double limit) {
  if (c[3] == 0) return quadratic_roots({c[0], c[1], c[2]}, limit);
  Roots roots;
  const Roots turning = quadratic_roots(derivative(c), limit);
  double low = 0;
  for (int k = 0; k <= turning.count; ++k) {
    const double high = k < turning.count ? turning.at[static_cast<std::size_t>(k)] : limit;
    if ((value(c, low) > 0) != (value(c, high) > 0)) roots.add(bracketed_root(c, low, high));
    low = high;
  }
  return roots;
}

}  // namespace

double first_falling_root(const Quartic& f, double limit) {
  const bool straight = f[3] == 0 && f[4] == 0;
  if (f[0] > 0 && f[1] >= 0 && straight && f[2] >= 0) return kNever;
  // Beyond the last root nothing happens; a little further keeps that root inside.
  limit = std::min(limit, 1.0001 * root_bound(f));
  if (!(limit > 0)) return f[0] <= 0 && f[1] < 0 ? 0 : kNever;

  const Roots turning = cubic_roots(derivative(f), limit);
  double low = 0;
  double f_low = f[0];
  for (int k = 0; k <= turning.count; ++k) {
    const double high = k < turning.count ? turning.at[static_cast<std::size_t>(k)] : limit;
    const double f_high = value(f, high);
    if (f_high < f_low) {
      if (f_low <= 0) return low;
      if (f_high <= 0) return bracketed_root(f, low, high);
    }
    low = high;
    f_low = f_high;
  }
  return kNever;
}

}  // namespace slipcheck
