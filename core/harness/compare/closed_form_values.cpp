#include "harness/compare/closed_form_values.h"

#include <cmath>

#include "physics/closed_forms.h"

namespace slipcheck {
namespace {

constexpr double kNegligible = 1e-12;

bool starts_on_plane(const Sphere& sphere, const BodyState& state) {
  return state.position.z() <= sphere.radius * (1 + kNegligible) && state.velocity.z() == 0;
}

bool starts_rolling(const Sphere& sphere, const BodyState& state) {
  return slip_velocity(state, sphere).norm() <= kNegligible * state.velocity.norm();
}

/// The body slides from `state` on, away from whatever struck it.
void add_sliding(const Scene& scene, std::size_t i, const BodyState& state, BodyObservables& out) {
  const double friction = scene.on_substrate(i).kinetic_friction;
  if (friction == 0 || scene.gravity == 0) return;
  const SlideToRoll slide(scene.bodies[i], friction, scene.gravity, state.velocity,
                          state.angular_velocity);
  out.sliding_time = slide.sliding_time;
  out.sliding_distance = slide.sliding_distance;
  out.rolling_velocity = slide.rolling_velocity;
  out.energy_change_sliding = slide.energy_change;
}

Observables one_body(const Scene& scene) {
  Observables result;
  const Sphere& sphere = scene.bodies[0];
  const BodyState& start = scene.initial[0];
  const SubstrateContact& contact = scene.on_substrate(0);
  if (!starts_on_plane(sphere, start)) return result;
  BodyObservables& out = result.bodies.emplace_back();
  const double g = scene.gravity;
  const double speed = start.velocity.norm();
  if (!starts_rolling(sphere, start)) {
    add_sliding(scene, 0, start, out);
    if (sphere.shape == Shape::block) {
      out.stopping_time = out.sliding_time;
      out.stopping_distance = out.sliding_distance;
    }
  } else if (contact.rolling.is_constant() && !contact.rolling.is_zero() && speed > 0 && g > 0) {
    const double deceleration = contact.rolling(0) * g;
    out.stopping_time = speed / deceleration;
    out.stopping_distance = speed * speed / (2 * deceleration);
  }
  const double spin = std::abs(start.angular_velocity.z());
  const double torque = contact.drilling_length * sphere.mass * g;
  if (spin > 0 && torque > 0) out.spin_stopping_time = spin * sphere.moment_of_inertia() / torque;
  return result;
}

Observables two_bodies(const Scene& scene) {
  Observables result;
  const Sphere &a = scene.bodies[0], &b = scene.bodies[1];
  const BodyState &i = scene.initial[0], &j = scene.initial[1];
  const PairContact& contact = scene.between(0, 1);
  for (std::size_t k : {0u, 1u}) {
    if (!starts_on_plane(scene.bodies[k], scene.initial[k])) return result;
    if (!starts_rolling(scene.bodies[k], scene.initial[k])) return result;
    if (!scene.on_substrate(k).rolling.is_zero()) return result;
  }
  if (has_friction(contact.friction) || a.radius != b.radius) return result;

  // Seen from j, i comes along dv and passes at the distance `aside` from it; n when they touch.
  const Vector3 dx = i.position - j.position, dv = i.velocity - j.velocity;
  if (dx.dot(dv) >= 0) return result;
  const Vector3 direction = dv.normalized();
  const Vector3 aside = dx - dx.dot(direction) * direction;
  const double contact_distance = 2 * a.radius;
  const double square = (contact_distance - aside.norm()) * (contact_distance + aside.norm());
  if (square <= 0) return result;
  const Vector3 n = (aside - std::sqrt(square) * direction) / contact_distance;

  const double impact = -n.dot(dv);
  const double e = restitution_at(contact.restitution, impact);
  const double impulse = (1 + e) * impact / (1 / a.mass + 1 / b.mass);
  result.bodies.resize(2);
  for (std::size_t k : {0u, 1u}) {
    const Vector3 away = k == 0 ? n : Vector3(-n);
    BodyState after = scene.initial[k];
    after.velocity += (impulse / scene.bodies[k].mass) * away;
    BodyObservables& out = result.bodies[k];
    out.velocity_after_collision = after.velocity;
    out.angular_velocity_after_collision = after.angular_velocity;
    out.slip_after_collision = slip_velocity(after, a.radius);
    add_sliding(scene, k, after, out);
    out.momentum_change_sliding = (after.velocity - out.rolling_velocity).dot(away);
  }
  const Vector3 parting = result.bodies[0].rolling_velocity - result.bodies[1].rolling_velocity;
  result.pairs.push_back({0, 1, e, kNotObserved, n.dot(parting) / impact});
  return result;
}

}  // namespace

Observables closed_form_observables(const Scene& scene) {
  if (scene.bodies.size() == 1) return one_body(scene);
  if (scene.bodies.size() == 2) return two_bodies(scene);
  return {};
}

std::map<std::string, double> closed_form_values(const Scene& scene,
                                                 const std::vector<std::string>& body_names) {
  return named_values(closed_form_observables(scene), body_names);
}

}  // namespace slipcheck
