#include "studies/precision/convergence.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

#include "harness/compare/power_law.h"

namespace slipcheck {
namespace {

using ConvergenceKind = Convergence::Kind;

/// A slower fall is none: a hundredfold finer step would gain less than a factor of 3.2. The order
/// of a method is 1/2 at least where errors have the root of a step, as in phases of a bounce.
constexpr double kLeastOrder = 0.25;
/// Of its standard error that an order must be away from 0.
constexpr double kSignificance = 2;
/// Of the coarsest error that the finest has at most.
constexpr double kLeastFall = 0.5;
/// So many at the fine end tell whether the error still falls.
constexpr std::size_t kTail = 3;
constexpr std::size_t kLeastPoints = 3;

struct Points {
  std::vector<double> knobs, errors;
  std::size_t size() const { return errors.size(); }
};

struct Order {
  double p = kNotObserved, error = kNotObserved;
};

/// Through the last `count` points.
Order order_of(const Points& points, std::size_t count) {
  if (count < 2) return {};
  const auto last = static_cast<std::ptrdiff_t>(count);
  const std::vector<double> knobs(points.knobs.end() - last, points.knobs.end());
  const std::vector<double> errors(points.errors.end() - last, points.errors.end());
  const PowerLaw law = fit_power_law(knobs, errors);
  return {law.exponent[0], law.exponent_error[0]};
}

bool falls(const Points& above, const Order& order, double negligible) {
  // Two points have no scatter that would tell.
  const bool is_significant =
      std::isnan(order.error) ? above.size() == 2 : order.p > kSignificance * order.error;
  if (!(order.p > kLeastOrder) || !is_significant) return false;
  if (above.errors.back() > kLeastFall * above.errors.front()) return false;
  return above.errors.back() <= negligible ||
         order_of(above, std::min(kTail, above.size())).p > kLeastOrder;
}

}  // namespace

Convergence convergence_of(std::span<const double> knobs, std::span<const double> errors,
                           const ErrorFloor& floor) {
  assert(knobs.size() == errors.size());
  Points all, above;  // the noise
  for (std::size_t k = 0; k < errors.size(); ++k) {
    if (!std::isfinite(errors[k])) continue;
    all.knobs.push_back(knobs[k]);
    all.errors.push_back(errors[k]);
    if (errors[k] <= floor.noise) continue;
    above.knobs.push_back(knobs[k]);
    above.errors.push_back(errors[k]);
  }
  Convergence result;
  if (all.size() == 0) return result;
  result.coarsest = all.errors.front();
  result.finest = all.errors.back();
  result.largest = std::ranges::max(all.errors);
  if (above.size() == 0) {
    result.kind = ConvergenceKind::exact;
    return result;
  }
  const bool ends_in_noise = result.finest <= floor.noise;
  const bool is_negligible = result.largest <= floor.negligible;
  if (all.size() < kLeastPoints) {
    if (is_negligible) result.kind = ConvergenceKind::exact;
    return result;
  }
  const Order order = order_of(above, above.size());
  if (ends_in_noise || (above.size() >= 2 && falls(above, order, floor.negligible)))
    result.kind = ConvergenceKind::converges;
  else if (is_negligible)
    result.kind = ConvergenceKind::exact;
  else
    result.kind = result.finest <= floor.negligible ? ConvergenceKind::converges
                                                    : ConvergenceKind::does_not_converge;
  // What jumps below the noise at once, or is constant before, shows no order.
  if (result.kind != ConvergenceKind::exact &&
      (result.kind != ConvergenceKind::converges || order.p > kLeastOrder)) {
    result.order = order.p;
    result.order_error = order.error;
  }
  return result;
}

}  // namespace slipcheck
