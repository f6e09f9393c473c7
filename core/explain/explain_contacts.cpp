#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "explain/explain_parts.h"
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
  double slip = 0;    ///< of their surfaces as they meet [m/s]
  PairContact hard = {};
  std::optional<SoftContact> soft = {};
};

Partners bodies(const Scenario& scenario, const ContactScene& scene, std::size_t i, std::size_t j,
                double speed, double slip) {
  return {scenario.bodies[i].name + " and " + scenario.bodies[j].name,
          effective_mass(scene.hard.bodies[i], scene.hard.bodies[j]),
          speed,
          slip,
          scene.hard.between(i, j),
          scene.contact_of(i, j)};
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
    return Partners{scenario.bodies[i].name, scene.hard.bodies[i].mass, speed, 0,
                    hard_ones[material],     soft_ones[material]};
  }
  return std::nullopt;
}

/// Of the first body's surface on the second's, across the line of centres [m/s].
double slip_of(const Scene& scene, const Meeting& meeting) {
  const double r_a = scene.bodies[meeting.first].radius, r_b = scene.bodies[meeting.second].radius;
  const Vector3 u =
      meeting.a.velocity - meeting.b.velocity +
      (r_a * meeting.a.angular_velocity + r_b * meeting.b.angular_velocity).cross(meeting.n);
  return (u - u.dot(meeting.n) * meeting.n).norm();
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
    return bodies(scenario, scene, meeting->first, meeting->second, speed,
                  slip_of(scene.hard, *meeting));
  // The first of its kind with any other: with the first of the other kind, or the next of its own.
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    const std::string& kind = scenario.bodies[i].material;
    if (kind != contact.first && kind != contact.second) continue;
    for (std::size_t j = i + 1; j < scenario.bodies.size(); ++j)
      if (have_it(i, j)) return bodies(scenario, scene, i, j, speed, 0);
    break;
  }
  return std::nullopt;
}

void add_restitution_and_time(ExplainSection& section, double e, double duration, double overlap,
                              double speed) {
  const std::string at = "at " + quantity(speed, kVelocity);
  section.add("e_n", pure(e), "restitution " + at);
  section.add("t_col", quantity(duration, kTime),
              std::isinf(duration) ? "the spheres never part" : "duration of a collision " + at);
  section.add("x_max", quantity(overlap, kLength), "largest overlap " + at);
}

/// Laws of which no closed form is known: one collision is integrated.
void add_integrated(ExplainSection& section, const SoftContact& soft, double mass, double speed) {
  const Impact found = impact(soft.normal, mass, speed, soft.end);
  add_restitution_and_time(section, found.restitution, found.duration, found.largest_overlap,
                           speed);
}

void add_normal(ExplainSection& section, const LinearForce& law, const SoftContact& soft,
                double mass, double speed) {
  const LinearContact c(mass, law.stiffness, law.damping / mass, soft.end);
  const double omega0 = c.contact_frequency(), gamma = c.damping_rate();
  add_restitution_and_time(section, c.restitution(), c.collision_time(), c.largest_overlap(speed),
                           speed);
  section.add("k", in_unit(c.stiffness(), "N/m"), "stiffness");
  section.add("γ_N", in_unit(gamma, "1/s"), "normal damping");
  section.add("ω0", in_unit(omega0, "1/s"), "contact frequency √(k/m̄)");
  section.add("ε", pure(c.damping_ratio()), "damping ratio γ_N/ω0; the critical one is 2");
  section.add("Δt", quantity(symplectic_euler_limit(omega0, gamma), kTime),
              "largest stable step of symplectic Euler");
  section.add("", quantity(velocity_verlet_limit(omega0), kTime), "of velocity Verlet, undamped");
  section.add("", quantity(runge_kutta_limit(omega0), kTime), "of Runge-Kutta 4, undamped");
  section.add("", quantity(explicit_euler_limit(omega0, gamma), kTime), "of explicit Euler");
}

