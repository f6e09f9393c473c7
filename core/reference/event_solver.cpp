#include "reference/event_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "physics/collision.h"
#include "physics/polynomial_roots.h"

namespace slipcheck {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
using Kind = SubstratePhase::Kind;

}  // namespace

double speed_scale(const HardScene& scene, std::span<const BodyState> states) {
  double scale = scene.motion.largest_speed();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyState& s = states[i];
    const double radius = scene.bodies[i].radius;
    const double height = std::max(0.0, s.position.z() - radius);
    scale = std::max({scale, s.velocity.norm(), radius * s.angular_velocity.norm(),
                      std::sqrt(2 * scene.gravity * height),
                      std::sqrt(2 * scene.downhill.norm() * radius)});
  }
  return scale;
}

EventSolver::EventSolver(const HardScene& scene, std::span<const BodyState> initial,
                         const EventSettings& settings)
    : scene_(&scene), settings_(settings), bodies_(initial.size()) {
  const double scale = speed_scale(scene, initial);
  collapse_speed_ = settings.collapse_fraction * scale;
  landing_speed_ = settings.landing_fraction * scale;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    BodyState state = initial[i];
    const Sphere& sphere = scene.bodies[i];
    const bool touches = state.position.z() <= sphere.radius * (1 + 4 * kEpsilon);
    if (touches && state.velocity.z() < 0 && !scene.confined)
      land(sphere, scene.on_substrate(i), landing_speed_, state);
    set_state(i, state);
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) predict_for(i);
}

BodyState EventSolver::state_of(std::size_t i) const {
  return bodies_[i].phase.at(now_ - bodies_[i].start);
}

void EventSolver::set_state(std::size_t i, const BodyState& state) {
  bodies_[i].phase = SubstratePhase(scene_->bodies[i], scene_->on_substrate(i), scene_->gravity,
                                    state, scene_->confined);
  bodies_[i].start = now_;
}

std::vector<BodyState> EventSolver::states() const {
  std::vector<BodyState> states(bodies_.size());
  for (std::size_t i = 0; i < states.size(); ++i) states[i] = state_of(i);
  return states;
}

/// When two bodies collide if both stay in their present phases, or infinity.
double EventSolver::collision_time(std::size_t i, std::size_t j) const {
  const Moving& a = bodies_[i];
  const Moving& b = bodies_[j];
  if (a.phase.is_at_rest() && b.phase.is_at_rest()) return kNever;
  // The phases' own ends may come a rounding error late; a collision there must not be lost.
  const double end = std::min(a.phase_end(), b.phase_end());
  const double horizon = end - now_ + 4 * kEpsilon * (std::isfinite(end) ? end : 0);
  if (!a.phase.is_parabola() || !b.phase.is_parabola())
    return searched_collision_time(i, j, horizon);

  // |Δx + Δv t + ½ Δa t²|² − (R_i + R_j)²
  const BodyState si = state_of(i), sj = state_of(j);
  const Vector3 dx = si.position - sj.position;
  const Vector3 dv = si.velocity - sj.velocity;
  const Vector3 da = a.phase.acceleration() - b.phase.acceleration();
  const double contact = scene_->bodies[i].radius + scene_->bodies[j].radius;
  // The difference of squares as a product keeps its digits where the gap is small.
  const double distance = dx.norm();
  const Quartic gap = {(distance - contact) * (distance + contact), 2 * dx.dot(dv),
                       dv.squaredNorm() + dx.dot(da), dv.dot(da), 0.25 * da.squaredNorm()};
  return now_ + first_falling_root(gap, horizon);
}

