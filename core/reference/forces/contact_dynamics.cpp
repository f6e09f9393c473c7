#include "reference/forces/contact_dynamics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/contact/coupled_friction.h"

namespace slipcheck {
namespace {

using Kind = BodyMode::Kind;

Vector3 vector_at(const double* y) { return {y[0], y[1], y[2]}; }
Vector3 velocity_of(const double* y, std::size_t i) { return vector_at(y + i * kBody + 3); }
/// k̂×v.
Vector3 turned(const Vector3& v) { return {-v.y(), v.x(), 0}; }

void store(const Vector3& v, double* y) {
  y[0] = v.x();
  y[1] = v.y();
  y[2] = v.z();
}

}  // namespace

ContactDynamics::ContactDynamics(const ContactScene& scene)
    : next_kink(scene.hard.motion.next_kink(-std::numeric_limits<double>::infinity())),
      modes(scene.hard.bodies.size()),
      scene_(&scene) {}

Vector3 ContactDynamics::substrate_velocity(double t) const {
  return scene_->hard.motion.velocity(t < next_kink ? t : std::nextafter(next_kink, -1e300));
}

Vector3 ContactDynamics::between_centres(std::size_t i, std::size_t j, const double* y) const {
  Vector3 way = vector_at(y + i * kBody) - vector_at(y + j * kBody);
  way.z() += scene_->hard.bodies[i].radius - scene_->hard.bodies[j].radius;
  return way;
}

Vector3 ContactDynamics::relative_velocity(std::size_t i, double t, const double* y) const {
  return horizontal(velocity_of(y, i)) - substrate_velocity(t);
}

Vector3 ContactDynamics::slip_of(std::size_t i, double t, const BodyState& state) const {
  return horizontal(slip_velocity(state, scene_->hard.bodies[i].radius)) - substrate_velocity(t);
}

/// k̂×Ω = (u − v + v_S)/R, turned back.
Vector3 ContactDynamics::angular_velocity(std::size_t i, const Vector3& substrate,
                                          const double* y) const {
  Vector3 spin = turned(velocity_of(y, i) - substrate - slip(i, y)) / scene_->hard.bodies[i].radius;
  spin.z() = y[i * kBody + 8];
  return spin;
}

void ContactDynamics::add_contact(const ContactMode& contact, const Vector3& substrate,
                                  const double* y, ContactForces& forces, Evaluation& out) const {
  const std::size_t i = contact.first, j = contact.second;
  const Sphere &a = scene_->hard.bodies[i], &b = scene_->hard.bodies[j];
  const double* slot = y + slot_at(contact.slot);
  const Vector3 n = between_centres(i, j, y).normalized();
  const Vector3 dv = velocity_of(y, i) - velocity_of(y, j);
  const Vector3 u = dv - (a.radius * angular_velocity(i, substrate, y) +
                          b.radius * angular_velocity(j, substrate, y))
                             .cross(n);
  forces.n = n;
  forces.closing = -n.dot(dv);
  forces.slip = u - n.dot(u) * n;
  const double overlap = slot[0];
  double elastic = 0;
  std::visit(
      [&](const auto& law) {
        forces.normal = law(overlap, forces.closing);
        elastic = law.elastic(overlap);
      },
      contact.law->normal);
  if (contact.clamped) {
    forces.tangential.setZero();
    return;
  }
  const Vector3 zeta = vector_at(slot + 1);
  forces.tangential = tangential_force(contact.law->tangential, contact.branch, forces.normal,
                                       forces.slip, zeta, n);
  out.dissipation +=
      (forces.normal - elastic) * forces.closing - forces.tangential.dot(forces.slip);
  const Vector3 force = forces.normal * n + forces.tangential;
  const Vector3 n_cross = n.cross(forces.tangential);
  out.bodies[i].applied += force;
  out.bodies[j].applied -= force;
  // n×F_T is the same for both: the normal and the force change sign together.
  out.bodies[i].torque -= a.radius * n_cross;
  out.bodies[j].torque -= b.radius * n_cross;
}

/// The substrate's force F that keeps u̇ = 0: (G + F)/m + (R/I) k̂×T + (R²/I) F = a_S.
Vector3 ContactDynamics::sticking_force(std::size_t i, const Vector3& substrate_acceleration,
                                        const BodyForces& f) const {
  const Sphere& sphere = scene_->hard.bodies[i];
  const double m = sphere.mass;
  return (m * substrate_acceleration - horizontal(f.applied) -
          (m * sphere.radius / sphere.moment_of_inertia()) * turned(f.torque)) /
         (1 + sphere.inverse_shape_factor());
}

/// K (18); drilling coupled to it where the contact is a disc; rolling friction as a couple.
void ContactDynamics::slide(std::size_t i, const Vector3& substrate_acceleration,
                            const Vector3& spin, const Vector3& slip, BodyForces& f,
                            Evaluation& out) const {
  const Sphere& sphere = scene_->hard.bodies[i];
  const SubstrateContact& contact = scene_->hard.on_substrate(i);
  const BodyMode& mode = modes[i];
  const double inertia = sphere.moment_of_inertia();
  const double normal = mode.normal_sign * f.normal;
  const double kinetic = contact.kinetic_friction * normal;
  double drilling = 0;
  if (is_coupled(i) && !mode.spin_held) {
    const auto pressure =
        contact.hertzian_pressure ? DiscPressure::hertzian : DiscPressure::uniform;
    const double speed = slip.norm(), rim = contact.coupled_radius * std::abs(spin.z());
    const double both = std::hypot(speed, rim);
    const CoupledFriction shared =
        both > 0 ? coupled_friction(pressure, speed, rim) : CoupledFriction{0, 0};
    const double push = kinetic * both / std::hypot(both, creep_speed);
    f.friction = speed > 0 ? Vector3((-push * shared.force / speed) * slip) : Vector3::Zero();
    drilling = -std::copysign(push * contact.coupled_radius * shared.torque, spin.z());
  } else {
    Vector3 direction = continued_direction(slip, mode.slip_direction);
    if (mode.slip_begins) {
      const Vector3 load = -sticking_force(i, substrate_acceleration, f);
      const double size = load.norm();
      if (size > 0) direction = (slip + (onset_speed / size) * load).normalized();
    }
    f.friction = -kinetic * direction;
    if (!is_coupled(i) && !mode.spin_held)
      drilling = -mode.spin_sign * contact.drilling_length * normal;
  }
  out.dissipation -= f.friction.dot(slip) + drilling * spin.z();

  Vector3 torque = horizontal(f.torque) - sphere.radius * turned(f.friction);
  if (contact.rolling_while_sliding) {
    const Vector3 rate = horizontal(spin);
    f.roll_load = torque;
    f.roll_limit = (1 + sphere.shape_factor) * contact.rolling(sphere.radius * rate.norm()) *
                   sphere.radius * normal;
    const Vector3 couple =
        mode.roll_held ? Vector3(-torque)
                       : Vector3(-f.roll_limit * continued_direction(rate, mode.roll_direction));
    out.dissipation -= couple.dot(rate);
    torque += couple;
  }
  f.acceleration = horizontal(f.applied + f.friction) / sphere.mass;
  f.angular_acceleration = torque / inertia;
  f.angular_acceleration.z() = mode.spin_held ? 0 : (f.torque.z() + drilling) / inertia;
}

/// K (11)-(17), (22)-(24): rolling without slip, with rolling friction as a force on the centre.
void ContactDynamics::roll(std::size_t i, const Vector3& relative,
                           const Vector3& substrate_acceleration, BodyForces& f,
                           Evaluation& out) const {
  const Sphere& sphere = scene_->hard.bodies[i];
  const SubstrateContact& contact = scene_->hard.on_substrate(i);
  const BodyMode& mode = modes[i];
  const double m = sphere.mass;
  const double normal = mode.normal_sign * f.normal;
  const Vector3 applied = horizontal(f.applied);
  const Vector3 force = sticking_force(i, substrate_acceleration, f);
  const Vector3 free = (applied + force) / m;
  const double rolling = contact.rolling(relative.norm()) * normal;
  f.roll_load = m * (free - substrate_acceleration);
  f.roll_limit = contact.rolling(0) * normal;
  if (mode.roll_held) {
    f.acceleration = substrate_acceleration;
  } else if (contact.rolling.is_zero()) {
    f.acceleration = free;
  } else {
    const Vector3 direction = continued_direction(relative, mode.roll_direction);
    f.acceleration = free - (rolling / m) * direction;
    out.dissipation += (1 + sphere.shape_factor) * rolling * direction.dot(relative);
  }
  f.friction = m * f.acceleration - applied;
  f.slip_load = contact.rolling_while_sliding ? f.friction : force;
  f.angular_acceleration = turned(f.acceleration - substrate_acceleration) / sphere.radius;
  const double drilling = mode.spin_held ? 0 : -mode.spin_sign * contact.drilling_length * normal;
  f.angular_acceleration.z() =
      mode.spin_held ? 0 : (f.torque.z() + drilling) / sphere.moment_of_inertia();
}

void ContactDynamics::move(std::size_t i, double t, const Vector3& substrate, const double* y,
                           Evaluation& out) const {
  const Scene& scene = scene_->hard;
  BodyForces& f = out.bodies[i];
  const Sphere& sphere = scene.bodies[i];
  const BodyMode& mode = modes[i];
  if (!mode.on_plane()) {
    f.normal = 0;
    f.acceleration = f.applied / sphere.mass;
    f.angular_acceleration = f.torque / sphere.moment_of_inertia();
    return;
  }
  f.normal = -f.applied.z();
  if (mode.kind == Kind::sliding) {
    slide(i, scene.motion.acceleration(t), angular_velocity(i, substrate, y), slip(i, y), f, out);
  } else {
    roll(i, horizontal(velocity_of(y, i)) - substrate, scene.motion.acceleration(t), f, out);
    if (!mode.spin_held)
      out.dissipation += mode.spin_sign * scene.on_substrate(i).drilling_length * mode.normal_sign *
                         f.normal * y[i * kBody + 8];
  }
  if (!scene.motion.is_still()) out.work += f.friction.dot(substrate);
}

void ContactDynamics::evaluate(double t, const double* y, Evaluation& out) const {
  const Scene& scene = scene_->hard;
  const Vector3 gravity(scene.downhill.x(), scene.downhill.y(), -scene.gravity);
  const Vector3 substrate = substrate_velocity(t);
  out.bodies.resize(scene.bodies.size());
  out.contacts.resize(contacts.size());
  out.dissipation = out.work = 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    out.bodies[i].applied = scene.bodies[i].mass * gravity;
    out.bodies[i].torque.setZero();
    out.bodies[i].friction.setZero();
  }
  for (std::size_t c = 0; c < contacts.size(); ++c)
    add_contact(contacts[c], substrate, y, out.contacts[c], out);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) move(i, t, substrate, y, out);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    ContactForces& f = out.contacts[c];
    const std::size_t i = contacts[c].first, j = contacts[c].second;
    const Vector3 dv = velocity_of(y, i) - velocity_of(y, j);
    const double distance = between_centres(i, j, y).norm();
    const Vector3 across = dv + f.closing * f.n;
    f.closing_rate = -f.n.dot(out.bodies[i].acceleration - out.bodies[j].acceleration) -
                     across.squaredNorm() / distance;
  }
}

