#include "reference/events/surface_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/contact/collision.h"
#include "physics/motion/substrate_phase.h"
#include "physics/numbers.h"
#include "physics/safe_root.h"
#include "reference/events/event_solver.h"
#include "reference/events/path_collision.h"

namespace slipcheck {
namespace {

/// So many impacts of one body at one instant come to no end.
constexpr int kMostAtOnce = 1000;

Matrix3 axes_of(const Vector3& normal) {
  if (normal == kUp) return Matrix3::Identity();
  Matrix3 axes;
  axes.col(2) = normal;
  axes.col(0) = normal.unitOrthogonal();
  axes.col(1) = normal.cross(axes.col(0));
  return axes;
}

/// The course of a surface's matter along two axes of a plane.
SubstrateMotion course_along(const SurfaceMotion& motion, const Matrix3& axes) {
  const auto along = [&](const Vector2& v) -> Vector2 {
    return (axes.transpose() * (v.x() * motion.first() + v.y() * motion.second())).head<2>();
  };
  const SubstrateMotion& course = motion.course();
  switch (course.kind()) {
    case SubstrateMotion::Kind::still:
      break;
    case SubstrateMotion::Kind::constant:
      return SubstrateMotion::constant(along(course.vector()));
    case SubstrateMotion::Kind::oscillation:
      return SubstrateMotion::oscillation(along(course.vector()), course.frequency(),
                                          course.phase());
    case SubstrateMotion::Kind::table: {
      std::vector<SubstrateMotion::Point> points = course.points();
      for (SubstrateMotion::Point& point : points) point.position = along(point.position);
      return SubstrateMotion::table(std::move(points));
    }
  }
  return {};
}

bool is_along(const SurfaceMotion& motion, const Vector3& normal) {
  constexpr double kRightAngle = 1e-9;
  const Vector2& vector = motion.course().vector();
  const Vector3 way = vector.x() * motion.first() + vector.y() * motion.second();
  const bool table = motion.course().kind() == SubstrateMotion::Kind::table;
  return table ? std::abs(normal.dot(motion.first())) + std::abs(normal.dot(motion.second())) <=
                     kRightAngle
               : std::abs(normal.dot(way)) <= kRightAngle * way.norm();
}

/// What does not give way, with its surface at a point.
Sphere immovable() { return {1, kNever, 1}; }

}  // namespace

std::string SurfaceWorld::obstacle(const Scene& scene) {
  if (!scene.periodic.isZero(0)) return "a periodic plane beside surfaces";
  const auto is_odd = [](const SubstrateContact& contact) { return !DrivenPhase::can(contact); };
  if ((scene.has_substrate && std::ranges::any_of(scene.substrate, is_odd)) ||
      std::ranges::any_of(scene.on_surfaces,
                          [&](const SurfaceContact& each) { return is_odd(each.lasting); }))
    return "drilling coupled to the sliding, or rolling friction of sliding bodies";
  for (const Surface& surface : scene.surfaces) {
    const Vector3& rate = surface.motion.rate();
    if (rate.isZero(0)) continue;
    const auto keeps = [&](const auto& shape) {
      using Kind = std::decay_t<decltype(shape)>;
      const Vector3 axis = rate.normalized();
      const auto is_on_axis = [&](const Vector3& at) {
        return axis.cross(at - surface.motion.pivot()).norm() <= 1e-9 * at.norm();
      };
      if constexpr (std::is_same_v<Kind, PlaneShape>) return true;  // about its normal
      if constexpr (std::is_same_v<Kind, RodShape>)
        return is_on_axis(shape.begin) && is_on_axis(shape.end);
      if constexpr (std::is_same_v<Kind, BallShape>) return is_on_axis(shape.centre);
      return false;
    };
    if (!std::visit(keeps, surface.shape)) return "a surface that turns out of its place";
  }
  return "";
}

SurfaceWorld::SurfaceWorld(const Scene& scene, std::span<const BodyState> initial,
                           const LeastSpeeds& least, double now)
    : scene_(&scene),
      least_(least),
      slowest_(1e-12 * speed_scale(scene, initial)),
      bodies_(initial.size()),
      phases_(initial.size()) {
  if (scene.has_substrate) {
    const Surface plane{PlaneShape{},
                        SurfaceMotion::belt(scene.motion, Vector3::UnitX(), Vector3::UnitY())};
    places_.push_back(place_of(plane, kSubstrate));
  }
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k)
    places_.push_back(place_of(scene.surfaces[k], surface_touch(k)));
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    BodyState state = initial[i];
    bodies_[i].support = find_support(i, state, now);
    meet_surfaces(i, state, now);
    start_path(i, state, now);
  }
}

