#include "harness/observer.h"

#include <algorithm>
#include <cmath>

namespace slipcheck {
namespace {

/// Linear between two frames.
Vector3 between(const Vector3& a, const Vector3& b, double fraction) {
  return a + fraction * (b - a);
}

}  // namespace

double FallingQuantity::time_to_zero(double before, double after, double dt) const {
  const double expected = before - rate_ * dt;
  if (rate_ <= 0) return dt;
  if (expected <= 0) return before / rate_;
  // It counts as zero but goes on falling as before: its zero lies a little further on.
  return std::abs(after - expected) <= 0.1 * rate_ * dt ? before / rate_ : dt;
}

Observer::Observer(const HardScene& scene, double step, double speed_scale)
    : scene_(&scene), step_(step), speed_scale_(speed_scale), bodies_(scene.bodies.size()) {
  const double floor = (step > 0 ? kEngineNoise : kRoundOff) * speed_scale;
  const double g = scene.gravity;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Sphere& s = scene.bodies[i];
    const SubstrateContact& c = scene.on_substrate(i);
    const double per_step = 0.5 * g * step;
    // Rolling friction that is solved for after the sliding leaves its own step of slip.
    const double slip_friction = c.kinetic_friction + 2 * c.rolling.largest_up_to(speed_scale);
    bodies_[i].zero.slip =
        std::max(floor, per_step * (1 + s.inverse_shape_factor()) * slip_friction);
    bodies_[i].zero.speed = std::max(floor, per_step * c.rolling(0));
    bodies_[i].zero.spin = std::max(
        floor / s.radius, per_step * c.drilling_length / (s.shape_factor * s.radius * s.radius));
  }
}

Vector3 Observer::slip_of(std::size_t i, const BodyState& state) const {
  Vector3 slip = slip_velocity(state, scene_->bodies[i].radius);
  slip.z() = 0;
  return slip;
}

void Observer::take(double time, const Frame& frame) {
  if (!started_) {
    begin(time, frame);
    return;
  }
  const double t0 = time_, t1 = time;
  note_touches(t1, frame);
  for (Body& body : bodies_) body.touched = false;
  for (const Touch& touch : frame.touches)
    if (touch.second == kSubstrate) bodies_[static_cast<std::size_t>(touch.first)].touched = true;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    const BodyState& state = frame.bodies[i];
    const double height = state.position.z() - scene_->bodies[i].radius;
    // A sleeping body is not solved for, yet it lies on the plane.
    const bool lies = step_ > 0 && height < 1e-3 * scene_->bodies[i].radius &&
                      std::abs(state.velocity.z()) < vertical_noise();
    const bool supported = body.touched || lies;
    follow_landing(body, i, frame);
    follow_flight(body, i, supported, t0, t1, frame);
    body.supported = supported;
    follow_sliding(body, i, t0, t1, frame);
    follow_stopping(body, i, t0, t1, frame);
    body.collided_now = false;
  }
  settle_effective_restitution(t0, t1, frame);
  std::swap(before_last_, last_);
  time_before_ = t0;
  last_ = frame;
  time_ = t1;
}

void Observer::begin(double time, const Frame& frame) {
  started_ = true;
  time_ = time_before_ = time;
  last_ = before_last_ = frame;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    const BodyState& state = frame.bodies[i];
    body.origin_time = time;
    body.origin = state.position;
    body.after = state;
    body.slide_end = time;
    body.supported = state.position.z() <= scene_->bodies[i].radius * (1 + 1e-9) &&
                     !(state.velocity.z() > body.zero.slip);
    body.began_on_plane = body.supported;
    body.sliding = body.supported && slip_of(i, state).norm() > body.zero.slip;
    if (body.supported && !body.sliding) body.rolling_velocity = state.velocity;
    body.spinning = std::abs(state.angular_velocity.z()) > body.zero.spin;
    body.spun = body.spinning;
    body.resting = body.supported && !body.sliding && state.velocity.norm() <= body.zero.speed;
    if (body.resting) {
      body.stop_time = time;
      body.stop_position = state.position;
    }
  }
}

// --- single bodies -------------------------------------------------------------------------------

