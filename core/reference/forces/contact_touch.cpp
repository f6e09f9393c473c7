#include "reference/forces/contact_touch.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "physics/numbers.h"

namespace slipcheck {
namespace {

Vector3 vector_at(const double* y) { return {y[0], y[1], y[2]}; }

/// Bound of a body's acceleration during the step [m/s²], `after` being its end. What rests has
/// none, so that a gap of round-off beside it is not looked at again and again.
double largest_acceleration(const ContactState& state, const ContactDynamics::Evaluation& after,
                            std::size_t i) {
  const Scene& scene = state.scene().hard;
  const SubstrateContact& contact = scene.on_substrate(i);
  const BodyMode& mode = state.dynamics().modes[i];
  const double shaken = scene.motion.largest_acceleration();
  // In a contact forces can grow within a step, though not by much.
  if (state.in_contact(i)) {
    // What may come and go in between, of what acts without a contact.
    constexpr double kUnseen = 1e-6;
    const double free = std::hypot(scene.gravity, scene.downhill.norm()) +
                        contact.static_friction * scene.gravity + shaken;
    return kUnseen * free + 10 * std::max(state.evaluation().bodies[i].acceleration.norm(),
                                          after.bodies[i].acceleration.norm());
  }
  // Outside of contacts nothing but the mode that the body is in acts on it.
  switch (mode.kind) {
    case BodyMode::Kind::flying:
      return std::hypot(scene.gravity, scene.downhill.norm());
    case BodyMode::Kind::sliding:
      return scene.downhill.norm() + contact.kinetic_friction * scene.gravity;
    case BodyMode::Kind::rolling:
      break;
  }
  if (mode.roll_held) return shaken;
  const double rolling = contact.rolling.is_zero() ? 0 : contact.static_friction * scene.gravity;
  return scene.downhill.norm() + rolling + shaken;
}

struct Approach {
  double gap, closing;
};

Approach approach(const ContactDynamics& dynamics, const double* y, std::size_t i, std::size_t j,
                  double contact) {
  const Vector3 dx = dynamics.between_centres(i, j, y);
  const Vector3 dv = vector_at(y + i * kBody + 3) - vector_at(y + j * kBody + 3);
  const double distance = dx.norm();
  return {distance - contact, -dx.dot(dv) / distance};
}

/// Since gap(t + τ) >= gap − c τ − ½ B τ² with the closing speed c and a bound B of the relative
/// acceleration, steps to the root of that bound never pass a contact.
double touch_time(const ContactState& state, const Ode& ode, std::size_t i, std::size_t j,
                  double bound, std::vector<double>& y) {
  const Scene& scene = state.scene().hard;
  const double contact = scene.bodies[i].radius + scene.bodies[j].radius;
  const double touching = 8 * kEpsilon * contact;
  const ContactState::Rest rest = state.rest_of(i, j);
  const double begin = state.time, end = ode.time();
  double t = begin;
  const double* now = state.y.data();
  while (true) {
    const auto [gap, closing] = approach(state.dynamics(), now, i, j, contact);
    if (gap <= touching && closing > rest.speed) return t;
    // At rest against each other: only a push makes it a contact.
    if (gap <= rest.gap && std::abs(closing) <= rest.speed) {
      const auto& bodies = state.evaluation().bodies;
      const Vector3 n = state.dynamics().between_centres(i, j, now).normalized();
      const double pushed = -n.dot(bodies[i].acceleration - bodies[j].acceleration);
      // Round-off of what acts on them is none.
      const double acts = std::hypot(scene.gravity, scene.downhill.norm());
      const bool begins = t == begin && pushed > rest.push * (bound + 2 * acts);
      return begins ? t : kNever;
    }
    const double open = std::max(gap, touching);
    const double root = std::sqrt(closing * closing + 2 * bound * open);
    double step = kNever;
    if (closing > 0)
      step = 2 * open / (closing + root);
    else if (bound > 0)
      step = (root - closing) / bound;
    const double next = t + step;
    if (!(next < end)) return kNever;  // a contact at the end itself begins the next step
    if (next == t && closing > 0) return t;
    if (next == t) return kNever;
    t = next;
    ode.dense(t, y);
    now = y.data();
  }
}

}  // namespace

std::optional<NextTouch> first_touch(const ContactState& state, const Ode& ode) {
  const std::size_t count = state.dynamics().modes.size();
  if (count < 2) return std::nullopt;
  std::optional<NextTouch> first;
  std::vector<double> scratch(state.y.size());
  ContactDynamics::Evaluation after;
  if (!state.dynamics().contacts.empty())
    state.dynamics().evaluate(ode.time(), ode.y().data(), after);
  std::vector<double> largest(count);
  for (std::size_t i = 0; i < count; ++i) largest[i] = largest_acceleration(state, after, i);
  const auto are_touching = [&](std::size_t i, std::size_t j) {
    return std::any_of(state.dynamics().contacts.begin(), state.dynamics().contacts.end(),
                       [&](const ContactMode& c) { return c.first == i && c.second == j; });
  };
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      if (are_touching(i, j)) continue;
      const double t = touch_time(state, ode, i, j, largest[i] + largest[j], scratch);
      if (t <= ode.time() && (!first || t < first->time)) first = NextTouch{t, i, j};
    }
  return first;
}

}  // namespace slipcheck