auto SurfaceWorld::place_of(const Surface& surface, int touch) const -> Place {
  Place place;
  place.surface = surface;
  place.touch = touch;
  place.bend = surface.motion.is_belt() ? 0 : surface.motion.course().largest_acceleration();
  const Vector3 gravity = scene_->gravity_vector();
  const auto lay = [&](const Matrix3& axes, const Vector3& origin) {
    place.axes = axes;
    place.origin = origin;
    place.motion = course_along(surface.motion, axes);
    const Vector3 local = axes.transpose() * gravity;
    place.gravity = -local.z();
    place.downhill = local.head<2>();
    place.carries = surface.motion.rate().isZero(0) && is_along(surface.motion, axes.col(2));
  };
  if (const auto* plane = std::get_if<PlaneShape>(&surface.shape)) {
    lay(axes_of(plane->normal), plane->point);
  } else if (const auto* plate = std::get_if<RectangleShape>(&surface.shape)) {
    // That face which is above.
    Matrix3 axes;
    axes.col(0) = plate->half_length.normalized();
    axes.col(1) = plate->half_width.normalized();
    axes.col(2) = axes.col(0).cross(axes.col(1));
    if (axes.col(2).dot(gravity) > 0) axes.rightCols<2>() *= -1;
    lay(axes, plate->centre);
    place.half = {plate->half_length.norm(), plate->half_width.norm()};
    const bool stays = surface.motion.is_still() || surface.motion.is_belt();
    place.carries = place.carries && stays;
  }
  place.carries = place.carries && place.gravity > 0;
  return place;
}

SurfaceContact SurfaceWorld::contact_of(std::uint32_t i, std::size_t k) const {
  const Place& place = places_[k];
  if (place.touch != kSubstrate) return scene_->on_surface(i, touched_surface(place.touch));
  const SubstrateContact& on = scene_->on_substrate(i);
  return {on, {on.restitution, on.kinetic_friction, 0}};
}

Vector3 SurfaceWorld::place_velocity(const Place& place, double now, const Vector3& at) const {
  const SurfaceMotion& motion = place.surface.motion;
  // What turns here turns in its place.
  if (motion.is_belt() || !motion.rate().isZero(0)) return Vector3::Zero();
  return motion.velocity(now, at);
}

auto SurfaceWorld::beside(std::uint32_t i, const Place& place, const Point& body, double now) const
    -> Beside {
  Beside found;
  found.near = place.surface.nearest(now, body.position);
  found.gap = found.near.distance - scene_->bodies[i].radius;
  found.opening =
      found.near.normal.dot(body.velocity - place_velocity(place, now, found.near.point));
  return found;
}

// --- paths ---------------------------------------------------------------------------------------

BodyState SurfaceWorld::to_local(const Place& place, const BodyState& state) const {
  const Matrix3 back = place.axes.transpose();
  return {back * (state.position - place.origin), back * state.velocity,
          back * state.angular_velocity};
}

BodyState SurfaceWorld::from_local(const Place& place, const BodyState& state) const {
  return {place.origin + place.axes * state.position, place.axes * state.velocity,
          place.axes * state.angular_velocity};
}

BodyState SurfaceWorld::path_state(std::uint32_t i, double now) const {
  const Body& body = bodies_[i];
  const double t = now - body.start;
  if (body.support != kNone) return from_local(places_[body.support], phases_[i].at(t));
  return {body.position + t * (body.velocity + (0.5 * t) * body.acceleration),
          body.velocity + t * body.acceleration, body.flight.angular_velocity};
}