void add_normal(ExplainSection& section, const HertzForce& law, const SoftContact& soft,
                double mass, double speed) {
  add_integrated(section, soft, mass, speed);
  section.add("ρ", in_unit(law.modulus, "N/m^1.5"), "F = ρ ξ^(3/2)");
}

void add_normal(ExplainSection& section, const PowerForce& law, const SoftContact& soft,
                double mass, double speed) {
  add_integrated(section, soft, mass, speed);
  section.add("E", in_unit(law.modulus, fmt::format("N/m^{:g}", law.alpha)),
              fmt::format("F = E ξ^{:g} + η ξ^{:g} ξ̇", law.alpha, law.gamma));
  section.add("η", in_unit(law.viscosity, fmt::format("N s/m^{:g}", 1 + law.gamma)), "viscosity");
}

void add_viscoelastic(ExplainSection& section, double modulus, double dissipation_time,
                      const char* form, const SoftContact& soft, double mass, double speed) {
  add_integrated(section, soft, mass, speed);
  section.add("ρ", in_unit(modulus, "N/m^1.5"), form);
  section.add("A", quantity(dissipation_time, kTime), "dissipation time");
  const double t_c = hertz_duration(mass, modulus, speed);
  section.add("A/t_c", pure(dissipation_time / t_c), "far below 1 where the law holds, B (B12)");
}
void add_normal(ExplainSection& section, const ViscoelasticForce& law, const SoftContact& soft,
                double mass, double speed) {
  add_viscoelastic(section, law.modulus, law.dissipation_time, "F = ρ (ξ^(3/2) + (3/2) A √ξ ξ̇)",
                   soft, mass, speed);
}
void add_normal(ExplainSection& section, const CompactViscoelasticForce& law,
                const SoftContact& soft, double mass, double speed) {
  add_viscoelastic(section, law.modulus, law.dissipation_time, "F = ρ (ξ + A ξ̇)^(3/2)", soft, mass,
                   speed);
}

void add_tangential(ExplainSection&, const NoTangentialForce&, double) {}
void add_tangential(ExplainSection& section, const ViscousForce& law, double mass) {
  section.add("γ_S", in_unit(law.damping / mass, "1/s"), "tangential damping");
  section.add("ν_s", pure(law.friction), "Coulomb's cap on it");
}
void add_tangential(ExplainSection& section, const AsperityForce& law, double) {
  section.add("μ", pure(law.friction), "friction at which asperities break");
  section.add("ζ0", quantity(law.size, kLength), "size of asperities");
}

void add_memory(ExplainSection& section, const ContactMemory& memory) {
  const SpringFriction& sliding = memory.sliding;
  const bool constant = sliding.form == SpringFriction::Form::constant;
  section.add(
      "k_t", constant ? in_unit(sliding.stiffness, "N/m") : in_unit(sliding.stiffness, "N/m^1.5"),
      constant ? "tangential stiffness" : "tangential stiffness over the root of the overlap");
  section.add("c_t", in_unit(sliding.damping, "N s/m"), "tangential dashpot");
  if (sliding.damping_ratio > 0)
    section.add("c_t/c_n", pure(sliding.damping_ratio), "and that part of the normal one");
  section.add("μ_s", pure(sliding.static_friction), "holds");
  section.add("μ_k", pure(sliding.kinetic_friction), "slides");
  if (memory.rolling.length > 0)
    section.add("M_r/F_N", in_unit(memory.rolling.length, "m"), "largest torque against rolling");
}
void add_tangential(ExplainSection& section, const ImpactAngleForce& law, double) {
  section.add("μ", pure(law.friction), "friction");
  section.add("β0", pure(law.tangential_restitution), "tangential restitution where it sticks");
}

