#include "physics/motion/substrate_phase.h"

#include <algorithm>
#include <cmath>

#include "physics/fall_time.h"
#include "physics/numbers.h"

namespace slipcheck {
namespace {

Vector3 horizontal(const Vector3& v) { return {v.x(), v.y(), 0}; }

/// Slip that rounding alone can leave in a state that rolls.
double slip_round_off(const Sphere& sphere, const BodyState& state) {
  return 16 * kEpsilon * (state.velocity.norm() + sphere.radius * state.angular_velocity.norm());
}

void roll_without_slip(double radius, BodyState& state) {
  const double spin = state.angular_velocity.z();
  state.angular_velocity = rolling_angular_velocity(state.velocity, radius);
  state.angular_velocity.z() = spin;
}

}  // namespace

SubstratePhase::SubstratePhase(const Sphere& sphere, const SubstrateContact& contact,
                               double gravity, const BodyState& state, bool confined)
    : start_(state), radius_(sphere.radius), turns_(sphere.shape != Shape::block) {
  const bool above = state.position.z() > sphere.radius * (1 + 4 * kEpsilon);
  if (!confined && (above || state.velocity.z() > 0)) {
    kind_ = Kind::flying;
    acceleration_ = -gravity * kUp;
    motion_duration_ =
        fall_time(std::max(0.0, state.position.z() - sphere.radius), state.velocity.z(), gravity);
    spin_duration_ = kNever;
  } else {
    start_.position.z() = sphere.radius;
    start_.velocity.z() = 0;
    const Vector3 slip = slip_velocity(start_, sphere);
    if (slip.norm() > slip_round_off(sphere, start_)) {
      start_sliding(sphere, contact, gravity, slip);
    } else if (start_.velocity.squaredNorm() > 0) {
      start_rolling(contact, gravity);
    } else {
      kind_ = Kind::resting;
      motion_duration_ = kNever;
    }
    const double spin = start_.angular_velocity.z();
    const double rate =
        contact.drilling_length * gravity / (sphere.shape_factor * sphere.radius * sphere.radius);
    spin_duration_ = kNever;
    if (spin != 0 && rate > 0) {
      angular_acceleration_.z() = -std::copysign(rate, spin);
      spin_duration_ = std::abs(spin) / rate;
    }
  }
  duration_ = std::min(motion_duration_, spin_duration_);
}

void SubstratePhase::start_sliding(const Sphere& sphere, const SubstrateContact& contact,
                                   double gravity, const Vector3& slip) {
  kind_ = Kind::sliding;
  const double a = contact.kinetic_friction * gravity;
  if (a == 0) {
    motion_duration_ = kNever;
    return;
  }
  const double A = sphere.inverse_shape_factor();
  const Vector3 direction = slip.normalized();
  acceleration_ = -a * direction;
  // The torque (−R k̂)×(−μ_k m g û) turns the sphere; with I = m R²/A.
  angular_acceleration_ = (A * a / sphere.radius) * kUp.cross(direction);
  motion_duration_ = slip.norm() / ((1 + A) * a);
}

void SubstratePhase::start_rolling(const SubstrateContact& contact, double gravity) {
  kind_ = Kind::rolling;
  speed_ = start_.velocity.norm();
  direction_ = start_.velocity / speed_;
  roll_without_slip(radius_, start_);
  const RollingFriction::Piece piece = contact.rolling.piece_below(speed_);
  deceleration_ = gravity * piece.coefficient;
  decay_ = gravity * piece.slope;
  end_speed_ = piece.lower_speed;
  if (deceleration_ == 0) {
    decay_ = 0;  // μ_r = 0 at this very speed: nothing slows the body
    motion_duration_ = kNever;
    return;
  }
  const double drop = speed_ - end_speed_;
  if (decay_ == 0) {
    acceleration_ = -deceleration_ * direction_;
    motion_duration_ = drop / deceleration_;
  } else {
    // v = v0 − (a/b)(1 − e^(−b t)); a friction that vanishes at the piece's end is never there.
    const double left = 1 - decay_ * drop / deceleration_;
    motion_duration_ = left > kEpsilon ? -std::log(left) / decay_ : kNever;
  }
}

bool SubstratePhase::is_at_rest() const {
  return kind_ == Kind::resting && start_.angular_velocity.z() == 0;
}

double SubstratePhase::rolling_speed(double t) const {
  return speed_ + deceleration_ * std::expm1(-decay_ * t) / decay_;
}

double SubstratePhase::rolled_distance(double t) const {
  return speed_ * t - (deceleration_ / decay_) * (t + std::expm1(-decay_ * t) / decay_);
}

Vector3 SubstratePhase::position_at(double t) const {
  if (decay_ != 0) return start_.position + rolled_distance(t) * direction_;
  return start_.position + t * (start_.velocity + (0.5 * t) * acceleration_);
}

BodyState SubstratePhase::at(double t) const {
  BodyState state;
  state.position = position_at(t);
  state.velocity = decay_ != 0 ? Vector3(rolling_speed(t) * direction_)
                               : Vector3(start_.velocity + t * acceleration_);
  state.angular_velocity = start_.angular_velocity + t * angular_acceleration_;
  if (kind_ == Kind::rolling) roll_without_slip(radius_, state);
  return state;
}

BodyState SubstratePhase::at_end() const {
  BodyState state = at(duration_);
  if (spin_duration_ <= duration_) state.angular_velocity.z() = 0;
  if (motion_duration_ <= duration_) {
    switch (kind_) {
      case Kind::flying:
        state.position.z() = radius_;
        break;
      case Kind::sliding:
        if (!turns_) state.velocity.setZero();
        roll_without_slip(radius_, state);
        break;
      case Kind::rolling:
        state.velocity = end_speed_ * direction_;
        roll_without_slip(radius_, state);
        break;
      case Kind::resting:
        break;
    }
  }
  return state;
}

void apply_substrate_impulse(const Sphere& sphere, const SubstrateContact& contact, double impulse,
                             BodyState& state) {
  const double A = sphere.inverse_shape_factor();
  const double m = sphere.mass;
  const Vector3 slip = horizontal(slip_velocity(state, sphere.radius));
  const double slip_speed = slip.norm();
  double left = impulse;
  if (slip_speed > slip_round_off(sphere, state)) {
    const Vector3 direction = slip / slip_speed;
    // A tangential impulse P changes the slip by (1+A) P/m.
    const double to_stick = m * slip_speed / (1 + A);
    const double friction = std::min(contact.kinetic_friction * impulse, to_stick);
    state.velocity -= (friction / m) * direction;
    state.angular_velocity += (A * friction / (m * sphere.radius)) * kUp.cross(direction);
    left = friction < to_stick ? 0 : impulse - to_stick / contact.kinetic_friction;
    if (friction == to_stick) roll_without_slip(sphere.radius, state);
  }
  if (left > 0) {
    const Vector3 v = horizontal(state.velocity);
    const double speed = v.norm();
    if (speed > 0) {
      const double lost = std::min(speed, contact.rolling(speed) * left / m);
      state.velocity -= (lost / speed) * v;
      roll_without_slip(sphere.radius, state);
    }
  }
  const double spin = state.angular_velocity.z();
  const double lost_spin = contact.drilling_length * impulse / sphere.moment_of_inertia();
  state.angular_velocity.z() = std::copysign(std::max(0.0, std::abs(spin) - lost_spin), spin);
}

void land(const Sphere& sphere, const SubstrateContact& contact, double slowest_rebound,
          BodyState& state) {
  const double impact = -state.velocity.z();
  double rebound = contact.restitution * impact;
  if (rebound < slowest_rebound) rebound = 0;
  apply_substrate_impulse(sphere, contact, sphere.mass * (impact + rebound), state);
  state.velocity.z() = rebound;
}

}  // namespace slipcheck
