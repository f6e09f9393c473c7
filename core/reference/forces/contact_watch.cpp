#include "reference/forces/contact_watch.h"

#include <algorithm>
#include <cmath>

namespace slipcheck {
namespace {

using Kind = BodyMode::Kind;

/// Falls through zero where dry friction ends a velocity w. A straight one passes through zero
/// along its direction; one that turns comes as close as its integration allows. What has just
/// begun is a little above zero, so that its end is seen even if it never gets under way.
double dry_left(const Vector3& w, const Vector3& direction, double floor, bool turns) {
  const double little = 0.01 * floor;
  const double along = w.dot(direction);
  const double across = (w - along * direction).norm();
  return turns && across > little ? std::min(along, w.norm() - floor) : along + little;
}

constexpr int kFalls = -1, kEither = 0, kRises = 1;

}  // namespace

ContactWatch::ContactWatch(const ContactState& state) {
  for (std::size_t i = 0; i < state.dynamics().modes.size(); ++i) watch_body(state, i);
  for (std::size_t c = 0; c < state.dynamics().contacts.size(); ++c) watch_contact(state, c);
}

void ContactWatch::watch_body(const ContactState& state, std::size_t i) {
  const Scene& scene = state.scene().hard;
  const SubstrateContact& contact = scene.on_substrate(i);
  const BodyMode& mode = state.dynamics().modes[i];
  const bool coupled = state.dynamics().is_coupled(i);
  const bool touched = state.in_contact(i);
  if (!mode.on_plane()) {
    if (touched) add(What::landing, i, kFalls);  // a free flight ends where its parabola does
    return;
  }
  if (touched) add(What::lift_off, i, scene.confined ? kEither : kFalls);
  if (mode.kind == Kind::sliding) {
    if (contact.kinetic_friction > 0) add(What::slip_end, i, kFalls);
    if (mode.slip_begins) add(What::slip_develops, i, kRises, 1e3 * state.dynamics().onset_speed);
    // Safely below what counts as a slide, here and for the observer.
    const double faint = 0.999e-6 * state.scales().speed;
    if (coupled && state.dynamics().slip(i, state.y.data()).norm() > (1 + 1e-9) * faint)
      add(What::slip_dies_out, i, kFalls, faint);
    if (contact.rolling_while_sliding && !contact.rolling.is_zero())
      add(mode.roll_held ? What::roll_begin : What::roll_end, i, kFalls);
  } else {
    // Without a pull or a push from anywhere what sticks goes on to stick.
    const bool driven = touched || !scene.motion.is_uniform_between_kinks();
    if (driven || !contact.rolling.is_constant()) add(What::slip_begin, i, kFalls);
    if (!contact.rolling.is_zero() && (driven || !mode.roll_held))
      add(mode.roll_held ? What::roll_begin : What::roll_end, i, kFalls);
    if (!mode.roll_held && !contact.rolling.is_constant())
      for (const RollingFriction::Point& point : contact.rolling.points())
        if (point.speed > 0) add(What::roll_kink, i, kEither, point.speed);
  }
  if (contact.drilling_length == 0) return;
  if (mode.spin_held && touched && (!coupled || mode.kind == Kind::rolling))
    add(What::spin_begin, i, kFalls);
  if (!mode.spin_held && !coupled) add(What::spin_end, i, kFalls);
}

void ContactWatch::watch_contact(const ContactState& state, std::size_t index) {
  const ContactMode& contact = state.dynamics().contacts[index];
  add(What::contact_end, index, kFalls);
  if (contact.clamped) {
    add(What::force_begin, index, kRises);
    return;
  }
  if (state.evaluation().contacts[index].closing > 1e-9 * state.scales().speed)
    add(What::greatest_overlap, index, kFalls);
  if (contact.law->end == ContactEnd::zero_force) add(What::force_end, index, kFalls);
  for_each_edge(contact.law->tangential, contact.branch, contact.law->end,
                [&](TangentialEdge edge, int direction) {
                  add(What::edge, index, direction);
                  items_.back().edge = edge;
                });
}

void ContactWatch::values(const ContactState& state, double t, const double* y,
                          ContactDynamics::Evaluation& scratch, double* value) const {
  const ContactDynamics& dynamics = state.dynamics();
  const Scene& scene = state.scene().hard;
  dynamics.evaluate(t, y, scratch);
  const auto slip_left = [&](std::size_t i) {
    const BodyMode& mode = dynamics.modes[i];
    const Vector3 slip = dynamics.slip(i, y);
    const double spin = y[i * kBody + 8];
    if (dynamics.is_coupled(i) && !mode.spin_held)
      return std::hypot(slip.norm(), scene.on_substrate(i).coupled_radius * spin) -
             3 * dynamics.creep_speed;
    return dry_left(slip, mode.slip_direction, state.scales().slip_floor, !mode.slip_begins);
  };
  const auto roll_left = [&](std::size_t i) {
    const BodyMode& mode = dynamics.modes[i];
    if (mode.kind == Kind::rolling)
      return dry_left(dynamics.relative_velocity(i, t, y), mode.roll_direction,
                      state.scales().slip_floor, !mode.roll_begins);
    return dry_left(horizontal(dynamics.angular_velocity(i, t, y)), mode.roll_direction,
                    state.scales().slip_floor / scene.bodies[i].radius, !mode.roll_begins);
  };
  for (std::size_t k = 0; k < items_.size(); ++k) {
    const Item& item = items_[k];
    const std::size_t i = item.index;
    const auto of_body = [&]() -> const ContactDynamics::BodyForces& { return scratch.bodies[i]; };
    const auto of_contact = [&]() -> const ContactDynamics::ContactForces& {
      return scratch.contacts[i];
    };
    const auto slot = [&] { return y + dynamics.slot_at(dynamics.contacts[i].slot); };
    switch (item.what) {
      case What::landing:
        value[k] = y[i * kBody + 2];
        break;
      case What::lift_off:
        value[k] = of_body().normal;
        break;
      case What::slip_end:
        value[k] = slip_left(i);
        break;
      case What::slip_dies_out:
      case What::slip_develops:
        value[k] = dynamics.slip(i, y).norm() - item.value;
        break;
      case What::slip_begin:
        value[k] = scene.on_substrate(i).static_friction * dynamics.modes[i].normal_sign *
                       of_body().normal -
                   of_body().slip_load.norm();
        break;
      case What::roll_end:
        value[k] = roll_left(i);
        break;
      case What::roll_begin:
        value[k] = of_body().roll_limit - of_body().roll_load.norm();
        break;
      case What::roll_kink:
        value[k] = dynamics.relative_velocity(i, t, y).norm() - item.value;
        break;
      case What::spin_end:
        value[k] = y[i * kBody + 8] * dynamics.modes[i].spin_sign +
                   0.01 * state.scales().slip_floor / scene.bodies[i].radius;
        break;
      case What::spin_begin:
        value[k] = scene.on_substrate(i).drilling_length * dynamics.modes[i].normal_sign *
                       of_body().normal -
                   std::abs(of_body().torque.z());
        break;
      case What::contact_end:
        value[k] = slot()[0];
        break;
      case What::force_end:
      case What::force_begin:
        value[k] = of_contact().normal;
        break;
      case What::greatest_overlap:
        value[k] = of_contact().closing;
        break;
      case What::edge: {
        const ContactMode& contact = dynamics.contacts[i];
        const auto& forces = of_contact();
        const double growth =
            item.edge == TangentialEdge::growth ? dynamics.growth(contact, forces, y) : 0;
        const double bend = Vector3(slot()[1], slot()[2], slot()[3]).norm();
        value[k] =
            edge_value(item.edge, contact.law->tangential, contact.branch, forces.normal, growth,
                       slip_at(item.edge, contact.law->tangential, forces.slip, forces.n), bend);
        break;
      }
    }
  }
}

}  // namespace slipcheck