void Observer::follow_sliding(Body& body, std::size_t i, double t0, double t1, const Frame& frame) {
  const BodyState &s0 = last_.bodies[i], &s1 = frame.bodies[i];
  const double dt = t1 - t0;
  const double slip0 = slip_of(i, s0).norm(), slip1 = slip_of(i, s1).norm();
  const bool slips = slip1 > body.zero.slip;
  const Vector3 way = s1.position - s0.position;

  if (body.collided_now || dt <= 0) {
    body.slip.reset();
    if (body.sliding && !slips && !body.collided_now) body.slide_end = t1;
  } else if (body.sliding && body.supported && !slips) {
    const double left = step_ > 0 ? body.slip.time_to_zero(slip0, slip1, dt) : dt;
    body.slide_end = t0 + left;
    body.slide_time += left;
    // What counts as zero may last a little longer than the interval.
    const double beyond = std::max(0.0, left - dt);
    body.slide += left <= dt ? Vector3(way * (left / dt)) : Vector3(way + beyond * s1.velocity);
    body.rolling_velocity = s1.velocity + beyond / dt * (s1.velocity - s0.velocity);
  } else if (body.supported && slips) {
    if (body.sliding) body.slip.fall(slip0, slip1, dt);
    body.slide_time += dt;
    body.slide += way;
    body.slide_end = t1;
  }
  body.sliding = slips || (body.sliding && !body.supported);
  if (body.sliding || !body.supported)
    body.rolling_velocity = kVectorNotObserved;
  else if (std::isnan(body.rolling_velocity.x()))
    body.rolling_velocity = s1.velocity;
}

void Observer::follow_stopping(Body& body, std::size_t i, double t0, double t1,
                               const Frame& frame) {
  const BodyState &s0 = last_.bodies[i], &s1 = frame.bodies[i];
  const double dt = t1 - t0;
  const double speed0 = s0.velocity.norm(), speed1 = s1.velocity.norm();
  const bool rests = body.supported && !body.sliding && speed1 <= body.zero.speed;
  if (rests && !body.resting) {
    double left = dt;
    if (step_ > 0 && dt > 0) left = body.speed.time_to_zero(speed0, speed1, dt);
    body.stop_time = t0 + left;
    body.stop_position = left < dt ? between(s0.position, s1.position, left / dt) : s1.position;
  } else if (!rests) {
    body.stop_time = kNotObserved;
    if (dt > 0 && !body.collided_now)
      body.speed.fall(speed0, speed1, dt);
    else
      body.speed.reset();
  }
  body.resting = rests;

  const double spin0 = std::abs(s0.angular_velocity.z());
  const double spin1 = std::abs(s1.angular_velocity.z());
  const bool spins = spin1 > body.zero.spin;
  if (body.spinning && !spins) {
    body.spin_stop_time =
        t0 + (step_ > 0 && dt > 0 ? body.spin.time_to_zero(spin0, spin1, dt) : dt);
  } else if (spins) {
    body.spun = true;
    body.spin_stop_time = kNotObserved;
    if (dt > 0 && !body.collided_now)
      body.spin.fall(spin0, spin1, dt);
    else
      body.spin.reset();
  }
  body.spinning = spins;
}

// --- the end -------------------------------------------------------------------------------------

bool Observer::anything_slides_or_flies() const {
  return std::any_of(bodies_.begin(), bodies_.end(),
                     [](const Body& body) { return body.sliding || !body.supported; });
}

bool Observer::everything_rests() const {
  return std::all_of(bodies_.begin(), bodies_.end(),
                     [](const Body& body) { return body.resting && !body.spinning; });
}

double Observer::last_slide_end() const {
  double last = 0;
  for (const Body& body : bodies_) last = std::max(last, body.slide_end);
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

Observables Observer::finish(double end) const {
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
      out.slip_after_collision = slip_of(i, body.after);
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
    if (!std::isnan(body.lift_off_speed) && (!body.jumping || last_.bodies[i].velocity.z() <= 0))
      out.jump_height = body.peak - body.lift_off_height;
    const double dt = time_ - time_before_;
    const double fraction = dt > 0 && end < time_ ? (end - time_before_) / dt : 1;
    const BodyState &s0 = before_last_.bodies[i], &s1 = last_.bodies[i];
    out.final_position = between(s0.position, s1.position, fraction);
    out.final_velocity = between(s0.velocity, s1.velocity, fraction);
    out.final_angular_velocity = between(s0.angular_velocity, s1.angular_velocity, fraction);
    if (!std::isnan(body.landing_restitution))
      seen.pairs.push_back(
          {static_cast<int>(i), kSubstrate, body.landing_restitution, kNotObserved, kNotObserved});
  }
  for (const Pair& pair : pairs_)
    if (pair.collided)
      seen.pairs.push_back(
          {pair.first, pair.second, pair.restitution, pair.tangential_restitution, pair.effective});
  std::sort(seen.pairs.begin(), seen.pairs.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  });
  return seen;
}

}  // namespace slipcheck
