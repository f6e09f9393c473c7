#include "physics/linear_contact.h"

#include <cmath>
#include <stdexcept>

namespace slipcheck {

LinearContact::LinearContact(double reduced_mass, double stiffness, double damping_rate, End end)
    : reduced_mass_(reduced_mass),
      stiffness_(stiffness),
      damping_rate_(damping_rate),
      omega0_(std::sqrt(stiffness / reduced_mass)),
      omega_(std::sqrt((omega0_ - 0.5 * damping_rate) * (omega0_ + 0.5 * damping_rate))),
      end_(end) {}

double LinearContact::collision_time() const {
  if (end_ == End::zero_overlap) return M_PI / omega_;
  // F_N = 0: tan ωt = −γ_N ω/(ω0² − γ_N²/2).
  const double phase =
      std::atan2(damping_rate_ * omega_, omega0_ * omega0_ - 0.5 * damping_rate_ * damping_rate_);
  return (M_PI - phase) / omega_;
}

double LinearContact::restitution() const {
  const double t = collision_time();
  const double half = 0.5 * damping_rate_;
  // −ξ̇/v of ξ = (v/ω) e^(−γt/2) sin ωt
  return std::exp(-half * t) * (half / omega_ * std::sin(omega_ * t) - std::cos(omega_ * t));
}

double LinearContact::largest_overlap(double v) const {
  const double half = 0.5 * damping_rate_;
  // ξ̇ = 0: tan ωt = 2ω/γ_N, where sin ωt = ω/ω0.
  const double t = std::atan2(omega_, half) / omega_;
  return v / omega0_ * std::exp(-half * t);
}

LinearContact LinearContact::with_stiffness(double reduced_mass, double restitution,
                                            double stiffness, End end) {
  const double omega0 = std::sqrt(stiffness / reduced_mass);
  if (end == End::zero_overlap) {
    const double loss = -std::log(restitution);
    return {reduced_mass, stiffness, 2 * loss * omega0 / std::hypot(M_PI, loss), end};
  }
  // e_n falls steadily from 1 with γ_N; it is e^−2 at critical damping.
  if (restitution <= std::exp(-2.0))
    throw std::domain_error("restitution must be in (0.1354, 1] for ends_at: zero_force");
  double low = 0, high = 2 * omega0;
  for (int n = 0; n < 200; ++n) {
    const double mid = 0.5 * (low + high);
    if (mid <= low || mid >= high) break;
    (LinearContact(reduced_mass, stiffness, mid, end).restitution() > restitution ? low : high) =
        mid;
  }
  return {reduced_mass, stiffness, low, end};
}

LinearContact LinearContact::with_collision_time(double reduced_mass, double restitution,
                                                 double collision_time, End end) {
  // ε depends on e_n alone, and all times scale with 1/ω0.
  const LinearContact unit = with_stiffness(1, restitution, 1, end);
  const double omega0 = unit.collision_time() / collision_time;
  return {reduced_mass, reduced_mass * omega0 * omega0, unit.damping_rate() * omega0, end};
}

double rubbing_constant(double A, double tangential_damping_rate, double contact_frequency) {
  return M_PI * A * tangential_damping_rate / (2 * contact_frequency);
}

double rubbed_share(double rubbing_constant) { return -0.5 * std::expm1(-2 * rubbing_constant); }

}  // namespace slipcheck
