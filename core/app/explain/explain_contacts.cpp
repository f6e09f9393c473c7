#include "app/explain/explain_contacts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/explain/explain_rows.h"
#include "physics/contact/elastic_pair.h"
#include "physics/contact/quasistatic.h"
#include "physics/contact/step_limits.h"
#include "scene/impact.h"

namespace slipcheck {
namespace {

/// Who has a contact, and how fast they meet.
struct Partners {
  std::string names;  ///< "i and j"
  double mass = 0;    ///< effective [kg]
  double speed = 1;   ///< [m/s]
  const PairContact* hard = nullptr;
  const std::optional<SoftContact>* soft = nullptr;
};

Partners bodies(const Scenario& scenario, const ContactScene& scene, std::size_t i, std::size_t j,
                double speed) {
  return {scenario.bodies[i].name + " and " + scenario.bodies[j].name,
          effective_mass(scene.hard.bodies[i], scene.hard.bodies[j]), speed,
          &scene.hard.between(i, j), &scene.between(i, j)};
}

/// The first body that meets the floor, walls or lid by this contact.
std::optional<Partners> at_surface(const Scenario& scenario, const ContactScene& scene,
                                   const BodyContact& contact, double speed) {
  const Box& box = *scene.hard.box;
  const SoftBox& soft = scene.soft_box;
  const bool floor = contact.second == "floor", wall = contact.second == "wall";
  if (!floor && !wall && !box.lid) return std::nullopt;
  const auto& hard_ones = floor ? box.on_floor : wall ? box.on_wall : box.on_lid;
  const auto& soft_ones = floor ? soft.on_floor : wall ? soft.on_wall : soft.on_lid;
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    if (scenario.bodies[i].material != contact.first) continue;
    const std::size_t material = scene.hard.material[i];
    return Partners{scenario.bodies[i].name, scene.hard.bodies[i].mass, speed, &hard_ones[material],
                    &soft_ones[material]};
  }
  return std::nullopt;
}

/// Those that meet first, if it is their contact; else the first two that can have it.
std::optional<Partners> partners(const Scenario& scenario, const ContactScene& scene,
                                 const BodyContact& contact, const std::optional<Meeting>& meeting,
                                 double typical_speed) {
  if (contact.second == "floor" || contact.second == "wall" || contact.second == "lid")
    return at_surface(scenario, scene, contact, typical_speed);
  const auto have_it = [&](std::size_t i, std::size_t j) {
    const std::string &a = scenario.bodies[i].material, &b = scenario.bodies[j].material;
    return (a == contact.first && b == contact.second) ||
           (a == contact.second && b == contact.first);
  };
  const double speed = meeting ? meeting->closing_speed() : typical_speed;
  if (meeting && have_it(meeting->first, meeting->second))
    return bodies(scenario, scene, meeting->first, meeting->second, speed);
  // The first of its kind with any other: with the first of the other kind, or the next of its own.
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    const std::string& kind = scenario.bodies[i].material;
    if (kind != contact.first && kind != contact.second) continue;
    for (std::size_t j = i + 1; j < scenario.bodies.size(); ++j)
      if (have_it(i, j)) return bodies(scenario, scene, i, j, speed);
    break;
  }
  return std::nullopt;
}

void print_restitution_and_time(double e, double duration, double overlap, double speed) {
  const std::string at = "at " + quantity(speed, kVelocity);
  print_row("e_n", pure(e), "restitution " + at);
  print_row("t_col", quantity(duration, kTime),
            std::isinf(duration) ? "the spheres never part" : "duration of a collision " + at);
  print_row("x_max", quantity(overlap, kLength), "largest overlap " + at);
}

/// Laws of which no closed form is known: one collision is integrated.
void print_integrated(const SoftContact& soft, double mass, double speed) {
  const Impact found = impact(soft.normal, mass, speed, soft.end);
  print_restitution_and_time(found.restitution, found.duration, found.largest_overlap, speed);
}

void print_normal(const LinearForce& law, const SoftContact& soft, double mass, double speed) {
  const LinearContact c(mass, law.stiffness, law.damping / mass, soft.end);
  const double omega0 = c.contact_frequency(), gamma = c.damping_rate();
  print_restitution_and_time(c.restitution(), c.collision_time(), c.largest_overlap(speed), speed);
  print_row("k", in_unit(c.stiffness(), "N/m"), "stiffness");
  print_row("γ_N", in_unit(gamma, "1/s"), "normal damping");
  print_row("ω0", in_unit(omega0, "1/s"), "contact frequency √(k/m̄)");
  print_row("ε", pure(c.damping_ratio()), "damping ratio γ_N/ω0; the critical one is 2");
  print_row("Δt", quantity(symplectic_euler_limit(omega0, gamma), kTime),
            "largest stable step of symplectic Euler");
  print_row("", quantity(velocity_verlet_limit(omega0), kTime), "of velocity Verlet, undamped");
  print_row("", quantity(runge_kutta_limit(omega0), kTime), "of Runge-Kutta 4, undamped");
  print_row("", quantity(explicit_euler_limit(omega0, gamma), kTime), "of explicit Euler");
}

void print_normal(const HertzForce& law, const SoftContact& soft, double mass, double speed) {
  print_integrated(soft, mass, speed);
  print_row("ρ", in_unit(law.modulus, "N/m^1.5"), "F = ρ ξ^(3/2)");
}