BodyState SurfaceWorld::state_at(std::uint32_t i, double now) const { return path_state(i, now); }

auto SurfaceWorld::on_path(std::uint32_t i, double now) const -> Point {
  const Body& body = bodies_[i];
  if (body.is_parabola) {
    const double t = now - body.start;
    return {body.position + t * (body.velocity + (0.5 * t) * body.acceleration),
            body.velocity + t * body.acceleration};
  }
  const BodyState state = path_state(i, now);
  return {state.position, state.velocity};
}

void SurfaceWorld::start_path(std::uint32_t i, BodyState state, double now) {
  Body& body = bodies_[i];
  body.support = find_support(i, state, now);
  body.start = now;
  if (body.support == kNone) {
    body.flight = state;
    body.position = state.position;
    body.velocity = state.velocity;
    body.acceleration = scene_->gravity_vector();
    body.is_parabola = true;
    body.bound = body.acceleration.norm();
    body.end = kNever;
    return;
  }
  const Place& place = places_[body.support];
  BodyState local = to_local(place, state);
  local.position.z() = scene_->bodies[i].radius;
  local.velocity.z() = 0;
  phases_[i] = DrivenPhase(scene_->bodies[i], contact_of(i, body.support).lasting, place.gravity,
                           place.downhill, place.motion, now, local, true);
  const DrivenPhase& phase = phases_[i];
  const BodyState start = from_local(place, phase.start());
  body.position = start.position;
  body.velocity = start.velocity;
  body.is_parabola = phase.is_parabola();
  body.acceleration =
      body.is_parabola ? Vector3(place.axes * phase.acceleration()) : Vector3::Zero();
  body.bound = body.is_parabola ? body.acceleration.norm() : phase.largest_acceleration();
  body.end = now + phase.duration();
}

/// The plane that carries the body: it touches, does not leave, and gravity presses it there.
std::size_t SurfaceWorld::find_support(std::uint32_t i, const BodyState& state, double now) const {
  std::size_t found = kNone;
  double most = 0;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (k == bodies_[i].left) continue;
    const Place& place = places_[k];
    const Beside at = beside(i, place, {state.position, state.velocity}, now);
    if (at.gap > touching(i) || at.opening > slowest_) continue;
    const double pressed = -at.near.normal.dot(scene_->gravity_vector());
    if (!(pressed > 0)) continue;
    const bool is_face = place.carries && at.near.normal.dot(place.axes.col(2)) > 1 - 1e-12;
    if (!is_face) {
      if (at.opening < -slowest_) continue;  // yet to be hit
      give_up(i, now, "lies on something that is no plane at rest or along itself");
    }
    // Of two that meet where it lies, that which carries more of it; the other is beside it.
    if (pressed > most * (1 + 1e-12)) {
      most = pressed;
      found = k;
    }
  }
  return found;
}

// --- what comes next -----------------------------------------------------------------------------

double SurfaceWorld::own_event_time(std::uint32_t i, double now) {
  Body& body = bodies_[i];
  body.next = Own::phase;
  body.hit = kNone;
  double first = body.end;
  const auto horizon = [&] { return first - now; };
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (k == body.support) continue;
    const double t = now + first_hit(i, k, now, horizon());
    if (!(t < first)) continue;
    first = t;
    body.next = Own::hit;
    body.hit = k;
  }
  if (body.support != kNone && places_[body.support].half.x() > 0) {
    const double t = now + first_edge(i, now, horizon());
    if (t < first) {
      first = t;
      body.next = Own::edge;
    }
  }
  return first;
}

