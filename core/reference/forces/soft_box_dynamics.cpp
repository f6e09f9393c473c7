#include "reference/forces/soft_box_dynamics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <variant>

#include "scene/scaled_impact.h"

namespace slipcheck {
namespace {

using Face = SoftBoxDynamics::Face;

double elastic_energy(const NormalForce& law, double overlap) {
  if (!(overlap > 0)) return 0;
  return std::visit([&](const auto& force) { return force.energy(overlap); }, law);
}

void require(const std::vector<std::optional<SoftContact>>& contacts, const Scene& scene,
             const char* surface) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (scene.material[i] >= contacts.size() || !contacts[scene.material[i]])
      throw Unsupported(std::string("resolved contacts in a box must all last; that of the ") +
                        surface + " with body " + std::to_string(i) +
                        " is hard and happens at an instant");
}

}  // namespace

PlanarMotion planar(const BodyState& s) {
  return {s.position.x(), s.position.z(), s.velocity.x(), s.velocity.z(), s.angular_velocity.y()};
}

BodyState spatial(const PlanarMotion& m) { return {{m.x, 0, m.z}, {m.vx, 0, m.vz}, {0, m.w, 0}}; }

SoftBoxDynamics::SoftBoxDynamics(const ContactScene& scene) : scene_(&scene) {
  const Scene& hard = scene.hard;
  if (!hard.box) throw Unsupported("the scene has no box");
  for (std::size_t i = 0; i < hard.bodies.size(); ++i)
    for (std::size_t j = i + 1; j < hard.bodies.size(); ++j)
      if (!scene.between(i, j))
        throw Unsupported("resolved contacts in a box must all last; that of bodies " +
                          std::to_string(i) + " and " + std::to_string(j) +
                          " is hard and happens at an instant");
  require(scene.soft_box.on_floor, hard, "floor");
  require(scene.soft_box.on_wall, hard, "walls");
  if (hard.box->lid) require(scene.soft_box.on_lid, hard, "lid");
  for (const Sphere& s : hard.bodies)
    inertia_.push_back({1 / s.mass, 1 / s.moment_of_inertia(), s.radius});
}

SoftBoxDynamics::Meeting SoftBoxDynamics::meeting(std::size_t first, std::size_t partner, double t,
                                                  const PlanarMotion& a,
                                                  const PlanarMotion& b) const {
  Meeting m;
  const double radius = inertia_[first].radius;
  if (partner < size()) {
    const double dx = a.x - b.x, dz = a.z - b.z;
    const double dvx = a.vx - b.vx, dvz = a.vz - b.vz;
    m.distance = std::sqrt(dx * dx + dz * dz);
    m.nx = dx / m.distance;
    m.nz = dz / m.distance;
    m.overlap = radius + inertia_[partner].radius - m.distance;
    m.closing = -(m.nx * dvx + m.nz * dvz);
    m.across = m.nz * dvx - m.nx * dvz;
    m.slip = m.across - (radius * a.w + inertia_[partner].radius * b.w);
    return m;
  }
  const Box& box = *scene_->hard.box;
  const auto which = static_cast<Face>(partner - size());
  const bool is_side = which == Face::left || which == Face::right;
  if (!is_side && (which == Face::floor || box.moving_walls)) m.surface_vz = box.floor.velocity(t);
  if (is_side && box.moving_walls) m.surface_vz = box.floor.velocity(t);
  switch (which) {
    case Face::floor:
      m.nz = 1;
      m.overlap = radius + box.floor.height(t) - a.z;
      break;
    case Face::lid:
      m.nz = -1;
      m.overlap = radius + a.z - *box.lid - (box.moving_walls ? box.floor.height(t) : 0);
      break;
    case Face::left:
      m.nx = 1;
      m.overlap = radius - a.x;
      break;
    case Face::right:
      m.nx = -1;
      m.overlap = radius + a.x - box.width;
      break;
  }
  const double dvz = a.vz - m.surface_vz;
  m.closing = -(m.nx * a.vx + m.nz * dvz);
  m.across = m.nz * a.vx - m.nx * dvz;
  m.slip = m.across - radius * a.w;
  return m;
}