void ContactDynamics::right_side(double t, const double* y, double* rate) {
  evaluate(t, y, scratch_);
  const Vector3 substrate = scene_->hard.motion.acceleration(t);
  for (std::size_t i = 0; i < modes.size(); ++i) {
    double* out = rate + i * kBody;
    store(velocity_of(y, i), out);
    const BodyForces& f = scratch_.bodies[i];
    store(f.acceleration, out + 3);
    Vector3 slip_rate =
        f.acceleration - substrate + scene_->hard.bodies[i].radius * turned(f.angular_acceleration);
    if (modes[i].kind == Kind::rolling) slip_rate.setZero();
    slip_rate.z() = f.angular_acceleration.z();
    store(slip_rate, out + 6);
  }
  std::fill(rate + slot_at(0), rate + slot_at(slots), 0.0);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const ContactMode& contact = contacts[c];
    const ContactForces& f = scratch_.contacts[c];
    double* out = rate + slot_at(contact.slot);
    out[0] = f.closing;
    if (contact.clamped || !has_memory(contact.law->tangential)) continue;
    const Vector3 dv = velocity_of(y, contact.first) - velocity_of(y, contact.second);
    const double distance = between_centres(contact.first, contact.second, y).norm();
    // ζ stays in the tangent plane as n turns.
    const Vector3 turning = (dv + f.closing * f.n) / distance;
    const Vector3 zeta = vector_at(y + slot_at(contact.slot) + 1);
    const Vector3 bending = bend_rate(contact.law->tangential, contact.branch, f.normal, f.slip);
    store(bending - zeta.dot(turning) * f.n, out + 1);
  }
  rate[dissipated_at()] = scratch_.dissipation;
  rate[work_at()] = scratch_.work;
}

double ContactDynamics::kinetic_energy(double t, const double* y) const {
  double energy = 0;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const Sphere& s = scene_->hard.bodies[i];
    energy += 0.5 * s.mass * velocity_of(y, i).squaredNorm() +
              0.5 * s.moment_of_inertia() * angular_velocity(i, t, y).squaredNorm();
  }
  return energy;
}

double ContactDynamics::potential_energy(const double* y) const {
  const Scene& scene = scene_->hard;
  const Vector3 gravity(scene.downhill.x(), scene.downhill.y(), -scene.gravity);
  double energy = 0;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    // From where the body started: its way is exact where its place has lost digits.
    Vector3 way = vector_at(y + i * kBody) - scene.initial[i].position;
    way.z() += scene.bodies[i].radius;
    energy -= scene.bodies[i].mass * gravity.dot(way);
  }
  return energy + elastic_energy(y);
}

double ContactDynamics::elastic_energy(const double* y) const {
  double energy = 0;
  for (const ContactMode& contact : contacts)
    if (!contact.clamped)
      energy += std::visit([&](const auto& law) { return law.energy(y[slot_at(contact.slot)]); },
                           contact.law->normal);
  return energy;
}

}  // namespace slipcheck
