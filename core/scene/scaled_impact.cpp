#include "scene/scaled_impact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <variant>

#include "scene/ode.h"

namespace slipcheck {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// From here on the force is stiff against the motion.
constexpr double kStiff = 8;
/// From here on every law gives back less than 1e-7 of the impact speed: the spheres stay.
constexpr double kSticks = 1e7;
/// Beyond it nothing of the impact speed is left in double precision that anybody measures.
constexpr double kLargestDissipation = 300;

double odd_power(double x, double exponent) {
  return std::copysign(std::pow(std::abs(x), exponent), x);
}

/// Whether the sphere on its way back, x > 0 and ẋ <= 0, never comes to x = 0.
///
/// With w = −ẋ x^−s, s = α − γ, and l = ln(1/x) the law reads
///   dw/dl = [x^−d (1 − D w) + s w²]/w, d = α − 1 − 2γ.
/// For d >= 0, that is p <= 0, a w below the larger root of s x^d w² − D w + 1 = 0 stays below it,
/// as that root grows while x falls; and ẋ = −w x^s with s >= 1 and bounded w takes for ever.
bool never_parts(const ScaledLaw& law, double D, double x, double rate) {
  const double d = law.alpha - 1 - 2 * law.gamma, s = law.alpha - law.gamma;
  if (law.compact || d < 0 || !(x > 0) || rate > 0) return false;
  const double a = s * std::pow(x, d), discriminant = D * D - 4 * a;
  if (discriminant < 0) return false;
  return -rate * std::pow(x, -s) * 2 * a <= D + std::sqrt(discriminant);
}

/// A dashpot so strong that it stops the impact by itself: ẋ dẋ/dx = −D x^γ ẋ, or −(D ẋ)^α.
Impact stuck_impact(const ScaledLaw& law, double D) {
  Impact found;
  found.restitution = 0;
  found.duration = found.largest_overlap_at = kInfinity;
  found.largest_overlap = law.compact ? std::pow(D, -law.alpha) / (2 - law.alpha)
                                      : std::pow((1 + law.gamma) / D, 1 / (1 + law.gamma));
  return found;
}

}  // namespace

double scaled_force(const ScaledLaw& law, double D, double x, double rate) {
  if (law.compact) return odd_power(x + D * rate, law.alpha);
  return odd_power(x, law.alpha) + D * std::pow(std::abs(x), law.gamma) * rate;
}

double scaled_force_sign(const ScaledLaw& law, double D, double x, double rate) {
  if (law.compact) return x + D * rate;
  const double least = std::min(law.alpha, law.gamma);
  return odd_power(x, law.alpha - least) + D * std::pow(std::abs(x), law.gamma - least) * rate;
}

Impact scaled_impact(const ScaledLaw& law, double D, ContactEnd end, double tolerance) {
  if (D > kSticks) return stuck_impact(law, D);
  const bool by_force = end == ContactEnd::zero_force && D > 0;
  Ode ode(2, D < kStiff ? Ode::Method::adams : Ode::Method::bdf,
          [&](double, const double* y, double* rate) {
            rate[0] = y[1];
            rate[1] = -scaled_force(law, D, y[0], y[1]);
          });
  // The end and, on the way, the deepest overlap.
  const int falling[] = {-1, -1};
  ode.watch(
      2,
      [&](double, const double* y, double* value) {
        value[0] = by_force ? scaled_force_sign(law, D, y[0], y[1]) : y[0];
        value[1] = y[1];
      },
      falling);
  // Of a strong damping little is left over: D^−5 of the speed in B (24), anything where p <= 0.
  const bool fades = end == ContactEnd::zero_overlap && law.speed_exponent() <= 0;
  const double least = fades && D < kStiff ? 1e-200 : std::pow(std::max(D, 1.0), -6.0);
  const double start[] = {0, 1};
  const double floor[] = {1e-3 * tolerance * least, 1e-3 * tolerance * least};
  ode.start(0, start, tolerance, floor);

  Impact found;
  double limit = 1;
  for (;;) {
    const Ode::Stop stop = ode.step(limit);
    const double x = ode.y()[0], rate = ode.y()[1];
    if (stop == Ode::Stop::limit) limit *= 4;
    if (stop == Ode::Stop::root) {
      if (ode.roots_found()[1] != 0) {
        found.largest_overlap = x;
        found.largest_overlap_at = ode.time();
      }
      if (ode.roots_found()[0] != 0) {
        found.restitution = std::clamp(-rate, 0.0, 1.0);
        found.duration = ode.time();
        return found;
      }
    }
    const bool is_back = found.largest_overlap > 0;
    if (is_back && end == ContactEnd::zero_overlap && never_parts(law, D, x, rate)) {
      found.restitution = 0;
      found.duration = kInfinity;
      return found;
    }
  }
}

