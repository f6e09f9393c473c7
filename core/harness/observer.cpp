#include "harness/observer.h"

#include <algorithm>
#include <cmath>

namespace slipcheck {
namespace {

/// A collision closes at least at these fractions of the pair's fastest and of the scene's speed.
constexpr double kOfPairsFastest = 0.07;
constexpr double kOfSceneSpeed = 1e-3;
/// What an engine leaves in a quantity that should be zero, of the scene's speed.
constexpr double kEngineNoise = 1e-5;
constexpr double kRoundOff = 1e-12;

std::size_t index(int body) { return static_cast<std::size_t>(body); }

/// Velocity of the first body at the contact point relative to the second; n from the second.
Vector3 contact_velocity(const Sphere& a, const BodyState& sa, const Sphere& b,
                         const BodyState& sb, const Vector3& n) {
  return sa.velocity - sb.velocity -
         (a.radius * sa.angular_velocity + b.radius * sb.angular_velocity).cross(n);
}

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
    bodies_[i].zero.spin = std::max(floor / s.radius, per_step * c.drilling_length /
                                                          (s.shape_factor * s.radius * s.radius));
  }
}

Vector3 Observer::slip_of(std::size_t i, const BodyState& state) const {
  Vector3 slip = slip_velocity(state, scene_->bodies[i].radius);
  slip.z() = 0;
  return slip;
}

Observer::Pair& Observer::pair_of(int first, int second) {
  for (Pair& pair : pairs_)
    if (pair.first == first && pair.second == second) return pair;
  Pair& pair = pairs_.emplace_back();
  pair.first = first;
  pair.second = second;
  return pair;
}

