#include "harness/observe/observer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "reference/events/event_solver.h"

namespace slipcheck {
namespace {

/// Linear between two frames.
Vector3 between(const Vector3& a, const Vector3& b, double fraction) {
  return a + fraction * (b - a);
}

/// The fastest that the scene's centres come together by: a spin alone brings nothing together, but
/// friction may turn some of it into speed.
double closing_scale_of(const Scene& scene, double speed_scale) {
  constexpr double kOfSpins = 1e-3;
  std::vector<BodyState> without_spin = scene.initial;
  for (BodyState& state : without_spin) state.angular_velocity.setZero();
  return std::max(slipcheck::speed_scale(scene, without_spin), kOfSpins * speed_scale);
}

}  // namespace

Observer::Observer(const Scene& scene, double step, double speed_scale, bool resolved,
                   std::vector<SpringSpeeds> springs)
    : scene_(&scene),
      step_(step),
      speed_scale_(speed_scale),
      closing_scale_(closing_scale_of(scene, speed_scale)),
      resolved_(resolved),
      on_surfaces_(!scene.surfaces.empty()),
      is_all_still_(
          scene.motion.is_still() &&
          std::ranges::all_of(scene.surfaces,
                              [](const Surface& surface) { return surface.motion.is_still(); })),
      springs_(std::move(springs)),
      bodies_(scene.bodies.size()) {
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    bodies_[i].zero = resolution(i, scene.on_substrate(i), scene.gravity);
}

Resolution Observer::resolution(std::size_t i, const SubstrateContact& c, double gravity) const {
  const double floor = (step_ > 0 ? kEngineNoise : kRoundOff) * speed_scale_;
  const double per_step = 0.5 * gravity * step_;
  // What pulls or shakes a body is left in its slip where an engine adds it after the friction.
  const double driven =
      0.5 * step_ * (scene_->downhill.norm() + scene_->motion.largest_acceleration());
  const Sphere& s = scene_->bodies[i];
  const double slip_per_step = per_step * (1 + s.inverse_shape_factor());
  // Rolling friction that is solved for after the sliding leaves its own step of slip.
  const double left = 2 * slip_per_step * c.rolling.largest_up_to(speed_scale_) + driven;
  Resolution zero;
  zero.left_slip = std::max(floor, left);
  zero.slip = std::max(floor, slip_per_step * c.kinetic_friction + left);
  if (resolved_ && step_ == 0) zero.slip = std::max(zero.slip, kIntegrationError * speed_scale_);
  if (c.coupled_radius > 0) zero.slip = std::max(zero.slip, kCoupledSlip * speed_scale_);
  zero.lasting_slip = zero.slip;
  // An engine's bodies move up and down by what gravity adds in a step.
  zero.rise = step_ > 0 ? std::max(kOfSceneSpeed * speed_scale_, scene_->gravity * step_)
                        : kRoundOff * speed_scale_;
  if (!springs_.empty()) {
    zero.slip = std::max(zero.slip, springs_[i].slip);
    zero.lasting_slip = std::max(zero.lasting_slip, kTurnedSpring * springs_[i].slip);
    zero.rise = std::max(zero.rise, springs_[i].rise);
  }
  zero.speed = std::max(floor, per_step * c.rolling(0));
  zero.spin = std::max(floor / s.radius,
                       per_step * c.drilling_length / (s.shape_factor * s.radius * s.radius));
  return zero;
}

// --- over the substrate --------------------------------------------------------------------------

void Observer::look_at_ground(double t0, double t1) {
  const SubstrateMotion& motion = scene_->motion;
  if (motion.is_still()) return;
  // A frame at a kink itself is one after it; the reference shows the one before it an instant
  // earlier.
  ground0_ = {motion.position(t0), motion.velocity(t0)};
  ground1_ = {motion.position(t1), motion.velocity(t1)};
}

Vector3 Observer::slip_of(std::size_t i, const BodyState& state, const Ground& ground) const {
  if (on_surfaces_) {
    const Vector3& up = bodies_[i].up;
    const Vector3 u = state.velocity + scene_->bodies[i].radius * up.cross(state.angular_velocity) -
                      ground.velocity;
    return u - up.dot(u) * up;
  }
  Vector3 slip = slip_velocity(state, scene_->bodies[i]) - ground.velocity;
  slip.z() = 0;
  return slip;
}

bool Observer::slips(std::size_t i, const BodyState& state, const Ground& ground) const {
  // A body that falls down a slope becomes faster than anything it began with.
  const double fastest =
      std::max(state.velocity.norm(), scene_->bodies[i].radius * state.angular_velocity.norm());
  const double noise = (step_ > 0 ? kEngineNoise : kRoundOff) * fastest;
  return slip_speed(i, state, ground) > std::max(bodies_[i].zero.slip, noise);
}

/// A rolling sphere that gravity and the substrate drive moves over the substrate with
/// A/(1+A) (a_G − a_S), K (22), (24), unless rolling friction μ_r g can take as much.
bool Observer::can_rest(std::size_t i, double time) const {
  if (on_surfaces_) {
    const Body& body = bodies_[i];
    const Vector3 g = scene_->gravity_vector();
    const double pressed = -body.up.dot(g);
    Vector3 drive = g + pressed * body.up;
    if (body.base == kSubstrate) drive -= scene_->motion.acceleration(time);
    const double A = scene_->bodies[i].inverse_shape_factor();
    const double hold = contact_with(i, body.base).rolling(0) * pressed;
    return A / (1 + A) * drive.norm() <= hold + 1e-9 * g.norm();
  }
  Vector3 drive = -scene_->motion.acceleration(time);
  drive.head<2>() += scene_->downhill;
  const double A = scene_->bodies[i].inverse_shape_factor();
  const double hold = scene_->on_substrate(i).rolling(0) * scene_->gravity;
  return A / (1 + A) * drive.norm() <= hold * (1 + 1e-9);
}

// --- frame by frame ------------------------------------------------------------------------------

bool Observer::touches_substrate(std::size_t i, double t1, const Frame& frame) const {
  if (bodies_[i].touched) return true;
  // A sleeping body of an engine is not solved for, and one that hops by less than what counts is
  // not at each step, yet they lie on the plane. One that falls at the top of a low jump does not.
  const BodyState& state = frame.bodies[i];
  const double radius = scene_->bodies[i].radius;
  const double above = on_surfaces_ ? gap(i, time_, state) : state.position.z() - radius;
  if (!(step_ > 0 && above < 1e-3 * radius)) return false;
  const double v0 = rise(bodies_[i], last_.bodies[i]), v1 = rise(bodies_[i], state);
  const bool falls = v0 - v1 > 0.5 * scene_->gravity * (t1 - time_);
  return std::abs(v1) < bodies_[i].zero.rise && !(bodies_[i].jumping && falls);
}

void Observer::take(double time, const Frame& frame) {
  if (!started_) {
    begin(time, frame);
    return;
  }
  const double t0 = time_, t1 = time;
  look_at_ground(t0, t1);
  for (Body& body : bodies_) body.touched = false;
  note_substrate(frame.touches, t1, frame.bodies);
  note_touches(t0, t1, frame);
  for (std::size_t i = 0; i < bodies_.size(); ++i) follow(i, t1, frame);
  for (Pair& pair : pairs_)
    if (has_settled(pair)) settle_effective_restitution(pair, t0, t1, frame);
  keep_frames_of_the_end();
  std::swap(before_last_, last_);
  time_before_ = t0;
  last_ = frame;
  time_ = t1;
  now_.bodies.clear();
}

bool Observer::take_partial(double time, const PartialFrame& frame) {
  if (!started_ || step_ > 0 || resolved_ || !is_all_still_) return false;
  if (now_.bodies.empty()) now_.bodies = last_.bodies;
  for (std::size_t k = 0; k < frame.bodies.size(); ++k) {
    now_.bodies[frame.bodies[k]] = frame.states[k];
    bodies_[frame.bodies[k]].touched = false;
  }
  now_.touches.assign(frame.touches.begin(), frame.touches.end());
  note_substrate(now_.touches, time, now_.bodies);
  note_touches(time_, time, now_);
  for (const std::size_t i : frame.bodies) {
    follow(i, time, now_);
    if (const std::size_t pair = bodies_[i].last_pair; pair != kNone) settling_.push_back(pair);
  }
  for (const std::size_t number : settling_) {
    Pair& pair = pairs_[number];
    if (!has_settled(pair)) continue;
    // The other may have met others since, too softly to count.
    for_bodies_of(pair, [&](std::size_t k) { now_.bodies[k] = frame.state_of(k); });
    settle_effective_restitution(pair, time_, time, now_);
  }
  for (const std::size_t i : frame.bodies) {
    before_last_.bodies[i] = last_.bodies[i];
    last_.bodies[i] = now_.bodies[i];
  }
  time_before_ = time_;
  time_ = time;
  return true;
}

void Observer::note_substrate(std::span<const Touch> touches, double t1,
                              std::span<const BodyState> now) {
  for (const Touch& touch : touches) {
    Body& body = bodies_[static_cast<std::size_t>(touch.first)];
    if (touch.second == (on_surfaces_ ? body.base : kSubstrate)) body.touched = true;
  }
  if (!on_surfaces_) return;
  // What a body touches once it has left what carried it.
  for (const Touch& touch : touches) {
    if (is_body(touch.second)) continue;
    const auto i = static_cast<std::size_t>(touch.first);
    if (!bodies_[i].touched) bodies_[i].touched = take_base(i, touch.second, t1, now[i]);
  }
}

void Observer::follow(std::size_t i, double t1, const Frame& frame) {
  Body& body = bodies_[i];
  const double t0 = std::exchange(body.seen, t1);
  if (on_surfaces_) look_at_ground_of(i, t0, t1, frame.bodies[i]);
  const bool touches = touches_substrate(i, t1, frame);
  follow_landing(body, i, frame);
  follow_flight(body, i, touches, t0, t1, frame);
  follow_support(body, touches, t0, t1, frame.bodies[i]);
  follow_sliding(body, i, t0, t1, frame);
  follow_stopping(body, i, t0, t1, frame);
  body.collided_now = false;
}

void Observer::begin(double time, const Frame& frame) {
  started_ = true;
  time_ = time_before_ = time;
  last_ = before_last_ = frame;
  look_at_ground(time, time);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    const BodyState& state = frame.bodies[i];
    body.seen = body.origin_time = time;
    if (on_surfaces_) {
      find_base(i, time, state);
      look_at_ground_of(i, time, time, state);
    }
    body.origin = position_over(state, ground1_);
    body.after = state;
    body.slide_end = time;
    const double radius = scene_->bodies[i].radius;
    const bool is_low = on_surfaces_ ? gap(i, time, state) <= 1e-9 * radius
                                     : state.position.z() <= radius * (1 + 1e-9);
    body.supported = is_low && !(rise(body, state) > body.zero.slip);
    if (body.supported) body.supported_steps = kSupportedSteps;
    if (!body.supported) {
      body.unsupported_since = time;
      body.unsupported_height = level(body, state);
      if (rise(body, state) > body.zero.rise) lift_off(body, time, state);
    }
    body.began_on_plane = body.supported;
    body.sliding = body.supported && slips(i, state, ground1_);
    if (body.supported && !body.sliding) {
      body.rolling_velocity = state.velocity;
      body.faint = step_ > 0 && slip_speed(i, state, ground1_) > body.zero.left_slip;
    }
    body.spinning = std::abs(spin(body, state)) > body.zero.spin;
    body.spun = body.spinning;
    body.resting = body.supported && !body.sliding && can_rest(i, time) &&
                   velocity_over(state, ground1_).norm() <= body.zero.speed;
    if (body.resting) {
      body.stop_time = time;
      body.stop_position = body.origin;
    }
  }
  begin_overlaps(time, frame);
}

