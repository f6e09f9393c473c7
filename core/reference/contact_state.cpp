#include "reference/contact_state.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/substrate_phase.h"

namespace slipcheck {
namespace {

using Kind = BodyMode::Kind;
constexpr std::size_t kBody = ContactDynamics::kBody;
/// A friction that holds gives way where the load exceeds its limit by more than rounding.
constexpr double kMargin = 1 + 1e-10;

Vector3 horizontal(const Vector3& v) { return {v.x(), v.y(), 0}; }

/// w/|w|, or any direction.
Vector3 direction_of(const Vector3& w) {
  return w.isZero(0) ? Vector3(Vector3::UnitX()) : Vector3(w.normalized());
}

/// Overlap and time in which an elastic contact stops the reduced mass at the approach speed.
struct ImpactScale {
  double reduced_mass, speed;

  double operator()(const LinearForce& law) const {
    return speed * std::sqrt(reduced_mass / law.stiffness);
  }
  double operator()(const PowerForce& law) const { return power(law.modulus, law.alpha); }
  template <class Law>
  double operator()(const Law& law) const {
    return power(law.modulus, 1.5);
  }
  double power(double modulus, double alpha) const {
    return std::pow(0.5 * (1 + alpha) * reduced_mass * speed * speed / modulus, 1 / (1 + alpha));
  }
};

}  // namespace

ContactState::ContactState(const ContactScene& scene, std::span<const BodyState> initial,
                           double start, const ContactScales& scales)
    : time(start), scene_(&scene), scales_(scales), dynamics_(scene) {
  bool any_soft = false;
  for (const auto& contact : scene.soft) any_soft |= contact.has_value();
  dynamics_.slots = any_soft ? 1 : 0;
  if (any_soft) free_slots_.push_back(0);
  y.assign(dynamics_.size(), 0);
  dynamics_.next_kink = scene.hard.motion.next_kink(start);
  dynamics_.creep_speed = 1e-8 * scales.speed;
  dynamics_.onset_speed = 1e-9 * scales.speed;
  for (std::size_t i = 0; i < initial.size(); ++i) {
    set_body(i, initial[i]);
    const bool touches = initial[i].position.z() <= scene.hard.bodies[i].radius * (1 + 4 * 0x1p-52);
    if (!touches && !scene.hard.confined) continue;
    if (!scene.hard.confined && initial[i].velocity.z() < 0)
      land_now(i);
    else
      place(i);
  }
  y[dynamics_.dissipated_at()] = y[dynamics_.work_at()] = 0;
  settle();
}

BodyState ContactState::body(std::size_t i) const {
  const double* at = y.data() + i * kBody;
  BodyState state;
  state.position = {at[0], at[1], scene_->hard.bodies[i].radius + at[2]};
  state.velocity = {at[3], at[4], at[5]};
  state.angular_velocity = dynamics_.angular_velocity(i, time, y.data());
  return state;
}

std::vector<BodyState> ContactState::bodies() const {
  std::vector<BodyState> states(dynamics_.modes.size());
  for (std::size_t i = 0; i < states.size(); ++i) states[i] = body(i);
  return states;
}

void ContactState::set_body(std::size_t i, const BodyState& state) {
  double* at = y.data() + i * kBody;
  for (int k = 0; k < 3; ++k) {
    at[k] = state.position[k];
    at[k + 3] = state.velocity[k];
  }
  at[2] -= scene_->hard.bodies[i].radius;
  const Vector3 slip = dynamics_.slip_of(i, time, state);
  at[6] = slip.x();
  at[7] = slip.y();
  at[8] = state.angular_velocity.z();
}

// --- contacts of two bodies ----------------------------------------------------------------------

void ContactState::begin_contact(std::size_t i, std::size_t j) {
  const auto& law = scene_->between(i, j);
  ContactMode contact;
  contact.first = i;
  contact.second = j;
  contact.law = &*law;
  const double mi = scene_->hard.bodies[i].mass, mj = scene_->hard.bodies[j].mass;
  contact.reduced_mass = mi * mj / (mi + mj);
  if (free_slots_.empty()) {
    // One more slot, before the two ledgers at the end.
    free_slots_.push_back(dynamics_.slots++);
    y.insert(y.end() - 2, ContactDynamics::kSlot, 0.0);
  }
  contact.slot = free_slots_.back();
  free_slots_.pop_back();
  std::fill_n(y.begin() + static_cast<std::ptrdiff_t>(dynamics_.slot_at(contact.slot)),
              ContactDynamics::kSlot, 0.0);
  const BodyState a = body(i), b = body(j);
  const Vector3 n = (a.position - b.position).normalized();
  const double approach = std::max(-n.dot(a.velocity - b.velocity), 1e-9 * scales_.speed);
  contact.overlap_scale = std::visit(ImpactScale{contact.reduced_mass, approach}, law->normal);
  contact.time_scale = contact.overlap_scale / approach;
  dynamics_.contacts.push_back(contact);
  evaluate();
  ContactMode& made = dynamics_.contacts.back();
  const auto& forces = evaluation_.contacts.back();
  made.force_sign = forces.normal < 0 ? -1 : 1;
  if (const auto* viscous = std::get_if<ViscousForce>(&law->tangential))
    made.capped = viscous->viscous(forces.slip.norm()) > viscous->cap(forces.normal);
}

void ContactState::end_contact(std::size_t index) {
  ContactMode& contact = dynamics_.contacts[index];
  if (!contact.clamped) clamp_contact(index);
  free_slots_.push_back(contact.slot);
  dynamics_.contacts.erase(dynamics_.contacts.begin() + static_cast<std::ptrdiff_t>(index));
}

void ContactState::clamp_contact(std::size_t index) {
  ContactMode& contact = dynamics_.contacts[index];
  double* slot = y.data() + dynamics_.slot_at(contact.slot);
  // What is still stored is lost; 0 at the end of an overlap.
  y[dynamics_.dissipated_at()] +=
      std::visit([&](const auto& law) { return law.energy(slot[0]); }, contact.law->normal);
  contact.clamped = true;
  slot[1] = slot[2] = slot[3] = 0;
  contact.broken = 0;
  contact.growing = true;
}

void ContactState::release_contact(std::size_t index) {
  ContactMode& contact = dynamics_.contacts[index];
  contact.clamped = false;
  y[dynamics_.dissipated_at()] -=
      std::visit([&](const auto& law) { return law.energy(y[dynamics_.slot_at(contact.slot)]); },
                 contact.law->normal);
}

void ContactState::break_asperity(std::size_t index, double change) {
  ContactMode& contact = dynamics_.contacts[index];
  const auto& law = std::get<AsperityForce>(contact.law->tangential);
  if (law.form == AsperityForce::Form::printed) {
    contact.broken += change;
  } else {
    double* slot = y.data() + dynamics_.slot_at(contact.slot);
    slot[1] = slot[2] = slot[3] = 0;
  }
}

void ContactState::switch_growth(std::size_t index, bool growing) {
  ContactMode& contact = dynamics_.contacts[index];
  if (contact.growing == growing) return;
  evaluate();
  const double force = evaluation_.contacts[index].normal;
  double* slot = y.data() + dynamics_.slot_at(contact.slot);
  for (int k = 1; k <= 3; ++k)
    slot[k] = growing ? slot[k] * force : force > 0 ? slot[k] / force : 0;
  contact.growing = growing;
}

// --- impulses ------------------------------------------------------------------------------------

Vector3 ContactState::momentum(std::span<const std::size_t> bodies) const {
  Vector3 sum = Vector3::Zero();
  for (std::size_t i : bodies) sum += scene_->hard.bodies[i].mass * body(i).velocity;
  return sum;
}

/// Enters what an instant changed into the ledgers: impulses between bodies cancel in the
/// momentum, so its horizontal change is the substrate's, which works where the substrate moves.
void ContactState::account_impulse(double energy_before, const Vector3& momentum_before,
                                   std::span<const std::size_t> bodies) {
  const Vector3 given = momentum(bodies) - momentum_before;
  const double work = given.dot(dynamics_.substrate_velocity(time));
  y[dynamics_.work_at()] += work;
  y[dynamics_.dissipated_at()] += energy_before + work - dynamics_.kinetic_energy(time, y.data());
}

CollisionResult ContactState::collide_now(std::size_t i, std::size_t j) {
  const HardScene& scene = scene_->hard;
  const std::array bodies{i, j};
  const double energy = dynamics_.kinetic_energy(time, y.data());
  const Vector3 before = momentum(bodies);
  // In the frame of the substrate, which moves uniformly for an instant.
  const Vector3 frame = dynamics_.substrate_velocity(time);
  BodyState a = body(i), b = body(j);
  a.velocity -= frame;
  b.velocity -= frame;
  const CollisionResult result =
      collide(scene.between(i, j), {scene.confined, scales_.slowest_rebound},
              {scene.bodies[i], scene.on_substrate(i), a, dynamics_.modes[i].on_plane()},
              {scene.bodies[j], scene.on_substrate(j), b, dynamics_.modes[j].on_plane()});
  a.velocity += frame;
  b.velocity += frame;
  set_body(i, a);
  set_body(j, b);
  account_impulse(energy, before, bodies);
  for (std::size_t k : bodies)
    if (dynamics_.modes[k].on_plane()) place(k);
  return result;
}

void ContactState::land_now(std::size_t i) {
  const HardScene& scene = scene_->hard;
  const std::array bodies{i};
  const double energy = dynamics_.kinetic_energy(time, y.data());
  const Vector3 before = momentum(bodies);
  const Vector3 frame = dynamics_.substrate_velocity(time);
  BodyState state = body(i);
  state.position.z() = scene.bodies[i].radius;
  state.velocity -= frame;
  land(scene.bodies[i], scene.on_substrate(i), scales_.slowest_landing, state);
  state.velocity += frame;
  set_body(i, state);
  account_impulse(energy, before, bodies);
  place(i);
}

void ContactState::lift_off(std::size_t i) { dynamics_.modes[i].kind = Kind::flying; }

// --- modes of a body on the substrate ------------------------------------------------------------

/// Finds the mode of a body that touches the plane, from its velocities alone.
void ContactState::place(std::size_t i) {
  const HardScene& scene = scene_->hard;
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
  const HardScene& scene = scene_->hard;
  const Sphere& sphere = scene.bodies[i];
  BodyMode& mode = dynamics_.modes[i];
  const Vector3 change = dynamics_.slip(i, y.data()) / (1 + sphere.inverse_shape_factor());
  y[i * kBody + 3] -= change.x();
  y[i * kBody + 4] -= change.y();
  mode.kind = Kind::rolling;
  const Vector3 relative = dynamics_.relative_velocity(i, time, y.data());
  mode.roll_held =
      !scene.on_substrate(i).rolling.is_zero() && relative.norm() <= scales_.slip_floor;
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
  mode.roll_held = true;
  evaluate();
  const auto& f = evaluation_.bodies[i];
  if (f.roll_load.norm() > f.roll_limit) begin_roll(i);
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
  if (mode.kind != Kind::rolling || in_contact(i)) return false;
  const auto& f = evaluation_.bodies[i];
  return dynamics_.relative_velocity(i, time, y.data()).isZero(0) &&
         body(i).angular_velocity.z() == 0 && (mode.roll_held || f.acceleration.isZero(0));
}

}  // namespace slipcheck