void Observer::take(double time, const Frame& frame) {
  if (!started_) {
    begin(time, frame);
    return;
  }
  const double t0 = time_, t1 = time;
  note_touches(t1, frame);
  const auto is_touched = [&](std::size_t i) {
    return std::any_of(frame.touches.begin(), frame.touches.end(), [&](const Touch& touch) {
      return touch.second == kSubstrate && index(touch.first) == i;
    });
  };
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    const BodyState& state = frame.bodies[i];
    const double height = state.position.z() - scene_->bodies[i].radius;
    const double vertical_noise =
        std::max(kOfSceneSpeed * speed_scale_, scene_->gravity * step_);
    const bool touched = is_touched(i);
    // A sleeping body is not solved for, yet it lies on the plane.
    const bool lies = step_ > 0 && height < 1e-3 * scene_->bodies[i].radius &&
                      std::abs(state.velocity.z()) < vertical_noise;
    const bool supported = touched || lies;
    follow_landing(body, i, touched, frame);
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

// --- collisions ----------------------------------------------------------------------------------

void Observer::note_touches(double t1, const Frame& frame) {
  for (Pair& pair : pairs_) pair.touched_now = false;
  for (const Touch& touch : frame.touches)
    if (touch.second != kSubstrate)
      note_collision(pair_of(touch.first, touch.second), touch, t1, frame);
  for (Pair& pair : pairs_)
    if (!pair.touched_now) pair.colliding = false;
}

void Observer::note_collision(Pair& pair, const Touch& touch, double t1, const Frame& frame) {
  pair.touched_now = true;
  const std::size_t i = index(pair.first), j = index(pair.second);
  const BodyState& si = last_.bodies[i];
  const BodyState& sj = last_.bodies[j];
  const Sphere &a = scene_->bodies[i], &b = scene_->bodies[j];
  const Vector3 n = (si.position - sj.position).normalized();
  const Vector3 dv = si.velocity - sj.velocity;
  const double approach = -n.dot(dv);

  const double weakest = std::max(kOfPairsFastest * pair.fastest, kOfSceneSpeed * speed_scale_);
  // A blow that passes through a row of bodies in one step finds this pair without an approach;
  // what sliding bodies that lean on each other push in a step is none.
  const double blow = 0.5 * touch.normal_impulse * (1 / a.mass + 1 / b.mass);
  const double leaning = (scene_->on_substrate(i).kinetic_friction +
                          scene_->on_substrate(j).kinetic_friction) *
                         scene_->gravity * step_;
  if (approach <= weakest && (step_ == 0 || blow <= weakest + leaning)) {
    pair.colliding = false;
    return;
  }

  if (!pair.colliding) {
    pair.colliding = true;
    pair.n = n;
    pair.approach = approach > weakest ? approach : kNotObserved;
    pair.fastest = std::max({pair.fastest, approach, blow > weakest + leaning ? blow : 0});
    const Vector3 u = contact_velocity(a, si, b, sj, n);
    pair.tangential = u - n.dot(u) * n;
  }
  const BodyState &after_i = frame.bodies[i], &after_j = frame.bodies[j];
  pair.collided = true;
  pair.restitution = pair.n.dot(after_i.velocity - after_j.velocity) / pair.approach;
  const double before2 = pair.tangential.squaredNorm();
  pair.tangential_restitution =
      std::sqrt(before2) > kEngineNoise * speed_scale_
          ? contact_velocity(a, after_i, b, after_j, pair.n).dot(pair.tangential) / before2
          : kNotObserved;
  pair.effective = kNotObserved;
  // A body that collides again never shows what its earlier collision would have come to.
  for (Pair& other : pairs_)
    if (other.first == pair.first || other.first == pair.second || other.second == pair.first ||
        other.second == pair.second)
      other.awaits_rolling = false;
  pair.awaits_rolling = true;
  for (const auto& [k, away] : {std::pair{i, pair.n}, std::pair<std::size_t, Vector3>{j, -pair.n}}) {
    Body& body = bodies_[k];
    body.collided = body.collided_now = true;
    body.away = away;
    body.after = frame.bodies[k];
    body.origin_time = t1;
    body.origin = frame.bodies[k].position;
    body.slide_time = 0;
    body.slide.setZero();
    body.slide_end = t1;
    body.rolling_velocity = kVectorNotObserved;
    body.stop_time = body.spin_stop_time = kNotObserved;
    body.resting = false;
    body.spun = std::abs(frame.bodies[k].angular_velocity.z()) > body.zero.spin;
    body.spinning = body.spun;
    body.jumping = false;
    body.lift_off_speed = body.flight_time = kNotObserved;
  }
}

void Observer::settle_effective_restitution(double t0, double t1, const Frame& frame) {
  for (Pair& pair : pairs_) {
    if (!pair.awaits_rolling || pair.colliding) continue;
    const Body &a = bodies_[index(pair.first)], &b = bodies_[index(pair.second)];
    if (a.sliding || b.sliding || !a.supported || !b.supported) continue;
    const double both = std::max(a.slide_end, b.slide_end);
    const auto velocity_then = [&](int k) -> Vector3 {
      const std::size_t i = index(k);
      const Vector3& now = frame.bodies[i].velocity;
      // A slide's end is a kink; after it the body keeps its velocity for now.
      if (bodies_[i].slide_end == both) return bodies_[i].rolling_velocity;
      if (t1 <= t0 || both <= t0 || both >= t1) return now;
      return between(last_.bodies[i].velocity, now, (both - t0) / (t1 - t0));
    };
    const Vector3 dv = velocity_then(pair.first) - velocity_then(pair.second);
    pair.effective = pair.n.dot(dv) / pair.approach;
    pair.awaits_rolling = false;
  }
}

// --- single bodies -------------------------------------------------------------------------------

void Observer::follow_sliding(Body& body, std::size_t i, double t0, double t1,
                              const Frame& frame) {
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
    body.stop_position =
        left < dt ? between(s0.position, s1.position, left / dt) : s1.position;
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
    body.spin_stop_time = t0 + (step_ > 0 && dt > 0 ? body.spin.time_to_zero(spin0, spin1, dt) : dt);
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

void Observer::follow_flight(Body& body, std::size_t i, bool supported, double t0, double t1,
                             const Frame& frame) {
  const BodyState &s0 = last_.bodies[i], &s1 = frame.bodies[i];
  const double v0 = s0.velocity.z(), v1 = s1.velocity.z();
  const double slowest = step_ > 0
                             ? std::max(kOfSceneSpeed * speed_scale_, scene_->gravity * step_)
                             : kRoundOff * speed_scale_;
  if (!body.jumping) {
    if (v1 > slowest && std::isnan(body.lift_off_speed)) {
      body.jumping = true;
      body.lift_off_time = t0;
      body.lift_off_speed = v1;
      body.lift_off_height = s0.position.z();
      body.peak = std::max(s0.position.z(), s1.position.z());
    }
    return;
  }
  double peak = std::max(s0.position.z(), s1.position.z());
  if (v0 > 0 && v1 <= 0 && t1 > t0) peak = s0.position.z() + 0.5 * v0 * v0 * (t1 - t0) / (v0 - v1);
  if (!(supported && v0 < 0 && t1 > t0)) body.peak = std::max(body.peak, peak);
  if (supported && v1 <= slowest) {
    const double plane = scene_->bodies[i].radius;
    const double above0 = s0.position.z() - plane, above1 = s1.position.z() - plane;
    const double fraction = above0 > 0 && above1 < 0 ? above0 / (above0 - above1) : 1;
    body.flight_time = t0 + fraction * (t1 - t0) - body.lift_off_time;
    body.jumping = false;
  }
}

void Observer::follow_landing(Body& body, std::size_t i, bool touched, const Frame& frame) {
  const double v0 = last_.bodies[i].velocity.z(), v1 = frame.bodies[i].velocity.z();
  const double slowest =
      std::max(kOfPairsFastest * body.fastest_landing, kOfSceneSpeed * speed_scale_);
  if (touched && body.fall_speed == 0 && v0 < -std::max(slowest, 2 * scene_->gravity * step_))
    body.fall_speed = -v0;
  if (body.fall_speed == 0) return;
  if (touched && !body.collided_now) {
    body.fastest_landing = std::max(body.fastest_landing, body.fall_speed);
    body.landing_restitution = std::max(0.0, v1) / body.fall_speed;
  }
  // An engine may take several steps to turn the body round.
  if (!touched || v1 >= 0) body.fall_speed = 0;
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
      out.energy_change_sliding =
          body.after.velocity.squaredNorm() - body.rolling_velocity.squaredNorm();
      if (body.collided)
        out.momentum_change_sliding =
            (body.after.velocity - body.rolling_velocity).dot(body.away);
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
    if (body.spun && !body.spinning) out.spin_stopping_time = body.spin_stop_time - body.origin_time;
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
      seen.pairs.push_back({static_cast<int>(i), kSubstrate, body.landing_restitution,
                            kNotObserved, kNotObserved});
  }
  for (const Pair& pair : pairs_)
    if (pair.collided)
      seen.pairs.push_back({pair.first, pair.second, pair.restitution, pair.tangential_restitution,
                            pair.effective});
  std::sort(seen.pairs.begin(), seen.pairs.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  });
  return seen;
}

}  // namespace slipcheck