/// In what time [s] the body comes to a surface, or infinity where not within `horizon`. Steps that
/// pass no contact: the distance to what is convex bends towards zero by no more than the relative
/// acceleration, and that to a plane along a parabola by its part across.
double SurfaceWorld::first_hit(std::uint32_t i, std::size_t k, double now, double horizon) const {
  constexpr int kMostSteps = 10'000;
  const Body& body = bodies_[i];
  const Place& place = places_[k];
  const double least = 8 * kEpsilon * scene_->bodies[i].radius;
  double bound = body.bound + place.bend;
  const auto* plane = std::get_if<PlaneShape>(&place.surface.shape);
  if (plane && body.is_parabola && place.bend == 0)
    bound = std::max(0.0, -plane->normal.dot(body.acceleration));
  double t = 0;
  for (int n = 0; n < kMostSteps && t <= horizon; ++n) {
    const Beside at = beside(i, place, on_path(i, now + t), now + t);
    if (at.gap <= touching(i) && std::abs(at.opening) <= slowest_) {
      // It goes along the surface.
      if (!body.is_parabola || place.bend > 0 || k == body.left) {
        t += bound > 0 ? std::sqrt(2e-6 * scene_->bodies[i].radius / bound) : kNever;
        continue;
      }
      const double push = at.near.normal.dot(body.acceleration);
      return push < -1e-9 * std::max(body.bound, scene_->gravity_vector().norm()) ? t : kNever;
    }
    if (at.gap <= least && at.opening < 0) return t;
    const double step = step_to_bound(std::max(at.gap, least), at.opening, bound);
    if (step == kNever) return kNever;
    if (t + step == t) return at.opening < 0 ? t : kNever;
    t += step;
  }
  return t <= horizon ? t : kNever;
}

/// In what time [s] the body's centre passes an edge of the plate that carries it.
double SurfaceWorld::first_edge(std::uint32_t i, double now, double horizon) const {
  const Place& place = places_[bodies_[i].support];
  double first = kNever;
  for (int axis = 0; axis < 2; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const Vector3 outward = side * place.axes.col(axis);
      const double beyond = place.half[axis] + 1e-3 * touching(i);
      const auto left = [&](double t, double& slope) {
        const Point at = on_path(i, now + t);
        slope = -outward.dot(at.velocity);
        return beyond - outward.dot(at.position - place.origin);
      };
      double slope = 0;
      if (left(0, slope) <= 0 && slope >= 0) continue;  // it comes back
      const double t = first_zero(left, bodies_[i].bound, std::min(horizon, first));
      first = std::min(first, t);
    }
  return first;
}

double SurfaceWorld::collision_time(std::uint32_t i, std::uint32_t j, double now,
                                    const CellGrid::Shift&) const {
  const Body &a = bodies_[i], &b = bodies_[j];
  const auto is_at_rest = [&](std::uint32_t k) {
    return bodies_[k].support != kNone && phases_[k].is_at_rest() && bodies_[k].velocity.isZero(0);
  };
  if (is_at_rest(i) && is_at_rest(j)) return kNever;
  const double end = std::min(a.end, b.end);
  const double horizon = end - now + 4 * kEpsilon * (std::isfinite(end) ? end : 0);
  const double contact = scene_->bodies[i].radius + scene_->bodies[j].radius;
  if (a.is_parabola && b.is_parabola) {
    const Point at_a = on_path(i, now), at_b = on_path(j, now);
    return now + time_to_touch(at_a.position - at_b.position, at_a.velocity - at_b.velocity,
                               a.acceleration - b.acceleration, contact, horizon);
  }
  constexpr int kManySteps = 64;
  const double least = 8 * kEpsilon * contact;
  double t = 0;
  for (int n = 0; t <= horizon; ++n) {
    const Point at_a = on_path(i, now + t), at_b = on_path(j, now + t);
    const Vector3 dx = at_a.position - at_b.position;
    const double distance = dx.norm(), gap = distance - contact;
    const double opening = dx.dot(at_a.velocity - at_b.velocity) / distance;
    if (gap <= least && opening < 0) return now + t;
    const double step = step_to_bound(std::max(gap, least), opening, a.bound + b.bound);
    if (step == kNever) return kNever;
    if (n >= kManySteps && gap > 1e-8 * contact) return now + t;
    if (t + step == t) return opening < 0 ? now + t : kNever;
    t += step;
  }
  return kNever;
}

