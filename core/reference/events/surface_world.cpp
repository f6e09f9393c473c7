#include "reference/events/surface_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "physics/numbers.h"
#include "reference/events/event_solver.h"

namespace slipcheck {

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
                           const LeastSpeeds& least, double now, bool may_show_part)
    : scene_(&scene),
      least_(least),
      slowest_(1e-12 * speed_scale(scene, initial)),
      bodies_(initial.size()),
      phases_(initial.size()),
      partial_(may_show_part ? initial.size() : 0) {
  const Vector3 gravity = scene.gravity_vector();
  if (scene.has_substrate) {
    const Surface plane{PlaneShape{},
                        SurfaceMotion::belt(scene.motion, Vector3::UnitX(), Vector3::UnitY())};
    places_.push_back(SurfacePlace(plane, kSubstrate, gravity));
  }
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k)
    places_.push_back(SurfacePlace(scene.surfaces[k], surface_touch(k), gravity));
  shows_part_ =
      may_show_part && scene.motion.is_still() &&
      std::ranges::all_of(places_, [](const SurfacePlace& place) {
        return place.surface.motion.is_still() && (!place.carries || place.downhill.isZero(0));
      });
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    BodyState state = initial[i];
    bodies_[i].support = find_support(i, state, now);
    meet_surfaces(i, state, now);
    start_path(i, state, now);
  }
}

SurfaceContact SurfaceWorld::contact_of(std::uint32_t i, std::size_t k) const {
  const SurfacePlace& place = places_[k];
  if (place.touch != kSubstrate) return scene_->on_surface(i, touched_surface(place.touch));
  const SubstrateContact& on = scene_->on_substrate(i);
  return {on, {on.restitution, on.kinetic_friction, 0}};
}

// --- paths ---------------------------------------------------------------------------------------

BodyState SurfaceWorld::path_state(std::uint32_t i, double now) const {
  const Body& body = bodies_[i];
  const double t = now - body.start;
  if (body.support != kNone) return places_[body.support].from_local(phases_[i].at(t));
  return {body.position + t * (body.velocity + (0.5 * t) * body.acceleration),
          body.velocity + t * body.acceleration, body.flight.angular_velocity};
}

BodyState SurfaceWorld::state_at(std::uint32_t i, double now) const { return path_state(i, now); }

PathPoint SurfaceWorld::on_path(std::uint32_t i, double now) const {
  const Body& body = bodies_[i];
  if (body.is_parabola) {
    const double t = now - body.start;
    return {body.position + t * (body.velocity + (0.5 * t) * body.acceleration),
            body.velocity + t * body.acceleration};
  }
  const BodyState state = path_state(i, now);
  return {state.position, state.velocity};
}

void SurfaceWorld::count(std::uint32_t i) {
  Body& body = bodies_[i];
  const bool flies = body.support == kNone;
  const bool slips = flies || phases_[i].kind() == DrivenPhase::Kind::sliding;
  const bool moves = flies || !phases_[i].is_at_rest();
  slipping_ += static_cast<std::size_t>(slips) - static_cast<std::size_t>(body.slips);
  moving_ += static_cast<std::size_t>(moves) - static_cast<std::size_t>(body.moves);
  body.slips = slips;
  body.moves = moves;
}

void SurfaceWorld::start_path(std::uint32_t i, const BodyState& state, double now) {
  Body& body = bodies_[i];
  body.support = find_support(i, state, now);
  body.start = now;
  body.path_end.reset();
  if (body.support == kNone) {
    body.flight = state;
    body.position = state.position;
    body.velocity = state.velocity;
    body.acceleration = scene_->gravity_vector();
    body.is_parabola = true;
    body.bound = body.acceleration.norm();
    body.end = kNever;
    count(i);
    return;
  }
  const SurfacePlace& place = places_[body.support];
  BodyState local = place.to_local(state);
  local.position.z() = scene_->bodies[i].radius;
  local.velocity.z() = 0;
  phases_[i] = DrivenPhase(scene_->bodies[i], contact_of(i, body.support).lasting, place.gravity,
                           place.downhill, place.motion, now, local, true);
  const DrivenPhase& phase = phases_[i];
  const BodyState start = place.from_local(phase.start());
  body.position = start.position;
  body.velocity = start.velocity;
  body.is_parabola = phase.is_parabola();
  body.acceleration =
      body.is_parabola ? Vector3(place.axes * phase.acceleration()) : Vector3::Zero();
  body.bound = body.is_parabola ? body.acceleration.norm() : phase.largest_acceleration();
  body.end = now + phase.duration();
  count(i);
}

/// The plane that carries the body: it touches, does not leave, and gravity presses it there.
std::size_t SurfaceWorld::find_support(std::uint32_t i, const BodyState& state, double now) const {
  std::size_t found = kNone;
  double most = 0;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (k == bodies_[i].left) continue;
    const SurfacePlace& place = places_[k];
    const SurfacePlace::Beside at =
        place.beside(scene_->bodies[i].radius, {state.position, state.velocity}, now);
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

// --- for whoever looks on ------------------------------------------------------------------------

void SurfaceWorld::add_support_touch(std::uint32_t i) {
  if (bodies_[i].support != kNone)
    frame_.touches.push_back(
        {static_cast<int>(i), places_[bodies_[i].support].touch, scene_->bodies[i].mass});
}

void SurfaceWorld::show(double now) {
  if (!sink_) return;
  frame_.bodies.resize(bodies_.size());
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    frame_.bodies[i] = state_at(i, now);
    add_support_touch(i);
  }
  sink_->take(now, frame_);
  frame_.touches.clear();
  partial_.note_whole();
}

void SurfaceWorld::show_changed(std::span<const std::uint32_t> changed, double now) {
  if (!sink_) return;
  if (shows_part_ &&
      partial_.show(
          *sink_, changed, now, frame_.touches, [&](std::uint32_t i) { return state_at(i, now); },
          [&](std::uint32_t i) { add_support_touch(i); }))
    return;
  show(now);
}

}  // namespace slipcheck
