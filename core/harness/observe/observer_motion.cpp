#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/observe/observer.h"

namespace slipcheck {
namespace {

/// For how long a velocity changed evenly, until it was `after`, in an interval `dt` in which it
/// led over `way`; none in one of an engine that moves bodies by the velocity that a step ends
/// with.
double changing_time(const Vector3& before, const Vector3& after, const Vector3& way, double dt) {
  const Vector3 change = before - after;
  const double square = change.squaredNorm();
  return square > 0 ? std::clamp(2 * (way - dt * after).dot(change) / square, 0.0, dt) : 0;
}

}  // namespace

void Observer::follow_sliding(Body& body, std::size_t i, double t0, double t1, const Frame& frame) {
  const BodyState &s0 = last_.bodies[i], &s1 = frame.bodies[i];
  const double dt = t1 - t0;
  const double slip0 = slip_speed(i, s0, ground0_), slip1 = slip_speed(i, s1, ground1_);
  // Friction never turns a slip back; a spring does.
  const bool slips_on = body.sliding && slip1 > body.zero.lasting_slip && slip1 <= body.zero.slip &&
                        slip_of(i, s0, ground0_).dot(slip_of(i, s1, ground1_)) > 0;
  const bool slips_now = slips_on || slips(i, s1, ground1_);
  const Vector3 way = position_over(s1, ground1_) - position_over(s0, ground0_);

  // Friction has gone on: it takes half of what it can, or more.
  const double taken = body.slip.falls_in(dt);
  const double most = taken > 0 ? taken : step_ > 0 ? body.zero.slip * dt / step_ : slip0;
  const double half = 0.5 * std::min(slip0, most);
  const bool goes_on = std::exchange(body.faint, false) && slip0 - slip1 >= half;
  const auto slide_ends = [&](double left, const Vector3& slid) {
    body.slide_end = t0 + left;
    body.slide_time += left;
    body.slide += slid;
    body.rolling_velocity = s1.velocity;
  };
  const auto may_slip_on = [&] {
    body.slide_end = t1;
    body.faint = slip1 > body.zero.left_slip;
    body.faint_time = 0;
    body.faint_way.setZero();
  };
  if (body.collided_now || dt <= 0) {
    body.slip.reset();
    if (body.sliding && !slips_now && !body.collided_now) body.slide_end = t1;
    if (step_ > 0 && body.supported && body.collided_now && !slips_now) may_slip_on();
  } else if (step_ > 0 && body.supported && body.supported_steps == 1 && !slips_now) {
    may_slip_on();  // it gripped as it came down
  } else if (body.supported && !slips_now && (body.sliding || goes_on)) {
    if (goes_on) {
      body.slide_time += body.faint_time;
      body.slide += body.faint_way;
    }
    double left = step_ > 0 ? body.slip.time_to_zero(slip0, dt) : dt;
    if (goes_on && taken == 0) {
      const Vector3 rolling = velocity_over(s1, ground1_);
      left = changing_time(velocity_over(s0, ground0_), rolling, way, dt);
      slide_ends(left, way - (dt - left) * rolling);
    } else {
      slide_ends(left, left / dt * way);
    }
    // Where it should have ended in this step a solver may leave a little of what friction takes.
    const double little = slip0 < taken ? 0.01 * taken : 0;
    body.faint = step_ > 0 && slip1 > std::max(body.zero.left_slip, little);
    body.faint_time = dt - left;
    body.faint_way = (1 - left / dt) * way;
    if (taken == 0) body.slip.fall(slip0, slip1, dt);
  } else if (body.supported && slips_now) {
    if (body.sliding) body.slip.fall(slip0, slip1, dt);
    body.slide_time += dt;
    body.slide += way;
    body.slide_end = t1;
  }
  if (!body.supported) body.slide_end = t1;
  body.sliding = slips_now || (body.sliding && !body.supported);
  if (body.sliding || !body.supported)
    body.rolling_velocity = kVectorNotObserved;
  else if (std::isnan(body.rolling_velocity.x()))
    body.rolling_velocity = s1.velocity;
  // What is left of a bounce is no part of it.
  if (std::isnan(body.rolling_velocity.x())) return;
  if (on_surfaces_)
    body.rolling_velocity -= body.up.dot(body.rolling_velocity) * body.up;
  else
    body.rolling_velocity.z() = 0;
}

void Observer::follow_stopping(Body& body, std::size_t i, double t0, double t1,
                               const Frame& frame) {
  const BodyState &s0 = last_.bodies[i], &s1 = frame.bodies[i];
  const double dt = t1 - t0;
  const double speed0 = velocity_over(s0, ground0_).norm();
  const double speed1 = velocity_over(s1, ground1_).norm();
  const bool rests =
      body.supported && !body.sliding && speed1 <= body.zero.speed && can_rest(i, t1);
  if (rests && !body.resting) {
    double left = dt;
    if (step_ > 0 && dt > 0) left = body.speed.time_to_zero(speed0, speed1, dt);
    body.stop_time = t0 + left;
    const Vector3 x0 = position_over(s0, ground0_), x1 = position_over(s1, ground1_);
    body.stop_position = left < dt ? Vector3(x0 + left / dt * (x1 - x0)) : x1;
  } else if (!rests) {
    body.stop_time = kNotObserved;
    if (dt > 0 && !body.collided_now)
      body.speed.fall(speed0, speed1, dt);
    else
      body.speed.reset();
  }
  body.resting = rests;

  const double spin0 = std::abs(spin(body, s0));
  const double spin1 = std::abs(spin(body, s1));
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

}  // namespace slipcheck
