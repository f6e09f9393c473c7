#include "convert/engine_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace slipcheck {
namespace {

constexpr int kMostSteps = 1'000'000;
constexpr auto kEnd = LinearContact::End::zero_force;

LinearContact contact_of_rates(double reduced_mass, double omega0_squared, double gamma) {
  return {reduced_mass, reduced_mass * omega0_squared, gamma, kEnd};
}

/// A contact's approach velocity ξ̇ after a step, from overlap ξ and ξ̇ at its start. Contacts push
/// only.
double next_approach(const LinearContact& contact, ContactStep step, double h, double xi,
                     double xi_dot) {
  const double gamma = contact.damping_rate();
  const double omega2 = contact.contact_frequency() * contact.contact_frequency();
  if (xi > 0) {
    if (step == ContactStep::force_at_start)
      return xi_dot + h * std::min(0.0, -gamma * xi_dot - omega2 * xi);
    return std::min(xi_dot, (xi_dot - h * omega2 * xi) / (1 + h * gamma + h * h * omega2));
  }
  if (step != ContactStep::foreseen || xi + h * xi_dot <= 0) return xi_dot;
  const double stiff = omega2 + gamma / h;
  return std::min(xi_dot, (xi_dot - h * stiff * xi) / (1 + h * h * stiff));
}

}  // namespace

SolRef time_solref(const LinearContact& contact) {
  if (contact.damping_rate() == 0) return {std::numeric_limits<double>::infinity(), 0};
  return {2 / contact.damping_rate(), contact.damping_ratio() / 2};
}

SolRef stiffness_solref(const LinearContact& contact) {
  return {-contact.contact_frequency() * contact.contact_frequency(), 0 - contact.damping_rate()};
}

LinearContact contact_of_solref(const SolRef& solref, double reduced_mass, double time_step) {
  if (solref.first <= 0) return contact_of_rates(reduced_mass, -solref.first, -solref.second);
  const double timeconst = std::max(solref.first, 2 * time_step);
  const double omega0 = 1 / (timeconst * solref.second);
  return contact_of_rates(reduced_mass, omega0 * omega0, 2 / timeconst);
}

double damping_constant(const LinearContact& contact) {
  return contact.damping_rate() * contact.reduced_mass();
}

ErpCfm erp_cfm(const LinearContact& contact, double time_step) {
  const double spring = time_step * contact.stiffness();
  const double sum = spring + damping_constant(contact);
  return {spring / sum, 1 / sum};
}

double rebound(const LinearContact& contact, ContactStep step, double time_step, double phase) {
  double xi = (phase - 1) * time_step, xi_dot = 1;  // at the start of the step that brings contact
  for (int n = 0; n < kMostSteps; ++n) {
    xi_dot = next_approach(contact, step, time_step, xi, xi_dot);
    xi += time_step * xi_dot;
    if (xi < 0 && xi_dot < 0) return -xi_dot;
  }
  return 0;
}

ReboundRange rebounds(const LinearContact& contact, ContactStep step, double time_step,
                      std::size_t phases) {
  std::vector<double> all;
  for (std::size_t k = 0; k < phases; ++k)
    all.push_back(rebound(contact, step, time_step,
                          (static_cast<double>(k) + 0.5) / static_cast<double>(phases)));
  std::ranges::sort(all);
  const double median = (all[(phases - 1) / 2] + all[phases / 2]) / 2;
  return {all.front(), median, all.back()};
}

}  // namespace slipcheck
