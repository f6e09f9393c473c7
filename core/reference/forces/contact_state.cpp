#include "reference/forces/contact_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/stop_scope.h"
#include "physics/motion/substrate_phase.h"
#include "physics/numbers.h"
#include "reference/events/cluster.h"

namespace slipcheck {
namespace {

using Kind = BodyMode::Kind;

/// Overlap and time in which an elastic contact stops the reduced mass at the approach speed.
struct ImpactScale {
  double reduced_mass, speed;

  double operator()(const LinearForce& law) const {
    return speed * std::sqrt(reduced_mass / law.stiffness);
  }
  double operator()(const HertzForce& law) const { return power(law.modulus, 1.5); }
  double operator()(const PowerForce& law) const { return power(law.modulus, law.alpha); }
  double operator()(const ViscoelasticForce& law) const { return power(law.modulus, 1.5); }
  double operator()(const CompactViscoelasticForce& law) const { return power(law.modulus, 1.5); }
  double power(double modulus, double alpha) const {
    return std::pow(0.5 * (1 + alpha) * reduced_mass * speed * speed / modulus, 1 / (1 + alpha));
  }
};

}  // namespace

ContactState::ContactState(const ContactScene& scene, std::span<const BodyState> initial,
                           double start, const ContactScales& scales,
                           std::span<const InitialContact> overlapping)
    : time(start),
      scene_(&scene),
      scales_(scales),
      dynamics_(scene),
      hardest_impact_(initial.size(), 0) {
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
  for (const InitialContact& contact : overlapping)
    begin_contact(contact.first, contact.second, contact.overlap);
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

void ContactState::begin_contact(std::size_t i, std::size_t j, double overlap) {
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
    y.insert(y.end() - 2, kSlot, 0.0);
  }
  contact.slot = free_slots_.back();
  free_slots_.pop_back();
  std::fill_n(y.begin() + static_cast<std::ptrdiff_t>(dynamics_.slot_at(contact.slot)), kSlot, 0.0);
  y[dynamics_.slot_at(contact.slot)] = overlap;
  const BodyState a = body(i), b = body(j);
  const Vector3 n = (a.position - b.position).normalized();
  // What an overlap holds counts as the approach that would have made it.
  // What an impact leaves together is pressed by weights alone.
  const double least =
      law->after_impact
          ? scene_->hard.gravity * std::visit(ImpactScale{contact.reduced_mass, 1}, law->normal)
          : 1e-9 * scales_.speed;
  const double approach =
      std::hypot(std::max(-n.dot(a.velocity - b.velocity), least),
                 overlap > 0 ? release_speed(*law, overlap, contact.reduced_mass) : 0);
  contact.overlap_scale = std::visit(ImpactScale{contact.reduced_mass, approach}, law->normal);
  contact.time_scale = contact.overlap_scale / approach;
  dynamics_.contacts.push_back(contact);
  for (std::size_t k : {i, j})
    if (dynamics_.is_coupled(k) && dynamics_.modes[k].kind == Kind::sliding)
      dynamics_.modes[k].spin_held = false;  // the other may spin it
  evaluate();
  ContactMode& made = dynamics_.contacts.back();
  const auto& forces = evaluation_.contacts.back();
  follow(law->tangential, forces.normal, forces.slip, forces.n, made.branch);
  const Vector3 bend = first_bend(law->tangential, forces.closing, forces.slip);
  for (int k = 0; k < 3; ++k)
    y[dynamics_.slot_at(made.slot) + 1 + static_cast<std::size_t>(k)] = bend[k];
  if (overlap == 0) return;
  made.clamped = law->end == ContactEnd::zero_force && forces.normal <= 0;
  const double growth = dynamics_.growth(made, forces, y.data());
  made.branch.growing = growth > 0 || (growth == 0 && forces.closing_rate > 0);
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
  const Vector3 bend =
      bend_without_force(contact.law->tangential, Vector3(slot[1], slot[2], slot[3]));
  for (int k = 0; k < 3; ++k) slot[1 + k] = bend[k];
  contact.branch.broken = 0;
  contact.branch.growing = true;
}

void ContactState::release_contact(std::size_t index) {
  ContactMode& contact = dynamics_.contacts[index];
  contact.clamped = false;
  y[dynamics_.dissipated_at()] -=
      std::visit([&](const auto& law) { return law.energy(y[dynamics_.slot_at(contact.slot)]); },
                 contact.law->normal);
}

bool ContactState::reach_caps() {
  constexpr double kBeyond = 1 + 1e-6;
  bool reached = false;
  for (std::size_t c = 0; c < dynamics_.contacts.size(); ++c) {
    ContactMode& contact = dynamics_.contacts[c];
    const auto* viscous = std::get_if<ViscousForce>(&contact.law->tangential);
    if (!viscous || contact.clamped) continue;
    const auto& forces = evaluation_.contacts[c];
    const auto reach = [&](TangentialEdge edge, bool& capped) {
      const double slip = slip_at(edge, contact.law->tangential, forces.slip, forces.n);
      if (capped || viscous->viscous(slip) <= kBeyond * viscous->cap(forces.normal)) return;
      capped = reached = true;
    };
    reach(TangentialEdge::cap, contact.branch.capped);
    if (caps_apart(contact.law->tangential))
      reach(TangentialEdge::cap_up, contact.branch.capped_up);
  }
  return reached;
}

void ContactState::cross_edge(std::size_t index, TangentialEdge edge, bool rises) {
  ContactMode& contact = dynamics_.contacts[index];
  if (edge == TangentialEdge::growth) evaluate();
  double* slot = y.data() + dynamics_.slot_at(contact.slot);
  Vector3 bend(slot[1], slot[2], slot[3]);
  cross(edge, rises, contact.law->tangential, evaluation_.contacts[index].normal, contact.branch,
        bend);
  std::copy_n(bend.data(), 3, slot + 1);
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
  const Scene& scene = scene_->hard;
  const std::array bodies{i, j};
  const double energy = dynamics_.kinetic_energy(time, y.data());
  const Vector3 before = momentum(bodies);
  // In the frame of the substrate, which moves uniformly for an instant.
  const Vector3 frame = dynamics_.substrate_velocity(time);
  BodyState a = body(i), b = body(j);
  a.velocity -= frame;
  b.velocity -= frame;
  // What stays together afterwards needs no rule to end.
  const double fraction = scene_->between(i, j) ? 0 : scales_.rebound_fraction;
  const double hardest = std::max(hardest_impact_[i], hardest_impact_[j]);
  CollisionResult result =
      scene.collide(i, j, {scene.confined, fraction * hardest},
                    {scene.bodies[i], scene.on_substrate(i), a, dynamics_.modes[i].on_plane()},
                    {scene.bodies[j], scene.on_substrate(j), b, dynamics_.modes[j].on_plane()});
  for (const std::size_t k : bodies)
    hardest_impact_[k] = std::max(hardest_impact_[k], result.impact_speed);
  a.velocity += frame;
  b.velocity += frame;
  set_body(i, a);
  set_body(j, b);
  account_impulse(energy, before, bodies);
  for (std::size_t k : bodies)
    if (dynamics_.modes[k].on_plane()) place(k);
  return result;
}

double ContactState::approach_speed(std::size_t i, std::size_t j) const {
  const BodyState a = body(i), b = body(j);
  return -(a.position - b.position).normalized().dot(a.velocity - b.velocity);
}

ContactState::Rest ContactState::rest_of(std::size_t i, std::size_t j) const {
  const auto& soft = scene_->between(i, j);
  // What an impact leaves together it leaves so up to the round-off of many impulses.
  const double much = soft && soft->after_impact ? 1e3 : 1;
  const double contact = scene_->hard.bodies[i].radius + scene_->hard.bodies[j].radius;
  return {much * 8 * kEpsilon * contact, much * 1e-13 * scales_.speed, much * 1e-12};
}

bool ContactState::meet(std::size_t i, std::size_t j) const {
  return approach_speed(i, j) > rest_of(i, j).speed;
}

void ContactState::hand_impulses_on() {
  if (std::ranges::none_of(scene_->soft,
                           [](const auto& soft) { return soft && soft->after_impact; }))
    return;
  std::vector<std::array<std::size_t, 2>> together;
  for (std::size_t i = 0; i < dynamics_.modes.size(); ++i)
    for (std::size_t j = i + 1; j < dynamics_.modes.size(); ++j) {
      const auto& soft = scene_->between(i, j);
      if (!soft || !soft->after_impact) continue;
      const double contact = scene_->hard.bodies[i].radius + scene_->hard.bodies[j].radius;
      const double gap = (body(i).position - body(j).position).norm() - contact;
      if (gap <= rest_of(i, j).gap) together.push_back({i, j});
    }
  collide_fastest_first(
      together, [&](const auto& pair) { return approach_speed(pair[0], pair[1]); },
      [&](const auto& pair, std::size_t) { return 1e-2 * rest_of(pair[0], pair[1]).speed; },
      [&](std::size_t i, std::size_t j) {
        heed_stop();
        collide_now(i, j);
      },
      std::numeric_limits<std::size_t>::max());
}

void ContactState::land_now(std::size_t i) {
  const Scene& scene = scene_->hard;
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

}  // namespace slipcheck