ImpactScales impact_scales(const NormalForce& force, double reduced_mass, double speed) {
  const double m = reduced_mass, v = speed;
  ImpactScales scales;
  const auto set = [&](double modulus, double alpha) {
    scales.law.alpha = alpha;
    scales.length = std::pow(m / modulus * v * v, 1 / (1 + alpha));
    scales.time = scales.length / v;
  };
  static_assert(std::variant_size_v<NormalForce> == 5, "a law has scales of its own here");
  if (const auto* linear = std::get_if<LinearForce>(&force)) {
    scales.law.gamma = 0;
    set(linear->stiffness, 1);
    scales.dissipation = linear->damping * scales.time / m;
  } else if (const auto* hertz = std::get_if<HertzForce>(&force)) {
    set(hertz->modulus, 1.5);
  } else if (const auto* power = std::get_if<PowerForce>(&force)) {
    scales.law.gamma = power->gamma;
    set(power->modulus, power->alpha);
    scales.dissipation =
        power->viscosity * std::pow(scales.length, power->gamma) * (scales.time / m);
  } else if (const auto* expanded = std::get_if<ViscoelasticForce>(&force)) {
    set(expanded->modulus, 1.5);
    scales.dissipation = 1.5 * expanded->dissipation_time / scales.time;
  } else {
    const auto& compact = std::get<CompactViscoelasticForce>(force);
    scales.law.compact = true;
    set(compact.modulus, 1.5);
    scales.dissipation = compact.dissipation_time / scales.time;
  }
  return scales;
}

NormalForce with_dissipation(NormalForce force, double reduced_mass, double speed, double D) {
  const ImpactScales scales = impact_scales(force, reduced_mass, speed);
  if (auto* linear = std::get_if<LinearForce>(&force)) {
    linear->damping = D * reduced_mass / scales.time;
  } else if (auto* power = std::get_if<PowerForce>(&force)) {
    power->viscosity = D * (reduced_mass / scales.time) * std::pow(scales.length, -power->gamma);
  } else if (auto* expanded = std::get_if<ViscoelasticForce>(&force)) {
    expanded->dissipation_time = D * scales.time / 1.5;
  } else if (auto* compact = std::get_if<CompactViscoelasticForce>(&force)) {
    compact->dissipation_time = D * scales.time;
  }
  return force;
}

double dissipation_for(const ScaledLaw& law, ContactEnd end, double restitution) {
  constexpr double kTolerance = 1e-12;
  if (restitution == 1) return 0;
  const auto excess = [&](double log_D) {
    const double e = scaled_impact(law, std::exp(log_D), end, kTolerance).restitution;
    return std::log(e / restitution) - std::log1p(-e) + std::log1p(-restitution);
  };
  // e falls from 1 to 0; 1 − e is in proportion to D where that is small.
  const auto out_of_reach = [&](double least, double most, const char* left, const char* right) {
    throw UnreachableRestitution(
        fmt::format("must be in {}{:.4g}, {:.8g}{}", left, least, most, right));
  };
  if (!(restitution > 0 && restitution <= 1)) out_of_reach(0, 1, "(", "]");
  double high = std::log(std::min(10 * (1 - restitution), 1.0)), at_high = excess(high);
  double low = high, at_low = at_high;
  while (at_high > 0) {
    low = high, at_low = at_high;
    if (high >= std::log(kLargestDissipation)) {
      const double e = scaled_impact(law, std::exp(high), end, kTolerance).restitution;
      out_of_reach(e, 1, "[", "]");
    }
    high = std::min(high + 1, std::log(kLargestDissipation));
    at_high = excess(high);
  }
  while (at_low < 0) {
    high = low, at_high = at_low;
    low -= 3;
    at_low = excess(low);
  }
  // False position with the Illinois rule; halving where the rebound is nil.
  int side = 0;
  for (int n = 0; n < 200 && at_low != 0 && at_high != 0; ++n) {
    const double mid = std::isfinite(at_high) ? low + (high - low) * (at_low / (at_low - at_high))
                                              : 0.5 * (low + high);
    if (!(mid > low && mid < high)) break;
    const double at_mid = excess(mid);
    if (std::abs(at_mid) < 1e-13 || high - low < 1e-14) return std::exp(mid);
    if (at_mid > 0) {
      low = mid, at_low = at_mid;
      if (side == 1) at_high *= 0.5;
      side = 1;
    } else {
      high = mid, at_high = at_mid;
      if (side == -1) at_low *= 0.5;
      side = -1;
    }
  }
  return std::exp(at_high == 0 ? high : low);
}

}  // namespace slipcheck
