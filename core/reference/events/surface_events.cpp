#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/contact/collision.h"
#include "physics/motion/substrate_phase.h"
#include "physics/numbers.h"
#include "reference/events/surface_world.h"

// What happens to bodies of SurfaceWorld: impacts on surfaces and on each other, edges.

namespace slipcheck {
namespace {

/// So many impacts of one body at one instant come to no end.
constexpr int kMostAtOnce = 1000;

/// What does not give way, with its surface at a point.
Sphere immovable() { return {1, kNever, 1}; }

}  // namespace

void SurfaceWorld::end_path(std::uint32_t i, double now) {
  Body& body = bodies_[i];
  const std::array<std::uint32_t, 1> changed = {i};
  ++events_;
  body.left = kNone;
  BodyState state = body.next == Own::phase ? places_[body.support].from_local(phases_[i].at_end())
                                            : path_state(i, now);
  switch (body.next) {
    case Own::phase:
      break;
    case Own::hit: {
      const SurfacePlace::Beside at =
          places_[body.hit].beside(scene_->bodies[i].radius, {state.position, state.velocity}, now);
      if (at.gap > touching(i)) break;  // a search that gave up
      show_changed(changed, now);
      const bool is_pressed = body.support != kNone && at.near.normal.dot(body.acceleration) < 0;
      if (at.opening >= -(is_pressed ? slowest_hop(i, at.near.point) : slowest_))
        give_up(i, now, "is pressed against two surfaces");
      hit_surface(i, body.hit, state, now);
      meet_surfaces(i, state, now);
      break;
    }
    case Own::edge:
      leave_edge(i, state, now);
      break;
  }
  start_path(i, state, now);
  show_changed(changed, now);
}

double SurfaceWorld::slowest_hop(std::uint32_t i, const Vector3& at) const {
  const double rounding = 16 * kEpsilon * (at.norm() + scene_->bodies[i].radius);
  return std::max(slowest_, std::sqrt(2 * scene_->gravity_vector().norm() * rounding));
}

void SurfaceWorld::meet_surfaces(std::uint32_t i, BodyState& state, double now) {
  for (int n = 0; n < kMostAtOnce; ++n) {
    std::size_t next = kNone;
    double fastest = -slowest_;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const SurfacePlace::Beside at =
          places_[k].beside(scene_->bodies[i].radius, {state.position, state.velocity}, now);
      if (at.gap > touching(i) || at.opening >= fastest) continue;
      fastest = at.opening;
      next = k;
    }
    if (next == kNone) return;
    hit_surface(i, next, state, now);
  }
  give_up(i, now, "is between surfaces that hit it without end");
}

void SurfaceWorld::hit_surface(std::uint32_t i, std::size_t k, BodyState& state, double now) {
  const Sphere& sphere = scene_->bodies[i];
  const SurfacePlace& place = places_[k];
  const SurfacePlace::Beside at =
      place.beside(scene_->bodies[i].radius, {state.position, state.velocity}, now);
  const Vector3 matter = place.surface.motion.velocity(now, at.near.point);
  SurfaceContact contact = contact_of(i, k);
  const double speed = -at.near.normal.dot(state.velocity - matter);
  double restitution = restitution_at(contact.impact.restitution, std::max(speed, slowest_));
  if (restitution * speed < std::max(least_.landing, slowest_hop(i, at.near.point)))
    restitution = 0;
  state.position = at.near.point + sphere.radius * at.near.normal;
  contact.impact.restitution = contact.lasting.restitution = restitution;

  const std::size_t support = bodies_[i].support;
  const bool is_held = support != kNone && support != k;
  const Matrix3 axes = is_held ? places_[support].axes : axes_about(at.near.normal);
  const Matrix3 back = axes.transpose();
  // As seen from what carries the body, or else from what it hits.
  const Vector3 frame =
      is_held ? places_[support].surface.motion.velocity(now, state.position) : matter;
  BodyState local{Vector3::Zero(), back * (state.velocity - frame), back * state.angular_velocity};
  double impulse = 0;
  if (!is_held && contact.impact.tangential_restitution == 0) {
    const double before = local.velocity.z();
    land(sphere, contact.lasting, 0, local);
    impulse = sphere.mass * (local.velocity.z() - before);
  } else {
    BodyState other;
    other.position = -back * at.near.normal;
    other.velocity = back * (matter - frame);
    const Sphere wall = immovable();
    const SubstrateContact none;
    const SubstrateContact carrying = is_held ? contact_of(i, support).lasting : none;
    const CollidingBody first{sphere, carrying, local, is_held && local.velocity.z() <= slowest_};
    const CollidingBody second{wall, none, other, false};
    impulse = slipcheck::collide(contact.impact, {}, first, second).impulse.norm();
  }
  state.velocity = frame + axes * local.velocity;
  state.angular_velocity = axes * local.angular_velocity;
  if (is_held && local.velocity.z() > slowest_) bodies_[i].support = kNone;
  if (!is_held) bodies_[i].support = restitution == 0 && place.carries ? k : kNone;
  ++landings_;
  last_impact_speed_ = speed;
  bodies_[i].hardest_impact = std::max(bodies_[i].hardest_impact, speed);
  if (sink_)
    frame_.touches.push_back({static_cast<int>(i), place.touch, std::max(impulse, 1e-300)});
}

