#include <algorithm>
#include <cmath>

#include "harness/observe/observer.h"

namespace slipcheck {

void Observer::follow_support(Body& body, bool touches, double t0, double t1,
                              const BodyState& now) const {
  const double speed = std::abs(rise(body, now));
  body.supported = touches && speed <= body.zero.rise;
  const bool quiet =
      speed <= std::max(kEngineNoise * speed_scale_, kQuiet * scene_->gravity * step_);
  const double steps = step_ > 0 ? (t1 - t0) / step_ : 1;
  const auto count = [steps](double& counted, bool goes_on) {
    counted = !goes_on ? 0 : counted > 0 ? counted + steps : 1;
  };
  count(body.supported_steps, body.supported);
  count(body.quiet_steps, body.supported && quiet);
  if (!quiet && body.supported_steps < kSupportedSteps) body.hop_end = t1;
}

/// The first jump begins.
void Observer::lift_off(Body& body, double time, const BodyState& state) const {
  body.jumping = true;
  body.lift_off_speed = rise(body, state);
  body.lift_off_time = time;
  body.lift_off_height = body.peak = level(body, state);
}

void Observer::follow_flight(Body& body, std::size_t i, bool touches, double t0, double t1,
                             const Frame& frame) {
  const BodyState &s0 = last_.bodies[i], &s1 = frame.bodies[i];
  const double v0 = rise(body, s0), v1 = rise(body, s1);
  const double level0 = level(body, s0), level1 = level(body, s1);
  const double slowest = body.zero.rise;
  if (touches) {
    body.unsupported_since = kNotObserved;
  } else if (std::isnan(body.unsupported_since)) {
    const bool has_bounced = v0 > slowest;  // at its last touch
    body.unsupported_since = has_bounced ? t0 : t1;
    body.unsupported_height = has_bounced ? level0 : level1;
  }
  if (!body.jumping) {
    // The reference shows that the support is gone; only at an instant, in a bounce, it does not.
    const bool is_free = step_ > 0 || !touches || t1 == t0;
    if (is_free && v1 > slowest && std::isnan(body.lift_off_speed)) {
      lift_off(body, t0, s0);
      body.lift_off_speed = v1;
      const bool is_late = step_ == 0 || (body.collided_now && body.collision_begin < t0);
      if (is_late && !touches) {
        // Since the support went, though that was in the middle of a collision.
        const bool flew_before = body.collided_now && body.unsupported_since < body.collision_begin;
        body.lift_off_time = flew_before ? body.collision_begin : body.unsupported_since;
        body.lift_off_height = flew_before ? body.collision_height : body.unsupported_height;
      }
      body.peak = std::max(level0, level1);
    }
    return;
  }
  // An engine may take several steps to throw a body up.
  if (step_ > 0 && body.touched && v0 > slowest && v1 > v0) {
    lift_off(body, t0, s0);
    body.lift_off_speed = v1;
  }
  double peak = std::max(level0, level1);
  if (v0 > 0 && v1 <= 0 && t1 > t0) peak = level0 + 0.5 * v0 * v0 * (t1 - t0) / (v0 - v1);
  if (!(touches && v0 < 0 && t1 > t0)) body.peak = std::max(body.peak, peak);
  // It may bounce again at once.
  if (touches && (v1 <= slowest || v0 < 0)) {
    const double plane = scene_->bodies[i].radius;
    const double above0 = on_surfaces_ ? gap(i, t0, s0) : s0.position.z() - plane;
    const double above1 = on_surfaces_ ? gap(i, t1, s1) : s1.position.z() - plane;
    const double fraction = above0 > 0 && above1 < 0 ? above0 / (above0 - above1) : 1;
    body.flight_time = t0 + fraction * (t1 - t0) - body.lift_off_time;
    body.jumping = false;
  }
}

void Observer::follow_landing(Body& body, std::size_t i, const Frame& frame) {
  const double v0 = rise(body, last_.bodies[i]), v1 = rise(body, frame.bodies[i]);
  const double slowest =
      std::max(kOfPairsFastest * body.fastest_landing, kOfSceneSpeed * speed_scale_);
  if (body.touched && body.fall_speed == 0 && v0 < -std::max(slowest, 2 * scene_->gravity * step_))
    body.fall_speed = -v0;
  if (body.fall_speed == 0) return;
  // An engine may take several steps to turn the body round and to throw it up again.
  if (body.touched && !body.collided_now && (v1 > v0 || v0 < 0)) {
    body.fastest_landing = std::max(body.fastest_landing, body.fall_speed);
    body.landing_restitution = std::max(0.0, v1) / body.fall_speed;
    body.landed_on = body.base;
  }
  if (!body.touched || (v0 >= 0 && v1 <= v0)) body.fall_speed = 0;
}

}  // namespace slipcheck
