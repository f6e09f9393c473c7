#include "app/explain_contacts.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "physics/linear_contact.h"

namespace slipcheck {
namespace {

/// The first two bodies that can have this contact.
struct Partners {
  const Body* first = nullptr;
  const Body* second = nullptr;
};

Partners partners(const Scenario& scenario, const BodyContact& contact) {
  Partners found;
  for (const Body& body : scenario.bodies) {
    if (!found.first && body.material == contact.first)
      found.first = &body;
    else if (!found.second && body.material == contact.second)
      found.second = &body;
  }
  return found;
}

/// As the file gives it. Throws std::domain_error where no such contact exists.
LinearContact linear_contact(const LinearNormal& model, const Partners& bodies) {
  const double mi = bodies.first->sphere.mass, mj = bodies.second->sphere.mass;
  const double m = mi * mj / (mi + mj);
  const auto end = model.ends_at == EndsAt::zero_overlap ? LinearContact::End::zero_overlap
                                                         : LinearContact::End::zero_force;
  if (model.restitution && model.collision_time)
    return LinearContact::with_collision_time(m, *model.restitution, *model.collision_time, end);
  if (model.restitution)
    return LinearContact::with_stiffness(m, *model.restitution, *model.stiffness, end);
  if (model.stiffness) {
    if (*model.damping_rate >= 2 * std::sqrt(*model.stiffness / m))
      throw std::domain_error("damping_rate must be below 2 ω0, the critical one");
    return {m, *model.stiffness, *model.damping_rate, end};
  }
  // t_col and γ_N: ω0² = (π/t_col)² + γ_N²/4 under zero_overlap.
  if (end == LinearContact::End::zero_force)
    throw std::domain_error("collision_time with damping_rate needs ends_at: zero_overlap");
  const double w = M_PI / *model.collision_time, half = 0.5 * *model.damping_rate;
  return {m, m * (w * w + half * half), *model.damping_rate, end};
}

void print_rubbing(const ViscousTangential& model, const LinearContact& contact, double A) {
  const double rate =
      model.damping_rate ? *model.damping_rate : *model.damping_ratio * contact.damping_rate();
  const double c = rubbing_constant(A, rate, contact.contact_frequency());
  fmt::print(
      "      γ_S = {:.6g} 1/s, C = {:.4g} (first order), {:.4g} (exponential); friction {:g} "
      "caps it\n",
      rate, c, rubbed_share(c), model.friction);
}

}  // namespace

void explain_contacts(const Scenario& scenario) {
  fmt::print("\n  Contacts\n");
  for (const BodyContact& contact : scenario.contacts) {
    const auto* linear = std::get_if<LinearNormal>(&contact.normal);
    const Partners bodies = partners(scenario, contact);
    if (!linear || !bodies.first || !bodies.second) continue;
    fmt::print("    {} on {} ({} and {}), linear\n", contact.first, contact.second,
               bodies.first->name, bodies.second->name);
    try {
      const LinearContact c = linear_contact(*linear, bodies);
      fmt::print(
          "      t_col = {:.6g} s, e_n = {:.10g}, k = {:.6g} N/m, γ_N = {:.6g} 1/s\n"
          "      ω0 = {:.6g} 1/s, ε = γ_N/ω0 = {:.4g}, x_max = {:.4g} m at 1 m/s\n",
          c.collision_time(), c.restitution(), c.stiffness(), c.damping_rate(),
          c.contact_frequency(), c.damping_ratio(), c.largest_overlap(1));
      if (const auto* viscous = std::get_if<ViscousTangential>(&contact.tangential))
        print_rubbing(*viscous, c, bodies.first->sphere.inverse_shape_factor());
    } catch (const std::domain_error& error) {
      fmt::print("      {}\n", error.what());
    }
  }
}

std::optional<Scenario> hard_equivalent(const Scenario& scenario) {
  Scenario hard = scenario;
  hard.compare.reference = Compare::Reference::automatic;
  for (BodyContact& contact : hard.contacts) {
    if (const auto* linear = std::get_if<LinearNormal>(&contact.normal)) {
      const Partners bodies = partners(scenario, contact);
      if (!bodies.first || !bodies.second) continue;
      try {
        contact.normal = HardNormal{linear_contact(*linear, bodies).restitution()};
      } catch (const std::domain_error&) {
        return std::nullopt;  // explain_contacts() has said why
      }
      contact.tangential = NoTangential{};
    } else if (!std::holds_alternative<HardNormal>(contact.normal)) {
      return std::nullopt;
    }
  }
  return hard;
}

}  // namespace slipcheck