/// Beyond the edge the centre would have to turn about it with v²/R.
void SurfaceWorld::leave_edge(std::uint32_t i, const BodyState& state, double now) {
  const SurfacePlace& place = places_[bodies_[i].support];
  const Vector3 local = place.axes.transpose() * (state.position - place.origin);
  const Vector3 velocity = place.axes.transpose() * state.velocity;
  for (int axis = 0; axis < 2; ++axis) {
    if (std::abs(local[axis]) < place.half[axis] || local[axis] * velocity[axis] <= 0) continue;
    // Another plane may go on where this one ends.
    for (std::size_t k = 0; k < places_.size(); ++k) {
      if (k == bodies_[i].support || !places_[k].carries) continue;
      const SurfacePlace::Beside at =
          places_[k].beside(scene_->bodies[i].radius, {state.position, state.velocity}, now);
      if (at.gap <= touching(i) && at.near.normal.dot(place.axes.col(2)) > 1 - 1e-12) return;
    }
    const double turning = velocity[axis] * velocity[axis] / scene_->bodies[i].radius;
    if (turning < place.gravity) give_up(i, now, "turns about the edge of a plate");
    bodies_[i].left = bodies_[i].support;
  }
}

std::span<const std::uint32_t> SurfaceWorld::collide(std::uint32_t i, std::uint32_t j, double now) {
  changed_.assign({std::min(i, j), std::max(i, j)});
  BodyState states[2] = {path_state(changed_[0], now), path_state(changed_[1], now)};
  const double contact = scene_->bodies[i].radius + scene_->bodies[j].radius;
  if ((states[0].position - states[1].position).norm() > (1 + 1e-9) * contact) return changed_;
  ++events_;
  show_changed(changed_, now);
  // Seen from what carries the one, which takes its part; what carries the other alone is hit by it
  // afterwards.
  const std::size_t on[2] = {bodies_[changed_[0]].support, bodies_[changed_[1]].support};
  const std::size_t common = on[0] != kNone ? on[0] : on[1];
  const Matrix3 axes = common == kNone ? Matrix3(Matrix3::Identity()) : places_[common].axes;
  const Vector3 frame = common == kNone
                            ? Vector3(Vector3::Zero())
                            : places_[common].surface.motion.velocity(now, states[0].position);
  const auto change = [&](BodyState& s, bool back) {
    if (back) {
      s.position = axes * s.position;
      s.velocity = frame + axes * s.velocity;
      s.angular_velocity = axes * s.angular_velocity;
    } else {
      s.position = axes.transpose() * s.position;
      s.velocity = axes.transpose() * (s.velocity - frame);
      s.angular_velocity = axes.transpose() * s.angular_velocity;
    }
  };
  const Vector3 places[2] = {states[0].position, states[1].position};
  for (BodyState& state : states) change(state, false);
  const SubstrateContact none;
  const auto carrying = [&](int k) {
    return on[k] == common && common != kNone ? contact_of(changed_[k], common).lasting : none;
  };
  const SubstrateContact below[2] = {carrying(0), carrying(1)};
  const auto colliding = [&](int k) {
    return CollidingBody{scene_->bodies[changed_[k]], below[k], states[k],
                         common != kNone && on[k] == common && states[k].velocity.z() <= slowest_};
  };
  const CollisionRule rule{false,
                           least_.rebound_of(bodies_[i].hardest_impact, bodies_[j].hardest_impact)};
  const CollisionResult result =
      scene_->collide(changed_[0], changed_[1], rule, colliding(0), colliding(1));
  for (int k = 0; k < 2; ++k) {
    change(states[k], true);
    states[k].position = places[k];
  }
  ++collisions_;
  if (result.altered) ++collapses_;
  last_impact_speed_ = result.impact_speed;
  if (sink_)
    frame_.touches.push_back({static_cast<int>(changed_[0]), static_cast<int>(changed_[1]),
                              std::max(result.impulse.norm(), 1e-300)});
  if (shows_part_) partial_.note_collision(changed_[0], changed_[1]);
  for (int k = 0; k < 2; ++k) {
    const std::uint32_t body = changed_[k];
    bodies_[body].left = kNone;
    if (result.altered) ++bodies_[body].collapses;
    bodies_[body].hardest_impact = std::max(bodies_[body].hardest_impact, result.impact_speed);
    bodies_[body].support = find_support(body, states[k], now);
    meet_surfaces(body, states[k], now);
    start_path(body, states[k], now);
  }
  show_changed(changed_, now);
  // The more there are, the longer do two have to be pressed together for contacts that last, in
  // steps of all bodies, to be worth their while.
  const std::size_t most_collapses = 10'000 + 100 * bodies_.size();
  if (std::max(bodies_[i].collapses, bodies_[j].collapses) > most_collapses)
    give_up(i, now, fmt::format("stays in contact with body {}", j));
  return changed_;
}

void SurfaceWorld::give_up(std::uint32_t i, double now, const std::string& why) const {
  throw LastingContacts(
      fmt::format("at {:.9g} s body {} {}, which collisions at instants cannot show", now, i, why));
}

}  // namespace slipcheck
