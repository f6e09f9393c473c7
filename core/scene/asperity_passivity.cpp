#include "scene/asperity_passivity.h"

#include <algorithm>
#include <cmath>

#include "scene/ode.h"

namespace slipcheck {
namespace {

/// ζ'(end)/ζ'(0) over one elastic collision x'' = −x^α.
double slip_ratio(double alpha, double lambda) {
  Ode ode(4, Ode::Method::adams, [=](double, const double* y, double* rate) {
    const double force = std::copysign(std::pow(std::abs(y[0]), alpha), y[0]);
    rate[0] = y[1];
    rate[1] = -force;
    rate[2] = y[3];
    rate[3] = -lambda * force * y[2];
  });
  const int falling[] = {-1};
  ode.watch(
      1, [](double, const double* y, double* value) { value[0] = y[0]; }, falling);
  constexpr double kTolerance = 1e-10;
  const double start[] = {0, 1, 0, 1};
  const double floor[] = {1e-12, 1e-12, 1e-12, 1e-12};
  ode.start(0, start, kTolerance, floor);
  while (ode.step(ode.time() + 1) != Ode::Stop::root) {
  }
  return ode.y()[3];
}

}  // namespace

double largest_passive_bend(double alpha) {
  double low = 0, high = 1;
  while (slip_ratio(alpha, high) > -1) {
    low = high;
    high *= 1.5;
  }
  while (high - low > 1e-8 * high) {
    const double mid = 0.5 * (low + high);
    (slip_ratio(alpha, mid) > -1 ? low : high) = mid;
  }
  return low;
}

double passive_speed(const ImpactScales& at_one, double largest_bend, double bend_per_length) {
  // L is in proportion to v^(2/(1+α)).
  return std::pow(largest_bend / (bend_per_length * at_one.length), 0.5 * (1 + at_one.law.alpha));
}

}  // namespace slipcheck
