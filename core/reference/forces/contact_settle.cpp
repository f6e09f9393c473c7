#include <algorithm>
#include <array>
#include <cmath>

#include "reference/forces/contact_state.h"

// The modes of a body on the substrate: what holds it, what gives way.

namespace slipcheck {
namespace {

using Kind = BodyMode::Kind;
/// A friction that holds gives way where the load exceeds its limit by more than rounding.
constexpr double kMargin = 1 + 1e-10;

}  // namespace

/// Finds the mode of a body that touches the plane, from its velocities alone.
void ContactState::place(std::size_t i) {
  const Scene& scene = scene_->hard;
  BodyMode& mode = dynamics_.modes[i];
  const BodyState state = body(i);
  if (!scene.confined && state.velocity.z() > 0) {
    mode.kind = Kind::flying;
    return;
  }
  y[i * kBody + 2] = y[i * kBody + 5] = 0;
  const SubstrateContact& contact = scene.on_substrate(i);
  const double spin = state.angular_velocity.z();
  const bool drills = contact.drilling_length > 0 || contact.coupled_radius > 0;
  mode.spin_held = drills && spin == 0;
  mode.spin_sign = spin < 0 ? -1 : 1;
  const Vector3 slip = dynamics_.slip(i, y.data());
  const bool drilled = dynamics_.is_coupled(i) && spin != 0;
  if (slip.norm() > scales_.slip_floor || drilled) {
    mode.kind = Kind::sliding;
    mode.slip_direction = direction_of(slip);
    mode.slip_begins = false;
    mode.roll_direction = direction_of(horizontal(state.angular_velocity));
    mode.roll_held = contact.rolling_while_sliding && horizontal(state.angular_velocity).isZero(0);
  } else {
    set_rolling(i);
  }
}

/// The slip is taken to zero, as friction would in the next instant.
void ContactState::set_rolling(std::size_t i) {
  const Scene& scene = scene_->hard;
  const Sphere& sphere = scene.bodies[i];
  BodyMode& mode = dynamics_.modes[i];
  const Vector3 change = dynamics_.slip(i, y.data()) / (1 + sphere.inverse_shape_factor());
  y[i * kBody + 3] -= change.x();
  y[i * kBody + 4] -= change.y();
  mode.kind = Kind::rolling;
  const Vector3 relative = dynamics_.relative_velocity(i, time, y.data());
  mode.roll_held = scene.on_substrate(i).rolling(0) > 0 && relative.norm() <= scales_.slip_floor;
  mode.roll_direction = direction_of(relative);
  project(i);
}

void ContactState::end_slip(std::size_t i) {
  // The integrator passes zero at a distance of its error.
  const Vector3 slip = dynamics_.slip(i, y.data());
  const bool coupled = dynamics_.is_coupled(i) && !dynamics_.modes[i].spin_held;
  if (!coupled && slip.norm() > 10 * scales_.slip_floor) {
    dynamics_.modes[i].slip_direction = slip.normalized();
    return;
  }
  const std::array bodies{i};
  const double energy = dynamics_.kinetic_energy(time, y.data());
  const Vector3 before = momentum(bodies);
  if (dynamics_.is_coupled(i)) {
    y[i * kBody + 8] = 0;
    dynamics_.modes[i].spin_held = true;
  }
  set_rolling(i);
  account_impulse(energy, before, bodies);
  give_way(i);
}

void ContactState::begin_slip(std::size_t i) {
  BodyMode& mode = dynamics_.modes[i];
  evaluate();
  // The surface moves off against the force that would have held it.
  const Vector3 friction = evaluation_.bodies[i].slip_load;
  mode.kind = Kind::sliding;
  mode.slip_direction = direction_of(-friction);
  mode.slip_begins = true;
  // What is touched may be spun as well.
  if (dynamics_.is_coupled(i) && in_contact(i)) mode.spin_held = false;
  const Vector3 spin = horizontal(body(i).angular_velocity);
  mode.roll_held = scene_->hard.on_substrate(i).rolling_while_sliding && spin.isZero(0);
  mode.roll_direction = direction_of(spin);
}

void ContactState::end_roll(std::size_t i) {
  BodyMode& mode = dynamics_.modes[i];
  BodyState state = body(i);
  const bool sliding = mode.kind == Kind::sliding;
  const Vector3 rate =
      sliding ? horizontal(state.angular_velocity) : dynamics_.relative_velocity(i, time, y.data());
  const double length = sliding ? scene_->hard.bodies[i].radius : 1;
  if (length * rate.norm() > 10 * scales_.slip_floor) {
    mode.roll_direction = rate.normalized();  // it turned right round
    return;
  }
  if (!sliding) state.velocity = dynamics_.substrate_velocity(time) + state.velocity.z() * kUp;
  state.angular_velocity.head<2>().setZero();
  set_body(i, state);
  mode.roll_held = scene_->hard.on_substrate(i).rolling(0) > 0;
  evaluate();
  const auto& f = evaluation_.bodies[i];
  if (mode.roll_held && f.roll_load.norm() > f.roll_limit) begin_roll(i);
}

void ContactState::begin_roll(std::size_t i) {
  BodyMode& mode = dynamics_.modes[i];
  evaluate();
  const Vector3& load = evaluation_.bodies[i].roll_load;
  mode.roll_held = false;
  mode.roll_begins = true;
  mode.roll_direction = direction_of(load);
}

void ContactState::end_spin(std::size_t i) {
  y[i * kBody + 8] = 0;
  dynamics_.modes[i].spin_held = true;
}

void ContactState::begin_spin(std::size_t i) {
  BodyMode& mode = dynamics_.modes[i];
  evaluate();
  mode.spin_held = false;
  mode.spin_sign = evaluation_.bodies[i].torque.z() < 0 ? -1 : 1;
  if (dynamics_.is_coupled(i) && mode.kind == Kind::rolling) begin_slip(i);
}

void ContactState::feel_substrate_jump() {
  const Vector3 before = dynamics_.substrate_velocity(time);
  dynamics_.next_kink = scene_->hard.motion.next_kink(time);
  const Vector3 jump = dynamics_.substrate_velocity(time) - before;
  for (std::size_t i = 0; i < dynamics_.modes.size(); ++i) {
    y[i * kBody + 6] -= jump.x();
    y[i * kBody + 7] -= jump.y();
  }
  for (std::size_t i = 0; i < dynamics_.modes.size(); ++i)
    if (dynamics_.modes[i].on_plane()) place(i);
}

/// Whether something that held this body gave way.
bool ContactState::give_way(std::size_t i) {
  BodyMode& mode = dynamics_.modes[i];
  if (!mode.on_plane()) return false;
  evaluate();
  const auto& f = evaluation_.bodies[i];
  const Sphere& sphere = scene_->hard.bodies[i];
  const SubstrateContact& contact = scene_->hard.on_substrate(i);
  const double weight = sphere.mass * scene_->hard.gravity;
  const double round_off = 1e-12 * (weight + f.applied.norm());
  if (scene_->hard.confined) {
    // Where it passes through zero the root's direction has set the sign.
    if (std::abs(f.normal) > round_off) mode.normal_sign = f.normal < 0 ? -1 : 1;
  } else if (f.normal < -round_off) {
    lift_off(i);
    return true;
  }
  const double normal = std::max(0.0, mode.normal_sign * f.normal);
  // Without friction nothing holds, and a load that grows from zero passes no root.
  const bool smooth = contact.static_friction == 0 &&
                      (in_contact(i) || !scene_->hard.motion.is_uniform_between_kinks());
  if (mode.kind == Kind::rolling &&
      (smooth || f.slip_load.norm() > kMargin * contact.static_friction * normal + round_off)) {
    begin_slip(i);
    return true;
  }
  if (mode.roll_held &&
      f.roll_load.norm() >
          kMargin * f.roll_limit + round_off * (mode.kind == Kind::sliding ? sphere.radius : 1)) {
    begin_roll(i);
    return true;
  }
  const double drilling = dynamics_.is_coupled(i) && mode.kind == Kind::sliding
                              ? 0  // all friction goes against the slip
                              : contact.drilling_length * normal;
  if (mode.spin_held && std::abs(f.torque.z()) > kMargin * drilling + round_off * sphere.radius) {
    begin_spin(i);
    return true;
  }
  return false;
}

void ContactState::settle() {
  project();
  const std::size_t most = 6 * dynamics_.modes.size() + 6;
  bool changed = true;
  for (std::size_t round = 0; changed && round < most; ++round) {
    changed = false;
    for (std::size_t i = 0; i < dynamics_.modes.size(); ++i) changed |= give_way(i);
  }
  evaluate();
}

void ContactState::follow_directions() {
  // What is within its own noise of zero has no direction to follow.
  const auto follow = [&](const Vector3& w, double length, Vector3& direction) {
    const bool moves = length * w.norm() > 10 * scales_.slip_floor;
    if (moves) direction = continued_direction(w, direction);
    return moves;
  };
  for (std::size_t i = 0; i < dynamics_.modes.size(); ++i) {
    BodyMode& mode = dynamics_.modes[i];
    if (mode.kind == Kind::sliding) {
      follow(dynamics_.slip(i, y.data()), 1, mode.slip_direction);
      if (follow(horizontal(body(i).angular_velocity), scene_->hard.bodies[i].radius,
                 mode.roll_direction))
        mode.roll_begins = false;
    } else if (mode.kind == Kind::rolling) {
      if (follow(dynamics_.relative_velocity(i, time, y.data()), 1, mode.roll_direction))
        mode.roll_begins = false;
    }
  }
}

void ContactState::project() {
  for (std::size_t i = 0; i < dynamics_.modes.size(); ++i) project(i);
}

void ContactState::project(std::size_t i) {
  const BodyMode& mode = dynamics_.modes[i];
  if (!mode.on_plane()) return;
  double* at = y.data() + i * kBody;
  at[2] = at[5] = 0;
  if (mode.kind == Kind::rolling) {
    at[6] = at[7] = 0;
    if (mode.roll_held) {
      const Vector3 frame = dynamics_.substrate_velocity(time);
      at[3] = frame.x();
      at[4] = frame.y();
    }
  }
  if (mode.spin_held) at[8] = 0;
}

bool ContactState::in_contact(std::size_t i) const {
  return std::any_of(dynamics_.contacts.begin(), dynamics_.contacts.end(),
                     [&](const ContactMode& c) { return c.first == i || c.second == i; });
}

bool ContactState::slides(std::size_t i) const {
  if (dynamics_.modes[i].kind != Kind::sliding) return false;
  return !dynamics_.is_coupled(i) || dynamics_.slip(i, y.data()).norm() > 1e-6 * scales_.speed;
}

bool ContactState::rests(std::size_t i) const {
  const BodyMode& mode = dynamics_.modes[i];
  if (mode.kind != Kind::rolling) return false;
  const Vector3 relative = dynamics_.relative_velocity(i, time, y.data());
  const double spin = body(i).angular_velocity.z();
  // Bodies that lean on each other come to rest little by little.
  if (in_contact(i)) return relative.norm() <= leaning_speed() && spin == 0;
  return relative.isZero(0) && spin == 0 &&
         (mode.roll_held || evaluation_.bodies[i].acceleration.isZero(0));
}

bool ContactState::only_leans() const {
  for (std::size_t c = 0; c < dynamics_.contacts.size(); ++c) {
    const auto& forces = evaluation_.contacts[c];
    const double change = forces.closing_rate * dynamics_.contacts[c].time_scale;
    if (std::max(std::abs(forces.closing), std::abs(change)) > leaning_speed()) return false;
  }
  return true;
}

}  // namespace slipcheck