const SoftContact& SoftBoxDynamics::law(std::size_t first, std::size_t partner) const {
  if (partner < size()) return *scene_->between(first, partner);
  const std::size_t material = scene_->hard.material[first];
  switch (static_cast<Face>(partner - size())) {
    case Face::floor:
      return *scene_->soft_box.on_floor[material];
    case Face::lid:
      return *scene_->soft_box.on_lid[material];
    default:
      return *scene_->soft_box.on_wall[material];
  }
}

SoftTouch SoftBoxDynamics::touch(std::size_t first, std::size_t partner, const Meeting& at) const {
  SoftTouch made;
  made.first = first;
  made.partner = partner;
  made.law = &law(first, partner);
  double mobility = 0;
  const auto add_body = [&](const Inertia& body) {
    mobility += body.inverse_mass;
    made.tangential_mobility +=
        body.inverse_mass + body.radius * body.radius * body.inverse_inertia;
  };
  add_body(inertia_[first]);
  if (partner < size()) add_body(inertia_[partner]);
  made.reduced_mass = 1 / mobility;
  const bool attracts = normal_force(made.law->normal, at.overlap, at.closing) < 0;
  if (made.law->end == ContactEnd::zero_force) made.pushes = !attracts;
  made.branch.force_sign = attracts ? -1 : 1;
  scale(made, at);
  return made;
}

/// π T of the impact with that energy; T/D where it is damped more than that; and the time in which
/// the viscous tangential force, uncapped, stops the slip. A contact that begins without speed gets
/// what gravity gives it.
void SoftBoxDynamics::scale(SoftTouch& touch, const Meeting& at) const {
  const SoftContact& law = *touch.law;
  const double speed2 =
      at.closing * at.closing + 2 * elastic_energy(law.normal, at.overlap) / touch.reduced_mass;
  if (touch.time_scale > 0 && speed2 < 1.2 * touch.energy_speed2) return;
  double speed = std::max(std::sqrt(speed2), 1e-12);
  ImpactScales scales = impact_scales(law.normal, touch.reduced_mass, speed);
  for (int k = 0; k < 4 && scene_->hard.gravity * scales.time > speed; ++k) {
    speed = scene_->hard.gravity * scales.time;
    scales = impact_scales(law.normal, touch.reduced_mass, speed);
  }
  touch.energy_speed2 = speed * speed;
  touch.time_scale = std::numbers::pi * scales.time / std::max(1.0, scales.dissipation);
  if (const auto* viscous = std::get_if<ViscousForce>(&law.tangential);
      viscous && viscous->friction > 0 && viscous->damping > 0)
    touch.time_scale =
        std::min(touch.time_scale, 6 / (viscous->damping * touch.tangential_mobility));
}

