#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>

#include "explain/explain_parts.h"
#include "physics/contact/pair_insight.h"
#include "reference/reference_solver.h"

namespace slipcheck {
namespace {

constexpr double kNegligible = 1e-9;

/// Why the closed forms of a rolling pair do not apply; empty if they do.
std::string obstacle(const Scene& scene, const Meeting& meeting) {
  if (!has_exact_phases(scene))
    return "the substrate is not level and still, or its friction is coupled";
  if (!(scene.gravity > 0)) return "there is no gravity";
  const Sphere &a = scene.bodies[meeting.first], &b = scene.bodies[meeting.second];
  if (std::abs(a.radius - b.radius) > kNegligible * a.radius) return "the radii differ";
  for (const auto& [sphere, state, body] :
       {std::tuple(a, meeting.a, meeting.first), std::tuple(b, meeting.b, meeting.second)}) {
    const double speed = std::max(state.velocity.norm(), meeting.closing_speed());
    if (std::abs(state.position.z() - sphere.radius) > kNegligible * sphere.radius ||
        std::abs(state.velocity.z()) > kNegligible * speed)
      return "a body is in the air";
    if (slip_velocity(state, sphere.radius).norm() > kNegligible * speed) return "a body slides";
    if (std::abs(state.angular_velocity.z()) * sphere.radius > kNegligible * speed)
      return "a body spins about the vertical";
    if (state.velocity.cross(meeting.n).norm() > kNegligible * speed)
      return "the collision is oblique";
    if (!(scene.on_substrate(body).kinetic_friction > 0)) return "the substrate is smooth";
  }
  return {};
}

/// Sphere 0 is the one behind, along `meeting.n`.
RollingPair rolling_pair(const ContactScene& scene, const Meeting& meeting, double reduced_mass) {
  RollingPair pair;
  const auto rolling = [&](std::size_t body, const BodyState& state) {
    const SubstrateContact& on = scene.hard.on_substrate(body);
    return RollingSphere{scene.hard.bodies[body], state.velocity.dot(meeting.n), on.static_friction,
                         on.kinetic_friction};
  };
  pair.spheres = {rolling(meeting.first, meeting.a), rolling(meeting.second, meeting.b)};
  pair.gravity = scene.hard.gravity;
  pair.confined = scene.hard.confined;
  const std::optional<SoftContact> soft = scene.contact_of(meeting.first, meeting.second);
  if (const auto* viscous = std::get_if<ViscousForce>(&soft->tangential)) {
    pair.rubbing_rate = viscous->damping / reduced_mass;
    pair.rubbing_friction = viscous->friction;
  }
  return pair;
}

ExplainSection sliding_onset(const SlidingOnset& onset) {
  ExplainSection section{.title = "When they begin to slide", .is_part = true};
  section.add("x_min", quantity(onset.overlap, kLength), "overlap at which they do, undamped");
  section.add("t_min", quantity(onset.time, kTime), "its time, undamped and to first order");
  section.add("", std::isinf(onset.exact_time) ? "never" : quantity(onset.exact_time, kTime),
              "with damping and the inertia of rolling");
  section.add("v_slide", quantity(onset.sliding_speed, kVelocity),
              "they slide from this closing speed on");
  section.add("v^b", quantity(onset.v_b, kVelocity), "K's estimate without damping");
  section.add("v^c", quantity(onset.v_c, kVelocity), "at the first touch already");
  return section;
}

ExplainSection rubbing(const PairInsight& insight, bool confined) {
  ExplainSection section{.title = "Rubbing: the share of the sum of both spins that each loses",
                         .is_part = true};
  section.add("C", pure(insight.rubbing_constant), "to first order, K (55)");
  section.add("", pure(insight.exponential_share), "exponential, ½ (1 − e^(−2C))");
  section.add("", pure(insight.rubbing.share),
              confined ? "with Coulomb's cap" : "with Coulomb's cap and lift-off");
  return section;
}

void add_jump(ExplainSection& section, const Jump& jump, const std::string& name) {
  section.add("v^d", quantity(jump.v_d, kVelocity),
              "sum of speeds from which rubbing lifts a body");
  if (jump.speed <= 0) return;
  section.add("v^z", quantity(jump.speed, kVelocity), name + " leaves the substrate with this");
  section.add("h^z", quantity(jump.height, kLength), "height of the jump");
  section.add("t^z", quantity(jump.time, kTime), "its duration");
}

ExplainSection after(const PairInsight& insight, const std::array<std::string, 2>& names) {
  ExplainSection section{.title = "After the collision",
                         .label_width = 22,
                         .is_part = true,
                         .columns = {{names[0]}, {names[1]}}};
  const auto row = [&](const char* symbol, double AfterCollision::*value,
                       const Dimension& dimension, const char* meaning) {
    section.rows.push_back({symbol,
                            {quantity(insight.after[0].*value, dimension),
                             quantity(insight.after[1].*value, dimension)},
                            meaning});
  };
  row("v^f", &AfterCollision::velocity, kVelocity, "velocity");
  row("u^f", &AfterCollision::slip, kVelocity, "slip");
  row("t^s", &AfterCollision::sliding_time, kTime, "sliding time");
  row("s", &AfterCollision::sliding_distance, kLength, "sliding distance");
  row("v^s", &AfterCollision::rolling_velocity, kVelocity, "rolling velocity");
  row("ΔE", &AfterCollision::energy_change, kSpecificEnergy, "v^f² − v^s²");
  row("Δp", &AfterCollision::momentum_change, kVelocity, "v^f − v^s");
  return section;
}

ExplainSection of_both(const PairInsight& insight) {
  ExplainSection section{.is_part = true};
  section.add("e_eff", pure(insight.effective_restitution),
              insight.effective_restitution < 0 ? "below 0: they meet again while they slide"
                                                : "restitution once both roll");
  section.add("Δt_col", fmt::format("{:+.3g}", insight.collision_time_change),
              "relative, by the substrate's friction (App. D)");
  section.add("Δx_max", fmt::format("{:+.3g}", insight.largest_overlap_change), "the same");
  section.add("v^a", quantity(insight.v_a, kVelocity),
              "closing speed far above which both are small");
  return section;
}

void add_insight(ExplainSections& sections, const PairInsight& insight,
                 const std::array<std::string, 2>& names, bool rubs, bool confined) {
  sections.push_back(sliding_onset(insight.onset));
  if (!insight.slides) {
    sections.back().add("they roll through the collision: no closed form applies");
    return;
  }
  if (rubs) {
    sections.push_back(rubbing(insight, confined));
    add_jump(sections.back(), insight.jump, names[static_cast<std::size_t>(insight.jump.sphere)]);
  }
  sections.push_back(after(insight, names));
  sections.push_back(of_both(insight));
}

}  // namespace

ExplainSections explain_meeting(const Scenario& scenario, const ContactScene& scene,
                                const Meeting& meeting) {
  const std::array<std::string, 2> names{scenario.bodies[meeting.first].name,
                                         scenario.bodies[meeting.second].name};
  ExplainSections sections{{.title = fmt::format("First collision: {} and {} after {}", names[0],
                                                 names[1], quantity(meeting.time, kTime))}};
  ExplainSection& section = sections.front();
  section.add("v_rel", quantity(meeting.closing_speed(), kVelocity),
              "closing speed of the centres");
  const auto contact = linear_contact_between(scene, meeting.first, meeting.second);
  if (!contact) return sections;
  std::string why = obstacle(scene.hard, meeting);
  if (why.empty() && !std::isfinite(contact->collision_time())) why = "the spheres never part";
  if (!why.empty()) {
    section.add("closed forms of a rolling pair do not apply: " + why);
    return sections;
  }
  const RollingPair pair = rolling_pair(scene, meeting, contact->reduced_mass());
  section.add("v_i + v_j", quantity(std::abs(pair.surface_speed()), kVelocity),
              "speed of their surfaces against each other");
  const bool rubs =
      pair.rubbing_rate > 0 && std::abs(pair.surface_speed()) > kNegligible * pair.closing_speed();
  add_insight(sections, pair_insight(*contact, pair), names, rubs, pair.confined);
  return sections;
}

}  // namespace slipcheck