// --- the end -------------------------------------------------------------------------------------

bool Observer::anything_slides_or_flies() const {
  return !std::ranges::all_of(bodies_, [this](const Body& body) { return rolls(body); });
}

bool Observer::rolls(const Body& body) const {
  return !body.sliding && !body.faint && body.supported &&
         (step_ == 0 || body.quiet_steps >= kQuietSteps || body.supported_steps >= kSupportedSteps);
}

bool Observer::everything_rests() const {
  return std::all_of(bodies_.begin(), bodies_.end(),
                     [](const Body& body) { return body.resting && !body.spinning; });
}

double Observer::last_slide_end() const {
  double last = 0;
  for (const Body& body : bodies_)
    last = std::max({last, body.slide_end, body.quiet_steps > 0 ? body.hop_end : 0});
  return last;
}

double Observer::last_stop() const {
  double last = 0;
  for (const Body& body : bodies_) {
    if (!std::isnan(body.stop_time)) last = std::max(last, body.stop_time);
    if (!std::isnan(body.spin_stop_time)) last = std::max(last, body.spin_stop_time);
  }
  return last;
}

void Observer::keep_frames_of_the_end() {
  if (step_ == 0) return;  // the reference ends with a frame
  const double end = last_slide_end();
  if (end > end_) {
    end_ = end;
    end_is_kept_ = false;
  } else if (!end_is_kept_) {
    end_before_ = before_last_;
    end_after_ = last_;
    end_time_before_ = time_before_;
    end_time_after_ = time_;
    end_is_kept_ = true;
  }
}

