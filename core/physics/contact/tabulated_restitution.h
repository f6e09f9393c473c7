#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace slipcheck {

/// Coefficient of restitution as a table over the impact speed, made from collisions that were
/// integrated. What is tabulated is ln(e/(1 − e)) over ln g: for a power law of force it runs into
/// a straight line at both ends, so that few points do. Outside the table the nearer one of e and
/// 1 − e to zero goes on as a power of g.
struct TabulatedRestitution {
  double log_first = 0;          ///< ln(g/(1 m/s)) of the first point
  double log_step = 1;           ///< between two points, > 0
  std::vector<double> log_odds;  ///< ln(e/(1 − e)), finite; one at least
  std::vector<double> slope;     ///< its derivative by ln g, finite; as many

  /// e at the impact speed g [m/s], >= 0: the cubic that has value and slope of both neighbours.
  double operator()(double g) const {
    constexpr double kSlowest = 1e-300;
    const double x = (std::log(std::max(g, kSlowest)) - log_first) / log_step;
    const auto last = static_cast<double>(log_odds.size() - 1);
    if (!(x > 0)) return beyond(log_odds.front(), slope.front(), log_step * x);
    if (x >= last) return beyond(log_odds.back(), slope.back(), log_step * (x - last));
    const auto i = static_cast<std::size_t>(x);
    const double s = x - static_cast<double>(i), r = 1 - s;
    const double y = r * r * ((1 + 2 * s) * log_odds[i] + s * log_step * slope[i]) +
                     s * s * ((1 + 2 * r) * log_odds[i + 1] - r * log_step * slope[i + 1]);
    return 1 / (1 + std::exp(-y));
  }

 private:
  /// At `distance` in ln g from a point with value y and slope y'. With e = 1/(1 + e^−y) the slope
  /// of ln e is y' (1 − e), that of ln(1 − e) is −y' e.
  static double beyond(double y, double y_prime, double distance) {
    const double e = 1 / (1 + std::exp(-y)), rest = 1 / (1 + std::exp(y));
    if (y < 0) return std::min(1.0, e * std::exp(y_prime * rest * distance));
    return std::max(0.0, 1 - rest * std::exp(-y_prime * e * distance));
  }
};

}  // namespace slipcheck
