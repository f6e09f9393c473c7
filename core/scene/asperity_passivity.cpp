#include "scene/asperity_passivity.h"

#include <cmath>
#include <limits>

#include "scene/ode.h"

namespace slipcheck {
namespace {

/// By how much |ε^T| exceeds 1 in one collision; the integration is good to far less.
double gain(const ScaledLaw& law, double D, ContactEnd end, double lambda) {
  const bool by_force = end == ContactEnd::zero_force && D > 0;
  Ode ode(4, D < 8 ? Ode::Method::adams : Ode::Method::bdf,
          [&](double, const double* y, double* rate) {
            const double force = scaled_force(law, D, y[0], y[1]);
            rate[0] = y[1];
            rate[1] = -force;
            rate[2] = y[3];
            rate[3] = -lambda * force * y[2];
          });
  const int falling[] = {-1};
  ode.watch(
      1,
      [&](double, const double* y, double* value) {
        value[0] = by_force ? scaled_force_sign(law, D, y[0], y[1]) : y[0];
      },
      falling);
  constexpr double kTolerance = 1e-10;
  constexpr double kLongest = 100;  // of a contact that fades: an elastic one takes 3
  const double start[] = {0, 1, 0, 1};
  const double floor[] = {1e-12, 1e-12, 1e-12, 1e-12};
  ode.start(0, start, kTolerance, floor);
  while (ode.step(ode.time() + 1) != Ode::Stop::root && ode.time() < kLongest) {
  }
  return std::abs(ode.y()[3]) - 1;
}

/// Λ at which |ε^T| = 1, between one that is passive and one that gains.
template <class Gain>
double bisect(double passive, double gains, const Gain& gain_at) {
  while (gains - passive > 1e-8 * gains) {
    const double mid = 0.5 * (passive + gains);
    (gain_at(mid) > 0 ? gains : passive) = mid;
  }
  return passive;
}

}  // namespace

double largest_passive_bend(const ScaledLaw& law, ContactEnd end, double dissipation) {
  constexpr double kRounding = 1e-8;  // of ε^T
  const double rise = 0.5 * law.speed_exponent() * (1 + law.alpha);
  const auto gain_at = [&](double lambda) {
    return gain(law, dissipation > 0 ? dissipation * std::pow(lambda, rise) : 0, end, lambda);
  };
  // The asperity turns by about √Λ in a collision: it is looked at a tenth of a radian apart.
  const double most = dissipation > 0 ? 100 * largest_passive_bend(law, end, 0) : HUGE_VAL;
  double passive = 0;
  for (double root = 0.1; root * root <= most; root += 0.1) {
    if (gain_at(root * root) > kRounding) return bisect(passive, root * root, gain_at);
    passive = root * root;
  }
  return std::numeric_limits<double>::infinity();
}

double PassiveSpeeds::of(const ImpactScales& at_one, double bend_per_length) {
  const double at_one_speed = bend_per_length * at_one.length;  // Λ
  const double power = 0.5 * (1 + at_one.law.alpha);
  double dissipation =
      at_one.dissipation * std::pow(at_one_speed, -power * at_one.law.speed_exponent());
  if (dissipation > 0) {
    const double unit = std::pow(10, std::floor(std::log10(dissipation)) - 3);
    dissipation = std::round(dissipation / unit) * unit;
  }
  const auto [found, is_new] = bend_.try_emplace(dissipation);
  if (is_new) found->second = largest_passive_bend(at_one.law, end_, dissipation);
  return std::pow(found->second / at_one_speed, power);
}

}  // namespace slipcheck