Observables Observer::finish(double end) const {
  // What comes after the end is no part of it, though a few frames were needed to tell.
  const bool is_kept = end_is_kept_ && end <= end_time_after_;
  const Frame& before = is_kept ? end_before_ : before_last_;
  const Frame& after = is_kept ? end_after_ : last_;
  const double t0 = is_kept ? end_time_before_ : time_before_;
  const double t1 = is_kept ? end_time_after_ : time_;
  const double fraction = t1 > t0 ? std::clamp((end - t0) / (t1 - t0), 0.0, 1.0) : 1;
  Observables seen;
  seen.bodies.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    BodyObservables& out = seen.bodies[i];
    if (!body.sliding && body.supported) {
      out.sliding_time = body.slide_time;
      out.sliding_distance = body.slide.norm();
      out.rolling_velocity = body.rolling_velocity;
      if (body.collided || body.began_on_plane)
        out.energy_change_sliding =
            body.after.velocity.squaredNorm() - body.rolling_velocity.squaredNorm();
      if (body.collided)
        out.momentum_change_sliding = (body.after.velocity - body.rolling_velocity).dot(body.away);
    }
    if (body.collided) {
      out.velocity_after_collision = body.after.velocity;
      out.slip_after_collision = body.slip_after;
      out.angular_velocity_after_collision = body.after.angular_velocity;
    }
    if (body.resting && !std::isnan(body.stop_time)) {
      out.stopping_time = body.stop_time - body.origin_time;
      out.stopping_distance = (body.stop_position - body.origin).norm();
    }
    if (body.spun && !body.spinning)
      out.spin_stopping_time = body.spin_stop_time - body.origin_time;
    out.lift_off_speed = body.lift_off_speed;
    out.flight_time = body.flight_time;
    if (!std::isnan(body.lift_off_speed) && (!body.jumping || rise(body, last_.bodies[i]) <= 0))
      out.jump_height = body.peak - body.lift_off_height;
    const BodyState &s0 = before.bodies[i], &s1 = after.bodies[i];
    out.final_position = between(s0.position, s1.position, fraction);
    out.final_velocity = between(s0.velocity, s1.velocity, fraction);
    out.final_angular_velocity = between(s0.angular_velocity, s1.angular_velocity, fraction);
    if (!std::isnan(body.landing_restitution))
      seen.pairs.push_back({.first = static_cast<int>(i),
                            .second = body.landed_on,
                            .restitution = body.landing_restitution});
  }
  for (const Pair& pair : pairs_) {
    if (!pair.collided) continue;
    PairObservables& out = seen.pairs.emplace_back();
    out.first = pair.first;
    out.second = pair.second;
    out.restitution = pair.restitution;
    out.tangential_restitution = pair.tangential_restitution;
    out.effective_restitution = pair.effective;
    // A hard pair in a scene of resolved ones collides at an instant.
    if (!resolved_ || !(pair.contact_time > 0)) continue;
    out.contact_time = pair.contact_time;
    out.max_overlap = pair.max_overlap;
    out.sliding_onset = pair.sliding_onset;
  }
  if (on_surfaces_ && bodies_.size() > 1) {
    double mass = 0, moment = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      mass += scene_->bodies[i].mass;
      moment += scene_->bodies[i].mass * seen.bodies[i].final_position.z();
    }
    seen.height = moment / mass;
  }
  std::sort(seen.pairs.begin(), seen.pairs.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  });
  return seen;
}

}  // namespace slipcheck
