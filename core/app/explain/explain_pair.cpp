#include "app/explain/explain_pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>

#include "app/explain/explain_contacts.h"
#include "app/explain/explain_rows.h"
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
  const auto& soft = scene.between(meeting.first, meeting.second);
  if (const auto* viscous = std::get_if<ViscousForce>(&soft->tangential)) {
    pair.rubbing_rate = viscous->damping / reduced_mass;
    pair.rubbing_friction = viscous->friction;
  }
  return pair;
}

void print_sliding_onset(const SlidingOnset& onset) {
  fmt::print("      When they begin to slide\n");
  print_row("x_min", quantity(onset.overlap, kLength), "overlap at which they do, undamped");
  print_row("t_min", quantity(onset.time, kTime), "its time, undamped and to first order");
  print_row("", std::isinf(onset.exact_time) ? "never" : quantity(onset.exact_time, kTime),
            "with damping and the inertia of rolling");
  print_row("v^a", quantity(onset.v_a, kVelocity), "they slide from this closing speed on");
  print_row("v^b", quantity(onset.v_b, kVelocity), "K's estimate without damping");
  print_row("v^d", quantity(onset.v_d, kVelocity), "at the first touch already");
}

void print_rubbing(const PairInsight& insight, bool confined) {
  fmt::print("      Rubbing: the share of the sum of both spins that each loses\n");
  print_row("C", pure(insight.rubbing_constant), "to first order, K (55)");
  print_row("", pure(insight.exponential_share), "exponential, ½ (1 − e^(−2C))");
  print_row("", pure(insight.rubbing.share),
            confined ? "with Coulomb's cap" : "with Coulomb's cap and lift-off");
}

void print_jump(const Jump& jump, const std::string& name) {
  print_row("v^c", quantity(jump.v_c, kVelocity), "sum of speeds from which rubbing lifts a body");
  if (jump.speed <= 0) return;
  print_row("v^z", quantity(jump.speed, kVelocity), name + " leaves the substrate with this");
  print_row("h^z", quantity(jump.height, kLength), "height of the jump");
  print_row("t^z", quantity(jump.time, kTime), "its duration");
}

void print_after(const PairInsight& insight, const std::array<std::string, 2>& names) {
  fmt::print("      After the collision   {}  {}\n", padded(names[0], 14, true),
             padded(names[1], 14, true));
  const auto row = [&](const char* symbol, double AfterCollision::*value,
                       const Dimension& dimension, const char* meaning) {
    fmt::print("    {}            {}  {}  {}\n", padded(symbol, 12),
               padded(quantity(insight.after[0].*value, dimension), 14, true),
               padded(quantity(insight.after[1].*value, dimension), 14, true), meaning);
  };
  row("v^f", &AfterCollision::velocity, kVelocity, "velocity");
  row("u^f", &AfterCollision::slip, kVelocity, "slip");
  row("t^s", &AfterCollision::sliding_time, kTime, "sliding time");
  row("s", &AfterCollision::sliding_distance, kLength, "sliding distance");
  row("v^s", &AfterCollision::rolling_velocity, kVelocity, "rolling velocity");
  row("ΔE", &AfterCollision::energy_change, kSpecificEnergy, "v^f² − v^s²");
  row("Δp", &AfterCollision::momentum_change, kVelocity, "v^f − v^s");
}

void print_insight(const PairInsight& insight, const std::array<std::string, 2>& names, bool rubs,
                   bool confined) {
  print_sliding_onset(insight.onset);
  if (!insight.slides) {
    fmt::print("    they roll through the collision: no closed form applies\n");
    return;
  }
  if (rubs) {
    print_rubbing(insight, confined);
    print_jump(insight.jump, names[static_cast<std::size_t>(insight.jump.sphere)]);
  }
  print_after(insight, names);
  print_row("e_eff", pure(insight.effective_restitution),
            insight.effective_restitution < 0 ? "below 0: they meet again while they slide"
                                              : "restitution once both roll");
  print_row("Δt_col", fmt::format("{:+.3g}", insight.collision_time_change),
            "relative, by the substrate's friction (App. D)");
  print_row("Δx_max", fmt::format("{:+.3g}", insight.largest_overlap_change), "the same");
}

}  // namespace

void explain_meeting(const Scenario& scenario, const ContactScene& scene, const Meeting& meeting) {
  const std::array<std::string, 2> names{scenario.bodies[meeting.first].name,
                                         scenario.bodies[meeting.second].name};
  fmt::print("\n  First collision: {} and {} after {}\n", names[0], names[1],
             quantity(meeting.time, kTime));
  print_row("v_rel", quantity(meeting.closing_speed(), kVelocity), "closing speed of the centres");
  const auto contact = linear_contact_between(scene, meeting.first, meeting.second);
  if (!contact) return;
  std::string why = obstacle(scene.hard, meeting);
  if (why.empty() && !std::isfinite(contact->collision_time())) why = "the spheres never part";
  if (!why.empty()) {
    fmt::print("    closed forms of a rolling pair do not apply: {}\n", why);
    return;
  }
  const RollingPair pair = rolling_pair(scene, meeting, contact->reduced_mass());
  print_row("v_i + v_j", quantity(std::abs(pair.surface_speed()), kVelocity),
            "speed of their surfaces against each other");
  const bool rubs =
      pair.rubbing_rate > 0 && std::abs(pair.surface_speed()) > kNegligible * pair.closing_speed();
  print_insight(pair_insight(*contact, pair), names, rubs, pair.confined);
}

}  // namespace slipcheck