void SoftBoxDynamics::evaluate(double t, const State& state, Rates& out) const {
  State& rate = out.rate;
  rate.bodies.resize(size());
  rate.bends.resize(touches.size());
  out.forces.resize(touches.size());
  rate.work = rate.dissipated = 0;
  for (const std::size_t i : moved) {
    const PlanarMotion& m = state.bodies[i];
    rate.bodies[i] = {m.vx, m.vz, 0, -scene_->hard.gravity, 0};
  }
  for (std::size_t c = 0; c < touches.size(); ++c) {
    const SoftTouch& touch = touches[c];
    const std::size_t i = touch.first, j = touch.partner;
    Forces& f = out.forces[c];
    f.at = meeting(i, j, t, state.bodies[i], state.bodies[j < size() ? j : i]);
    double elastic = 0;
    std::visit(
        [&](const auto& law) {
          f.normal = law(f.at.overlap, f.at.closing);
          elastic = law.elastic(f.at.overlap);
        },
        touch.law->normal);
    rate.bends[c] = 0;
    if (!touch.pushes) {
      f.tangential = 0;
      rate.dissipated -= elastic * f.at.closing;
      continue;
    }
    TangentialBranch branch = touch.branch;
    if (has_memory(touch.law->tangential))
      rate.bends[c] = bend_rate(touch.law->tangential, branch, f.normal, f.at.slip);
    else
      follow(touch.law->tangential, f.normal, std::abs(f.at.slip), branch);
    f.tangential =
        tangential_force(touch.law->tangential, branch, f.normal, f.at.slip, state.bends[c]);
    rate.dissipated += (f.normal - elastic) * f.at.closing - f.tangential * f.at.slip;
    const double fx = f.normal * f.at.nx + f.tangential * f.at.nz;
    const double fz = f.normal * f.at.nz - f.tangential * f.at.nx;
    const auto push = [&](std::size_t body, double sign) {
      const Inertia& in = inertia_[body];
      rate.bodies[body].vx += sign * fx * in.inverse_mass;
      rate.bodies[body].vz += sign * fz * in.inverse_mass;
      rate.bodies[body].w -= in.radius * f.tangential * in.inverse_inertia;
    };
    push(i, 1);
    if (j < size())
      push(j, -1);
    else
      rate.work += fz * f.at.surface_vz;
  }
  const Box& box = *scene_->hard.box;
  for (std::size_t c = 0; c < touches.size(); ++c) {
    Forces& f = out.forces[c];
    const std::size_t i = touches[c].first, j = touches[c].partner;
    const bool is_body = j < size();
    const PlanarMotion& a = rate.bodies[i];
    const double ax = a.vx - (is_body ? rate.bodies[j].vx : 0);
    double az = a.vz;
    if (is_body)
      az -= rate.bodies[j].vz;
    else if (j == surface(Face::floor) || box.moving_walls)
      az -= box.floor.acceleration(t);
    f.closing_rate = -(f.at.nx * ax + f.at.nz * az) - f.at.across * f.at.across / f.at.distance;
  }
}

void SoftBoxDynamics::add(const State& state, double h, const Rates& rates, State& sum) const {
  for (const std::size_t i : moved) sum.bodies[i] = state.bodies[i].plus(h, rates.rate.bodies[i]);
  for (std::size_t c = 0; c < touches.size(); ++c)
    sum.bends[c] = state.bends[c] + h * rates.rate.bends[c];
  sum.work = state.work + h * rates.rate.work;
  sum.dissipated = state.dissipated + h * rates.rate.dissipated;
}

void SoftBoxDynamics::step(double t, double h, const State& state, const Rates& now, State& after,
                           Rates& then) {
  for (State* s : {&stage_, &after}) {
    s->bodies.resize(size());
    s->bends.resize(touches.size());
  }
  add(state, 0.5 * h, now, stage_);
  evaluate(t + 0.5 * h, stage_, second_);
  add(state, 0.5 * h, second_, stage_);
  evaluate(t + 0.5 * h, stage_, third_);
  add(state, h, third_, stage_);
  evaluate(t + h, stage_, fourth_);
  add(state, h / 6, now, after);
  add(after, h / 3, second_, after);
  add(after, h / 3, third_, after);
  add(after, h / 6, fourth_, after);
  evaluate(t + h, after, then);
}

double SoftBoxDynamics::energy(double t, std::span<const PlanarMotion> bodies) const {
  double energy = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const Sphere& s = scene_->hard.bodies[i];
    const PlanarMotion& m = bodies[i];
    energy += 0.5 * s.mass * (m.vx * m.vx + m.vz * m.vz) + 0.5 * s.moment_of_inertia() * m.w * m.w +
              s.mass * scene_->hard.gravity * m.z;
  }
  for (const SoftTouch& c : touches)
    energy += elastic_energy(c.law->normal, meeting(c.first, c.partner, t, bodies[c.first],
                                                    bodies[c.partner < size() ? c.partner : 0])
                                                .overlap);
  return energy;
}

}  // namespace slipcheck
