#include "physics/contact/linear_contact.h"

#include <cmath>
#include <limits>

namespace slipcheck {
namespace {

/// The x > 0 at which a falling function has this value, by halving; between 0 and infinity.
template <class Falling>
double where(double value, double near, Falling falling) {
  double high = near;
  while (falling(high) > value) high *= 2;
  double low = high > near ? high / 2 : 0;
  for (int n = 0; n < 200; ++n) {
    const double mid = 0.5 * (low + high);
    if (mid <= low || mid >= high) break;
    (falling(mid) > value ? low : high) = mid;
  }
  return low;
}

}  // namespace

LinearContact::LinearContact(double reduced_mass, double stiffness, double damping_rate, End end)
    : reduced_mass_(reduced_mass),
      stiffness_(stiffness),
      damping_rate_(damping_rate),
      omega0_(std::sqrt(stiffness / reduced_mass)),
      omega_(std::sqrt(std::abs((omega0_ - 0.5 * damping_rate) * (omega0_ + 0.5 * damping_rate)))),
      end_(end) {}

double LinearContact::deepest_after() const {
  const double half = 0.5 * damping_rate_;
  if (omega_ == 0) return 1 / half;
  if (!is_over_critical()) return std::atan2(omega_, half) / omega_;
  // atanh(|ω|/(γ_N/2)) = asinh(|ω|/ω0), without the difference of near numbers
  return std::asinh(omega_ / omega0_) / omega_;
}

double LinearContact::collision_time() const {
  if (end_ == ContactEnd::zero_force) return 2 * deepest_after();
  return is_over_critical() ? std::numeric_limits<double>::infinity() : M_PI / omega_;
}

double LinearContact::restitution() const {
  if (end_ == ContactEnd::zero_overlap && is_over_critical()) return 0;
  return std::exp(-0.5 * damping_rate_ * collision_time());
}

double LinearContact::largest_overlap(double v) const {
  // ξ = (v/ω) e^(−γt/2) sin ωt, and sin ωτ = ω/ω0
  return v / omega0_ * std::exp(-0.5 * damping_rate_ * deepest_after());
}

LinearContact LinearContact::with_stiffness(double reduced_mass, double restitution,
                                            double stiffness, End end) {
  const double omega0 = std::sqrt(stiffness / reduced_mass);
  if (end == ContactEnd::zero_overlap) {
    const double loss = -std::log(restitution);
    return {reduced_mass, stiffness, 2 * loss * omega0 / std::hypot(M_PI, loss), end};
  }
  // e_n falls steadily from 1 to 0 with ε alone.
  const double ratio = where(
      restitution, 2, [&](double each) { return LinearContact(1, 1, each, end).restitution(); });
  return {reduced_mass, stiffness, ratio * omega0, end};
}

LinearContact LinearContact::with_collision_time(double reduced_mass, double restitution,
                                                 double collision_time, End end) {
  // ε depends on e_n alone, and all times scale with 1/ω0.
  const LinearContact unit = with_stiffness(1, restitution, 1, end);
  const double omega0 = unit.collision_time() / collision_time;
  return {reduced_mass, reduced_mass * omega0 * omega0, unit.damping_rate() * omega0, end};
}

LinearContact LinearContact::with_damping_rate(double reduced_mass, double damping_rate,
                                               double collision_time, End end) {
  double omega0 = 0;
  if (end == ContactEnd::zero_overlap) {
    omega0 = std::hypot(M_PI / collision_time, 0.5 * damping_rate);
  } else {
    // 2τ falls steadily with ω0, from infinity to 0.
    omega0 = where(collision_time, M_PI / collision_time, [&](double each) {
      return LinearContact(1, each * each, damping_rate, end).collision_time();
    });
  }
  return {reduced_mass, reduced_mass * omega0 * omega0, damping_rate, end};
}

double rubbing_constant(double A, double tangential_damping_rate, double contact_frequency) {
  return M_PI * A * tangential_damping_rate / (2 * contact_frequency);
}

double rubbed_share(double rubbing_constant) { return -0.5 * std::expm1(-2 * rubbing_constant); }

}  // namespace slipcheck