/// The same where a path is not a parabola (rolling friction that depends on the speed). Since
/// gap(t + τ) >= gap − c τ − ½ B τ² with c the closing speed and B a bound of the relative
/// acceleration, steps to the root of that bound never pass a contact.
double EventSolver::searched_collision_time(std::size_t i, std::size_t j, double horizon) const {
  const Moving& a = bodies_[i];
  const Moving& b = bodies_[j];
  const auto largest_acceleration = [&](std::size_t k, const SubstratePhase& phase) {
    if (phase.is_parabola()) return phase.acceleration().norm();
    const double speed = phase.start().velocity.norm();
    return scene_->gravity * scene_->on_substrate(k).rolling.largest_up_to(speed);
  };
  const double bound = largest_acceleration(i, a.phase) + largest_acceleration(j, b.phase);
  const double contact = scene_->bodies[i].radius + scene_->bodies[j].radius;
  const double touching = 8 * kEpsilon * contact;
  double t = 0;
  while (t <= horizon) {
    const BodyState si = a.phase.at(now_ + t - a.start), sj = b.phase.at(now_ + t - b.start);
    const Vector3 dx = si.position - sj.position;
    const double distance = dx.norm();
    const double gap = distance - contact;
    const double closing = -dx.dot(si.velocity - sj.velocity) / distance;
    if (gap <= touching && closing > 0) return now_ + t;
    if (bound == 0 && closing <= 0) return kNever;
    // The positive root of ½ B τ² + c τ − gap = 0.
    const double open = std::max(gap, touching);
    const double root = std::sqrt(closing * closing + 2 * bound * open);
    const double step = closing > 0 ? 2 * open / (closing + root) : (root - closing) / bound;
    const double next = t + step;
    if (next == t) return closing > 0 ? now_ + t : kNever;
    t = next;
  }
  return kNever;
}

void EventSolver::predict_for(std::size_t i) {
  Moving& body = bodies_[i];
  body.next_collision = kNever;
  for (std::size_t j = 0; j < bodies_.size(); ++j) {
    if (j == i) continue;
    const double t = collision_time(i, j);
    if (t < body.next_collision) {
      body.next_collision = t;
      body.partner = j;
    }
  }
}

void EventSolver::predict_after_change(std::span<const std::size_t> changed) {
  const auto has_changed = [&](std::size_t j) {
    return std::find(changed.begin(), changed.end(), j) != changed.end();
  };
  for (std::size_t i : changed) predict_for(i);
  for (std::size_t j = 0; j < bodies_.size(); ++j) {
    if (has_changed(j)) continue;
    Moving& other = bodies_[j];
    if (other.next_collision < kNever && has_changed(other.partner)) {
      predict_for(j);
      continue;
    }
    for (std::size_t i : changed) {
      if (bodies_[i].next_collision >= kNever) continue;
      const double t = bodies_[i].partner == j ? bodies_[i].next_collision : collision_time(i, j);
      if (t < other.next_collision) {
        other.next_collision = t;
        other.partner = i;
      }
    }
  }
}

EventSolver::Event EventSolver::next_event() const {
  Event next{kNever, 0, false};
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].next_collision < next.time) next = {bodies_[i].next_collision, i, true};
    // At one instant the phase ends first: who collides there does so with a finished phase.
    if (bodies_[i].phase_end() < next.time ||
        (next.is_collision && bodies_[i].phase_end() == next.time))
      next = {bodies_[i].phase_end(), i, false};
  }
  return next;
}

double EventSolver::approach_speed(std::size_t i, std::size_t j) const {
  const BodyState si = state_of(i), sj = state_of(j);
  return -(si.position - sj.position).normalized().dot(si.velocity - sj.velocity);
}

double EventSolver::next_collision(double limit, double slowest) const {
  EventSolver ahead = *this;
  EventRun run;
  while (run.events < settings_.max_events) {
    const Event event = ahead.next_event();
    if (!(event.time <= limit)) return kNever;
    ahead.now_ = std::max(ahead.now_, event.time);
    if (event.is_collision &&
        (slowest == 0 ||
         ahead.approach_speed(event.body, ahead.bodies_[event.body].partner) >= slowest))
      return event.time;
    ++run.events;
    ahead.handle(event, nullptr, run);
  }
  return kNever;
}

double EventSolver::first_contact(double limit) const {
  EventSolver ahead = *this;
  EventRun run;
  while (true) {
    const Event event = ahead.next_event();
    if (!(event.time <= limit)) return kNever;
    if (event.is_collision || ahead.bodies_[event.body].phase.kind() == Kind::flying)
      return event.time;
    ahead.handle(event, nullptr, run);
  }
}

