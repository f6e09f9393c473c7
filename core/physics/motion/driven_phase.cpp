#include "physics/motion/driven_phase.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/fall_time.h"
#include "physics/numbers.h"

namespace slipcheck {
namespace {

Vector3 in_plane(const Vector2& v) { return {v.x(), v.y(), 0}; }

}  // namespace

DrivenPhase::DrivenPhase(const Sphere& sphere, const SubstrateContact& contact, double gravity,
                         const Vector2& downhill, const SubstrateMotion& motion, double start_time,
                         const BodyState& state, bool confined)
    : start_(state),
      radius_(sphere.radius),
      A_(sphere.inverse_shape_factor()),
      downhill_(downhill) {
  const bool above = state.position.z() > sphere.radius * (1 + 4 * kEpsilon);
  if (!confined && (above || state.velocity.z() > 0)) {
    start_flying(gravity);
    duration_ = motion_duration_;
    return;
  }
  start_.position.z() = sphere.radius;
  start_.velocity.z() = 0;
  // A kink within the rounding of the time has passed.
  double time = start_time, kink = motion.next_kink(time);
  if (kink - time <= 4 * kEpsilon * std::abs(time)) {
    time = kink;
    kink = motion.next_kink(time);
  }
  substrate_ = motion.velocity(time).head<2>();
  drive_.steady = downhill;
  if (!motion.is_uniform_between_kinks()) {
    drive_.omega = 2 * std::numbers::pi * motion.frequency();
    const double phase = drive_.omega * time + motion.phase();
    drive_.phase = std::remainder(phase, 2 * std::numbers::pi);
    drive_.phase_error = kEpsilon * std::abs(phase);
    drive_.swing = drive_.omega * drive_.omega * motion.vector();
  }
  const Vector2 slip = slip_velocity(start_, radius_).head<2>() - substrate_;
  double scale =
      start_.velocity.norm() + radius_ * start_.angular_velocity.norm() + substrate_.norm();
  // Slip that rounding alone, of the velocities or of the time, can leave in a state that rolls;
  // friction ends it before the clock moves on.
  const double rate = motion.largest_acceleration() + (1 + A_) * contact.kinetic_friction * gravity;
  const double floor = kEpsilon * (16 * scale + 4 * std::abs(start_time) * rate);
  if (!drive_.is_uniform()) scale += motion.largest_speed() + downhill.norm() / drive_.omega;
  if (slip.norm() > floor) {
    start_sliding(contact, gravity, slip, scale);
  } else if (drive_.time_beyond((1 + A_) * contact.static_friction * gravity) == 0) {
    start_sliding(contact, gravity, Vector2::Zero(), scale);
  } else {
    start_rolling(contact, gravity, scale, floor);
  }
  start_spin(sphere, contact, gravity);
  duration_ = std::min({motion_duration_, spin_duration_, kink - time});
}

void DrivenPhase::start_flying(double gravity) {
  kind_ = Kind::flying;
  is_parabola_ = true;
  acceleration_ = in_plane(downhill_) - gravity * kUp;
  largest_acceleration_ = acceleration_.norm();
  motion_duration_ =
      fall_time(std::max(0.0, start_.position.z() - radius_), start_.velocity.z(), gravity);
  spin_duration_ = kNever;
}

void DrivenPhase::start_sliding(const SubstrateContact& contact, double gravity,
                                const Vector2& slip, double scale) {
  kind_ = Kind::sliding;
  const double friction = contact.kinetic_friction * gravity;
  slide_ = DrySlide(drive_, DryFriction{.constant = (1 + A_) * friction}, slip, scale);
  motion_duration_ = slide_.duration();
  stops_ = slide_.stops();
  largest_acceleration_ = downhill_.norm() + friction;
  if (!slide_.is_straight()) return;
  // Friction without turning: the centre's path is a parabola however the substrate moves.
  is_parabola_ = true;
  const Vector3 push = -friction * in_plane(slide_.direction());
  acceleration_ = in_plane(downhill_) + push;
  // The torque (−R k̂)×push turns the sphere; with I = m R²/A.
  angular_acceleration_ = (-A_ / radius_) * kUp.cross(push);
  largest_acceleration_ = acceleration_.norm();
}

void DrivenPhase::start_rolling(const SubstrateContact& contact, double gravity, double scale,
                                double floor) {
  const Drive drive = drive_.scaled(A_ / (1 + A_));
  const double break_loose = drive_.time_beyond((1 + A_) * contact.static_friction * gravity);
  const Vector2 velocity = start_.velocity.head<2>() - substrate_;
  const bool moves = velocity.norm() > floor;
  const double substrate_acceleration = drive_.swing.norm();
  const double hold = contact.rolling(0) * gravity;
  const double held_until = !moves && (hold > 0 || drive.is_zero()) ? drive.time_beyond(hold) : 0;
  if (held_until > 0) {
    kind_ = Kind::resting;
    start_.velocity.head<2>() = substrate_;
    start_.angular_velocity.head<2>().setZero();
    motion_duration_ = std::min(break_loose, held_until);
    is_parabola_ = drive_.is_uniform();
    largest_acceleration_ = substrate_acceleration;
    return;
  }
  kind_ = Kind::rolling;
  const Vector2 begins = moves ? velocity : Vector2::Zero();
  DryFriction friction;
  double largest = 0;
  if (!contact.rolling.is_zero()) {
    friction = rolling_friction(contact, gravity, drive, begins, scale);
    for (const auto& point : contact.rolling.points())
      largest = std::max(largest, point.coefficient * gravity);
  }
  slide_ = DrySlide(drive, friction, begins, scale);
  motion_duration_ = std::min(break_loose, slide_.duration());
  stops_ = slide_.stops() && slide_.duration() <= break_loose;
  start_.velocity.head<2>() = substrate_ + begins;
  is_parabola_ = slide_.is_straight() && drive_.is_uniform();
  if (is_parabola_) acceleration_ = in_plane(drive.steady - friction.constant * slide_.direction());
  largest_acceleration_ = (substrate_acceleration + A_ * downhill_.norm()) / (1 + A_) + largest;
  const double spin = start_.angular_velocity.z();
  start_.angular_velocity = rolling_angular_velocity(in_plane(begins), radius_);
  start_.angular_velocity.z() = spin;
}

/// The piece of the table that the speed is in, or at a point of the table the one it goes to.
DryFriction DrivenPhase::rolling_friction(const SubstrateContact& contact, double gravity,
                                          const Drive& drive, const Vector2& velocity,
                                          double scale) const {
  const auto& points = contact.rolling.points();
  const double speed = velocity.norm();
  const double near = 64 * kEpsilon * scale;
  const bool rises =
      speed == 0 || drive.at(0).dot(velocity) / speed > contact.rolling(speed) * gravity;
  std::size_t below = 0;  // points that the piece lies above
  while (below < points.size() && points[below].speed <= speed + (rises ? near : -near)) ++below;
  DryFriction friction;
  if (below < points.size()) friction.fastest = points[below].speed;
  if (below == 0 || below == points.size()) {
    friction.constant = gravity * (below == 0 ? points.front() : points.back()).coefficient;
    if (below == points.size() && points.size() > 1) friction.slowest = points.back().speed;
    if (below == 0) friction.slowest = 0;
    return friction;
  }
  const auto &low = points[below - 1], &high = points[below];
  friction.slowest = low.speed;
  friction.slope = gravity * (high.coefficient - low.coefficient) / (high.speed - low.speed);
  friction.constant = gravity * low.coefficient - friction.slope * low.speed;
  return friction;
}

void DrivenPhase::start_spin(const Sphere& sphere, const SubstrateContact& contact,
                             double gravity) {
  const double spin = start_.angular_velocity.z();
  const double rate =
      contact.drilling_length * gravity / (sphere.shape_factor * sphere.radius * sphere.radius);
  spin_duration_ = kNever;
  if (spin == 0 || rate == 0) return;
  angular_acceleration_.z() = -std::copysign(rate, spin);
  spin_duration_ = std::abs(spin) / rate;
}

bool DrivenPhase::is_at_rest() const {
  return kind_ == Kind::resting && start_.angular_velocity.z() == 0;
}

// G = a_G − a_S.
Vector2 DrivenPhase::substrate_velocity(double t) const {
  if (drive_.is_uniform()) return substrate_;
  return substrate_ + t * downhill_ - drive_.integral(t);
}

Vector2 DrivenPhase::substrate_displacement(double t) const {
  if (drive_.is_uniform()) return t * substrate_;
  return t * substrate_ + (0.5 * t * t) * downhill_ - drive_.double_integral(t);
}

Vector2 DrivenPhase::relative_velocity(double t) const {
  return kind_ == Kind::resting ? Vector2(Vector2::Zero()) : slide_.velocity(t);
}

Vector2 DrivenPhase::relative_displacement(double t) const {
  return kind_ == Kind::resting ? Vector2(Vector2::Zero()) : slide_.displacement(t);
}

Vector3 DrivenPhase::position_at(double t) const {
  if (is_parabola_) return start_.position + t * (start_.velocity + (0.5 * t) * acceleration_);
  Vector2 way = substrate_displacement(t) + relative_displacement(t);
  if (kind_ == Kind::sliding) {
    // Friction changes the centre's velocity and the slip in the ratio 1 : 1+A.
    const Vector2 w = start_.velocity.head<2>();
    const Vector2 slip = slip_velocity(start_, radius_).head<2>() - substrate_;
    const Vector2 free = (0.5 * t * t) * downhill_;
    way = t * w + free + (way - t * (slip + substrate_) - free) / (1 + A_);
  }
  return start_.position + in_plane(way);
}

BodyState DrivenPhase::at(double t) const {
  BodyState state;
  state.position = position_at(t);
  state.angular_velocity = start_.angular_velocity + t * angular_acceleration_;
  if (is_parabola_) state.velocity = start_.velocity + t * acceleration_;
  if (kind_ == Kind::flying || (kind_ == Kind::sliding && is_parabola_)) return state;
  const Vector2 relative = relative_velocity(t), substrate = substrate_velocity(t);
  Vector2 rolling = relative;  // velocity of the rolling that goes with Ω
  if (kind_ == Kind::sliding) {
    const Vector2 v = start_.velocity.head<2>();
    const Vector2 slip = slip_velocity(start_, radius_).head<2>() - substrate_;
    const Vector2 after =
        v + t * downhill_ + (relative + substrate - slip - substrate_ - t * downhill_) / (1 + A_);
    state.velocity = in_plane(after);
    rolling = A_ > 0 ? Vector2(after - substrate - relative) : Vector2(Vector2::Zero());
  } else if (!is_parabola_) {
    state.velocity = in_plane(substrate + relative);
  }
  const double spin = state.angular_velocity.z();
  state.angular_velocity = rolling_angular_velocity(in_plane(rolling), radius_);
  state.angular_velocity.z() = spin;
  return state;
}

BodyState DrivenPhase::at_end() const {
  BodyState state = at(duration_);
  if (spin_duration_ <= duration_) state.angular_velocity.z() = 0;
  if (motion_duration_ > duration_) return state;
  if (kind_ == Kind::flying) state.position.z() = radius_;
  if (!stops_) return state;
  const double spin = state.angular_velocity.z();
  const Vector2 substrate = substrate_velocity(duration_);
  const bool rolls_on = kind_ == Kind::sliding && A_ > 0;
  if (!rolls_on) state.velocity = in_plane(substrate);
  state.angular_velocity = rolling_angular_velocity(state.velocity - in_plane(substrate), radius_);
  state.angular_velocity.z() = spin;
  return state;
}

}  // namespace slipcheck
