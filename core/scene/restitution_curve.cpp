#include "scene/restitution_curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace slipcheck {
namespace {

// The table's range in ln D: 1 − e is in proportion to D below it, to 1e-7; above it e is a power
// of D or below 1e-7.
constexpr double kFirst = -7.5;
constexpr double kStep = 0.07;
constexpr std::size_t kMostPoints = 170;  // D up to 76
constexpr double kVanishing = -16.5;      // ln of the odds
constexpr double kTolerance = 1e-10;

double odds(const ScaledLaw& law, ContactEnd end, double log_D) {
  const double e = scaled_impact(law, std::exp(log_D), end, kTolerance).restitution;
  return e > 0 ? std::log(e) - std::log1p(-e) : 2 * kVanishing;
}

/// Derivatives of equidistant values by the polynomial of fourth degree through five of them.
std::vector<double> derivatives(const std::vector<double>& y, double step) {
  constexpr double kWeights[5][5] = {{-25, 48, -36, 16, -3},
                                     {-3, -10, 18, -6, 1},
                                     {1, -8, 0, 8, -1},
                                     {-1, 6, -18, 10, 3},
                                     {3, -16, 36, -48, 25}};
  std::vector<double> result(y.size());
  for (std::size_t i = 0; i < y.size(); ++i) {
    const std::size_t first = std::clamp<std::size_t>(i, 2, y.size() - 3) - 2;
    for (std::size_t k = 0; k < 5; ++k) result[i] += kWeights[i - first][k] * y[first + k];
    result[i] /= 12 * step;
  }
  return result;
}

}  // namespace

void RestitutionCurve::tabulate() {
  while (log_odds_.size() < kMostPoints) {
    log_odds_.push_back(odds(law_, end_, kFirst + kStep * static_cast<double>(log_odds_.size())));
    if (log_odds_.back() < kVanishing) break;
  }
  slope_ = derivatives(log_odds_, kStep);
}

RestitutionLaw RestitutionCurve::over_speed(double D) {
  if (D == 0) return 1.0;
  const double p = law_.speed_exponent();
  if (p == 0) return scaled_impact(law_, D, end_, kTolerance).restitution;
  if (log_odds_.empty()) tabulate();
  // ln D rises by p ln g.
  TabulatedRestitution table{(kFirst - std::log(D)) / p, kStep / p, log_odds_, slope_};
  for (double& slope : table.slope) slope *= p;
  if (p < 0) {
    table.log_first += table.log_step * static_cast<double>(log_odds_.size() - 1);
    table.log_step = -table.log_step;
    std::ranges::reverse(table.log_odds);
    std::ranges::reverse(table.slope);
  }
  return table;
}

}  // namespace slipcheck