// --- events --------------------------------------------------------------------------------------

BodyChange SurfaceWorld::do_own_event(std::uint32_t i, double now) {
  Body& body = bodies_[i];
  ++events_;
  body.left = kNone;
  BodyState state = body.next == Own::phase ? from_local(places_[body.support], phases_[i].at_end())
                                            : path_state(i, now);
  switch (body.next) {
    case Own::phase:
      break;
    case Own::hit: {
      const Beside at = beside(i, places_[body.hit], {state.position, state.velocity}, now);
      if (at.gap > touching(i)) break;  // a search that gave up
      show(now);
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
  show(now);
  return BodyChange::path;
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
      const Beside at = beside(i, places_[k], {state.position, state.velocity}, now);
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
  const Place& place = places_[k];
  const Beside at = beside(i, place, {state.position, state.velocity}, now);
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
  const Matrix3 axes = is_held ? places_[support].axes : axes_of(at.near.normal);
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
  bodies_[i].hardest_impact = std::max(bodies_[i].hardest_impact, speed);
  if (sink_)
    frame_.touches.push_back({static_cast<int>(i), place.touch, std::max(impulse, 1e-300)});
}

/// Beyond the edge the centre would have to turn about it with v²/R.
void SurfaceWorld::leave_edge(std::uint32_t i, const BodyState& state, double now) {
  const Place& place = places_[bodies_[i].support];
  const Vector3 local = place.axes.transpose() * (state.position - place.origin);
  const Vector3 velocity = place.axes.transpose() * state.velocity;
  for (int axis = 0; axis < 2; ++axis) {
    if (std::abs(local[axis]) < place.half[axis] || local[axis] * velocity[axis] <= 0) continue;
    // Another plane may go on where this one ends.
    for (std::size_t k = 0; k < places_.size(); ++k) {
      if (k == bodies_[i].support || !places_[k].carries) continue;
      const Beside at = beside(i, places_[k], {state.position, state.velocity}, now);
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
  show(now);
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
  for (int k = 0; k < 2; ++k) {
    const std::uint32_t body = changed_[k];
    bodies_[body].left = kNone;
    bodies_[body].last_collision = now;
    bodies_[body].hardest_impact = std::max(bodies_[body].hardest_impact, result.impact_speed);
    bodies_[body].support = find_support(body, states[k], now);
    meet_surfaces(body, states[k], now);
    start_path(body, states[k], now);
  }
  show(now);
  constexpr std::size_t kMostCollapses = 10'000;
  if (collapses_ > kMostCollapses) give_up(i, now, fmt::format("stays in contact with body {}", j));
  return changed_;
}

void SurfaceWorld::give_up(std::uint32_t i, double now, const std::string& why) const {
  throw LastingContacts(
      fmt::format("at {:.9g} s body {} {}, which collisions at instants cannot show", now, i, why));
}

// --- for whoever looks on ------------------------------------------------------------------------

bool SurfaceWorld::is_any_slipping() const {
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (bodies_[i].support == kNone || phases_[i].kind() == DrivenPhase::Kind::sliding) return true;
  return false;
}

bool SurfaceWorld::is_any_moving() const {
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (bodies_[i].support == kNone || !phases_[i].is_at_rest()) return true;
  return false;
}

std::vector<std::string> SurfaceWorld::features() const {
  return {"phases on the plane that carries a body, impacts on the other surfaces",
          "all pairs, a scan for the next event"};
}

void SurfaceWorld::show(double now) {
  if (!sink_) return;
  frame_.bodies.resize(bodies_.size());
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    frame_.bodies[i] = state_at(i, now);
    if (bodies_[i].support != kNone)
      frame_.touches.push_back(
          {static_cast<int>(i), places_[bodies_[i].support].touch, scene_->bodies[i].mass});
  }
  sink_->take(now, frame_);
  frame_.touches.clear();
}

}  // namespace slipcheck