/// B (B11), for laws made from the materials.
void add_sound(ExplainSection& section, const Scenario& scenario, const BodyContact& contact,
               double speed) {
  double slowest = HUGE_VAL;
  for (const std::string& name : {contact.first, contact.second}) {
    const auto found = scenario.materials.find(name);
    if (found == scenario.materials.end()) continue;
    const Material& material = found->second;
    if (material.young_modulus && material.poisson_ratio && material.density)
      slowest =
          std::min(slowest, transversal_sound_speed(*material.young_modulus,
                                                    *material.poisson_ratio, *material.density));
  }
  if (std::isfinite(slowest))
    section.add(
        "(g/c_t)²", pure((speed / slowest) * (speed / slowest)),
        fmt::format("impact speed over the transversal one of sound, {}; far below 1, B (B11)",
                    quantity(slowest, kVelocity)));
}

void add_hard(ExplainSection& section, const PairContact& contact, double speed, double slip) {
  section.add("e_n", pure(restitution_at(contact.restitution, speed)),
              "restitution at " + quantity(speed, kVelocity));
  if (!has_friction(contact.friction)) return;
  const bool is_number = std::holds_alternative<double>(contact.friction);
  section.add("μ", pure(friction_at(contact.friction, slip)),
              is_number ? "friction" : "friction at a slip of " + quantity(slip, kVelocity));
  section.add("β0", pure(contact.tangential_restitution), "tangential restitution where it sticks");
}

const char* end_name(ContactEnd end) {
  return end == ContactEnd::zero_overlap ? "ends at zero overlap" : "ends at zero force";
}

}  // namespace

std::optional<LinearContact> linear_contact_between(const ContactScene& scene, std::size_t i,
                                                    std::size_t j) {
  const std::optional<SoftContact> soft = scene.contact_of(i, j);
  if (!soft) return std::nullopt;
  const auto* linear = std::get_if<LinearForce>(&soft->normal);
  if (!linear) return std::nullopt;
  const double mass = effective_mass(scene.hard.bodies[i], scene.hard.bodies[j]);
  return LinearContact(mass, linear->stiffness, linear->damping / mass, soft->end);
}

ExplainSections explain_contacts(const Scenario& scenario, const ContactScene& scene,
                                 const std::optional<Meeting>& meeting, double typical_speed) {
  constexpr std::array kNormal = {"linear", "hertz", "power", "viscoelastic, expanded",
                                  "viscoelastic, compact"};
  static_assert(kNormal.size() == std::variant_size_v<NormalForce>);
  constexpr const char* kTangential[] = {"no rubbing", "viscous rubbing", "asperities",
                                         "sticking or sliding by the impact's angle"};
  ExplainSections sections;
  for (const BodyContact& contact : scenario.contacts) {
    const auto found = partners(scenario, scene, contact, meeting, typical_speed);
    if (!found) continue;
    const double speed = found->speed, mass = found->mass;
    ExplainSection& section = sections.emplace_back();
    section.title =
        fmt::format("Contact {} on {} ({}): ", contact.first, contact.second, found->names);
    const std::optional<SoftContact>& soft = found->soft;
    if (!soft) {
      section.title += "hard";
      add_hard(section, found->hard, speed, found->slip);
      continue;
    }
    section.title +=
        fmt::format("{}, {}, {}", kNormal[soft->normal.index()], end_name(soft->end),
                    soft->memory ? "springs that remember" : kTangential[soft->tangential.index()]);
    std::visit([&](const auto& law) { add_normal(section, law, *soft, mass, speed); },
               soft->normal);
    std::visit([&](const auto& law) { add_tangential(section, law, mass); }, soft->tangential);
    if (soft->memory) add_memory(section, *soft->memory);
    if (std::holds_alternative<HertzForce>(soft->normal) ||
        std::holds_alternative<ViscoelasticForce>(soft->normal) ||
        std::holds_alternative<CompactViscoelasticForce>(soft->normal))
      add_sound(section, scenario, contact, speed);
  }
  return sections;
}

}  // namespace slipcheck