void print_normal(const PowerForce& law, const SoftContact& soft, double mass, double speed) {
  print_integrated(soft, mass, speed);
  print_row("E", in_unit(law.modulus, fmt::format("N/m^{:g}", law.alpha)),
            fmt::format("F = E ξ^{:g} + η ξ^{:g} ξ̇", law.alpha, law.gamma));
  print_row("η", in_unit(law.viscosity, fmt::format("N s/m^{:g}", 1 + law.gamma)), "viscosity");
}

void print_viscoelastic(double modulus, double dissipation_time, const char* form,
                        const SoftContact& soft, double mass, double speed) {
  print_integrated(soft, mass, speed);
  print_row("ρ", in_unit(modulus, "N/m^1.5"), form);
  print_row("A", quantity(dissipation_time, kTime), "dissipation time");
  const double t_c = hertz_duration(mass, modulus, speed);
  print_row("A/t_c", pure(dissipation_time / t_c), "far below 1 where the law holds, B (12)");
}
void print_normal(const ViscoelasticForce& law, const SoftContact& soft, double mass,
                  double speed) {
  print_viscoelastic(law.modulus, law.dissipation_time, "F = ρ (ξ^(3/2) + (3/2) A √ξ ξ̇)", soft,
                     mass, speed);
}
void print_normal(const CompactViscoelasticForce& law, const SoftContact& soft, double mass,
                  double speed) {
  print_viscoelastic(law.modulus, law.dissipation_time, "F = ρ (ξ + A ξ̇)^(3/2)", soft, mass, speed);
}

void print_tangential(const NoTangentialForce&, double) {}
void print_tangential(const ViscousForce& law, double mass) {
  print_row("γ_S", in_unit(law.damping / mass, "1/s"), "tangential damping");
  print_row("ν_s", pure(law.friction), "Coulomb's cap on it");
}
void print_tangential(const AsperityForce& law, double) {
  print_row("μ", pure(law.friction), "friction at which asperities break");
  print_row("ζ0", quantity(law.size, kLength), "size of asperities");
}

/// B (11), for laws made from the materials.
void print_sound(const Scenario& scenario, const BodyContact& contact, double speed) {
  double slowest = HUGE_VAL;
  for (const std::string& name : {contact.first, contact.second}) {
    const auto found = scenario.materials.find(name);
    if (found == scenario.materials.end()) continue;
    const Material& material = found->second;
    if (material.young_modulus && material.density)
      slowest = std::min(slowest, sound_speed(*material.young_modulus, *material.density));
  }
  if (std::isfinite(slowest))
    print_row("g/c", pure(speed / slowest),
              fmt::format("impact speed over that of sound, {}; far below 1, B (11)",
                          quantity(slowest, kVelocity)));
}

void print_hard(const PairContact& contact, double speed) {
  print_row("e_n", pure(restitution_at(contact.restitution, speed)),
            "restitution at " + quantity(speed, kVelocity));
  if (contact.friction == 0) return;
  print_row("μ", pure(contact.friction), "friction");
  print_row("β0", pure(contact.tangential_restitution), "tangential restitution where it sticks");
}

const char* end_name(ContactEnd end) {
  return end == ContactEnd::zero_overlap ? "ends at zero overlap" : "ends at zero force";
}

}  // namespace

std::optional<LinearContact> linear_contact_between(const ContactScene& scene, std::size_t i,
                                                    std::size_t j) {
  const auto& soft = scene.between(i, j);
  if (!soft) return std::nullopt;
  const auto* linear = std::get_if<LinearForce>(&soft->normal);
  if (!linear) return std::nullopt;
  const double mass = effective_mass(scene.hard.bodies[i], scene.hard.bodies[j]);
  return LinearContact(mass, linear->stiffness, linear->damping / mass, soft->end);
}

void explain_contacts(const Scenario& scenario, const ContactScene& scene,
                      const std::optional<Meeting>& meeting, double typical_speed) {
  constexpr const char* kNormal[] = {"linear", "hertz", "power", "viscoelastic, expanded",
                                     "viscoelastic, compact"};
  constexpr const char* kTangential[] = {"no rubbing", "viscous rubbing", "asperities"};
  for (const BodyContact& contact : scenario.contacts) {
    const auto found = partners(scenario, scene, contact, meeting, typical_speed);
    if (!found) continue;
    const double speed = found->speed, mass = found->mass;
    fmt::print("\n  Contact {} on {} ({}): ", contact.first, contact.second, found->names);
    const std::optional<SoftContact>& soft = *found->soft;
    if (!soft) {
      fmt::print("hard\n");
      print_hard(*found->hard, speed);
      continue;
    }
    fmt::print("{}, {}, {}\n", kNormal[soft->normal.index()], end_name(soft->end),
               kTangential[soft->tangential.index()]);
    std::visit([&](const auto& law) { print_normal(law, *soft, mass, speed); }, soft->normal);
    std::visit([&](const auto& law) { print_tangential(law, mass); }, soft->tangential);
    if (!std::holds_alternative<LinearForce>(soft->normal) &&
        !std::holds_alternative<PowerForce>(soft->normal))
      print_sound(scenario, contact, speed);
  }
}

}  // namespace slipcheck