bool EventSolver::has_ended(const RunEnd& end) const {
  if (end.until == Run::Until::time) return false;
  bool collision_predicted = false, phase_will_end = false;
  for (const Moving& body : bodies_) {
    if (end.until == Run::Until::rest && !body.phase.is_at_rest()) return false;
    if (body.phase.kind() == Kind::flying || body.phase.kind() == Kind::sliding) return false;
    collision_predicted |= body.next_collision < kNever;
    phase_will_end |= body.phase_end() < kNever;
  }
  if (collision_predicted) return false;
  return !phase_will_end || next_collision(end.limit) == kNever;
}

EventRun EventSolver::run(const RunEnd& end, FrameSink* sink) {
  EventRun run;
  const bool to_a_time = end.until == Run::Until::time;
  const double last = to_a_time ? end.time : end.limit;
  show(sink);
  while (!has_ended(end)) {
    const Event event = next_event();
    if (!(event.time <= last) || run.events >= settings_.max_events) {
      if (run.events < settings_.max_events && std::isfinite(last)) now_ = std::max(now_, last);
      show(sink);
      run.end_time = now_;
      run.reached = to_a_time && run.events < settings_.max_events;
      if (run.events >= settings_.max_events)
        run.reason = "more than " + std::to_string(settings_.max_events) + " events";
      else if (!to_a_time)
        run.reason = end.until == Run::Until::rolling
                         ? "a body still slides or flies, or collides again, at the limit"
                         : "a body still moves at the limit";
      return run;
    }
    ++run.events;
    handle(event, sink, run);
  }
  run.end_time = now_;
  run.reached = true;
  return run;
}

void EventSolver::handle(const Event& event, FrameSink* sink, EventRun& run) {
  // A root may lie a rounding error before the last event; time never runs back.
  now_ = std::max(now_, event.time);
  if (event.is_collision)
    handle_collision(event.body, sink, run);
  else
    handle_phase_end(event.body, sink);
}

void EventSolver::handle_collision(std::size_t first, FrameSink* sink, EventRun& run) {
  const std::size_t second = bodies_[first].partner;
  const auto [i, j] = std::minmax(first, second);
  BodyState si = state_of(i), sj = state_of(j);
  show(sink);
  const CollisionResult result =
      collide(scene_->between(i, j), {scene_->confined, collapse_speed_},
              {scene_->bodies[i], scene_->on_substrate(i), si, bodies_[i].phase.is_supported()},
              {scene_->bodies[j], scene_->on_substrate(j), sj, bodies_[j].phase.is_supported()});
  ++run.collisions;
  if (result.impact_speed < collapse_speed_) ++run.collapses;
  set_state(i, si);
  set_state(j, sj);
  predict_after_change(std::array{i, j});
  if (sink) {
    frame_.touches.push_back(
        {static_cast<int>(i), static_cast<int>(j), std::max(result.impulse.norm(), 1e-300)});
    show(sink);
  }
}

void EventSolver::handle_phase_end(std::size_t i, FrameSink* sink) {
  Moving& body = bodies_[i];
  BodyState state = body.phase.at_end();
  if (body.phase.kind() == Kind::flying) {
    show(sink);
    land(scene_->bodies[i], scene_->on_substrate(i), landing_speed_, state);
    if (sink && state.velocity.z() > 0) frame_.touches.push_back(substrate_touch(i));
  }
  set_state(i, state);
  predict_after_change(std::array{i});
  show(sink);
}

/// That the body touches the substrate; frames of the reference do not say how hard.
Touch EventSolver::substrate_touch(std::size_t i) const {
  return {static_cast<int>(i), kSubstrate, scene_->bodies[i].mass};
}

/// Shows the state of all bodies now; a touch that is already in the frame stays.
void EventSolver::show(FrameSink* sink) {
  if (!sink) return;
  frame_.bodies.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    frame_.bodies[i] = state_of(i);
    if (bodies_[i].phase.is_supported()) frame_.touches.push_back(substrate_touch(i));
  }
  sink->take(now_, frame_);
  frame_.touches.clear();
}

}  // namespace slipcheck
