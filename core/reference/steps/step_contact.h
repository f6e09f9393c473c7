#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "reference/steps/step_kernel.h"
#include "reference/steps/step_pair.h"

namespace slipcheck {

/// The forces between two materials.
template <class Normal, class Tangential>
struct StepLaw {
  Normal normal;
  Tangential tangential;
  bool clamped = false;  ///< ContactEnd::zero_force
};

/// On the first of two bodies, and of that the part across the line of centres, which alone turns
/// them [N].
struct StepForce {
  Vector3 all = Vector3::Zero(), across = Vector3::Zero();

  StepForce operator+(const StepForce& other) const {
    return {all + other.all, across + other.across};
  }
  StepForce operator-(const StepForce& other) const {
    return {all - other.all, across - other.across};
  }
  friend StepForce operator*(double factor, const StepForce& force) {
    return {factor * force.all, factor * force.across};
  }
};

/// What a contact does to its bodies: a force on the first [N], and F_T × n [N], which turns both.
template <class Tangential>
struct StepPush {
  Vector3 all, lever;
  bool ends;  ///< the contact does: as of keep_down()

  static StepPush of(const StepForce& force, const Vector3& n, bool ends = false) {
    if constexpr (Tangential::kRubs) return {force.all, force.across.cross(n), ends};
    return {force.all, Vector3::Zero(), ends};
  }
  void on(StepBody& body, bool is_second) const {
    const double before = body.force.z();
    if (is_second)
      body.force -= all;
    else
      body.force += all;
    if constexpr (Tangential::kRubs) body.torque += body.radius * lever;
    if (ends) [[unlikely]]
      keep_down(body, before);
  }
  /// What is taken back from a body that the other pressed down was borne by the substrate and
  /// must not lift it.
  static void keep_down(StepBody& body, double before) {
    if (body.supported)
      body.force.z() = before + std::min(body.force.z() - before, body.kind->weight);
  }
};

struct StepTally {
  std::size_t touching = 0, collisions = 0;
};

/// Two bodies that may touch: what of their contact goes on from step to step, and what it does to
/// them in one (K (1)-(6)).
///
/// A contact that begins or ends within a step gets the impulse of the part of the step that it
/// had, by the trapezoidal rule; a force that starts or ends with a jump would else leave an error
/// of first order.
template <class Normal, class Tangential>
class StepContact {
 public:
  using Law = StepLaw<Normal, Tangential>;
  using Push = StepPush<Tangential>;

  bool touching() const { return touching_; }
  double normal_force() const { return normal_force_; }  ///< F_N [N]

  /// What it does now, with x_a − x_b [m]. law: gives a Law where they touch; push: takes a Push.
  template <class LawOf, class ToPush>
  [[gnu::always_inline]] void step(const StepWorld& world, const StepBody& a, const StepBody& b,
                                   const Vector3& between, const LawOf& law, StepTally& tally,
                                   const ToPush& push) {
    const double reach = a.radius + b.radius, distance2 = between.squaredNorm();
    if (distance2 <= reach * reach)
      meet(world, a, b, law(), between, reach, std::sqrt(distance2), tally, push);
    else if (touching_)
      push(part(world, a, b, law(), Vector3(between), reach, std::sqrt(distance2)));
  }

 private:
  /// u_t [m/s] with the velocities relative to each other `dv` and the surfaces' `turning`
  /// R_iΩ_i + R_jΩ_j.
  static Vector3 slip(const Vector3& dv, double closing, const Vector3& turning, const Vector3& n) {
    return dv + closing * n - turning.cross(n);
  }

  StepForce force_of(const Law& law, double normal, const Vector3& slip, const Vector3& n) const {
    if constexpr (Tangential::kRubs) {
      const Vector3 across = law.tangential.force(history_, normal, slip);
      return {normal * n + across, across};
    } else {
      return {normal * n, Vector3::Zero()};
    }
  }

  /// Two bodies that overlap. push: takes a Push. What is called now and then gets copies of
  /// vectors: one whose address is told is written to memory in every step.
  template <class ToPush>
  [[gnu::always_inline]] void meet(const StepWorld& world, const StepBody& a, const StepBody& b,
                                   const Law& law, const Vector3& between, double reach,
                                   double distance, StepTally& tally, const ToPush& push) {
    // Products first that need not wait for the root and the division.
    const Vector3 dv = (a.velocity - b.velocity) + 0.5 * (a.velocity_change - b.velocity_change);
    const double parting = between.dot(dv), inverse = 1 / distance;
    const double overlap = reach - distance, closing = -parting * inverse;
    const Vector3 n = between * inverse;
    const double normal = law.normal(overlap, closing);
    if ((law.clamped && normal <= 0) || (overlap <= 0 && closing <= 0)) [[unlikely]] {
      if (touching_) {
        const double left = normal < 0 ? normal_force_ / (normal_force_ - normal) : 1;
        push(end(left, {}, Vector3(n)));
      }
      return;
    }
    Vector3 slip_now = Vector3::Zero();
    if constexpr (Tangential::kRubs) {
      const Vector3 turning = a.radius * (a.angular_velocity + 0.5 * a.angular_velocity_change) +
                              b.radius * (b.angular_velocity + 0.5 * b.angular_velocity_change);
      slip_now = slip(dv, closing, turning, n);
    }
    ++tally.touching;
    if (!touching_) [[unlikely]] {
      ++tally.collisions;
      push(begin(world, a, b, law, overlap, normal, Vector3(slip_now), Vector3(n)));
    } else if constexpr (Tangential::kRubs) {
      law.tangential.advance(history_, 0.5 * world.step, normal, slip_now, n);
      // Not by way of force_, which would be waited for.
      const Vector3 across = law.tangential.force(history_, normal, slip_now);
      const Vector3 all = normal * n + across;
      push(Push{all, across.cross(n), false});
      force_.all = all;
      force_.across = across;
    } else {
      force_.all = normal * n;
      push(Push::of(force_, n));
    }
    normal_force_ = normal;
  }

  /// The contact has lasted for `part` of the step before now, and gets part h ½ (F_begin + F) for
  /// it.
  [[gnu::noinline]] Push begin(const StepWorld& world, const StepBody& a, const StepBody& b,
                               const Law& law, double overlap, double normal,
                               const Vector3& slip_now, const Vector3& n) {
    const double h = world.step;
    const double closing = -n.dot(a.velocity - b.velocity);
    const bool began_within = world.n > 0 && closing * h >= overlap && closing > 0;
    const double part = began_within ? overlap / (closing * h) : 0;
    const double first =
        law.clamped ? std::max(0.0, law.normal(0, closing)) : law.normal(0, closing);
    if constexpr (Tangential::kRubs) law.tangential.begin(history_, 0.5 * h, part * h, slip_now, n);
    const StepForce first_force = force_of(law, first, slip_now, n);
    if constexpr (Tangential::kRubs) law.tangential.advance(history_, 0.5 * h, normal, slip_now, n);
    force_ = force_of(law, normal, slip_now, n);
    touching_ = true;
    return Push::of(began_within ? 0.5 * ((1 + part) * force_ + part * first_force) : force_, n);
  }

  /// Two bodies that touched a step ago and overlap no more.
  [[gnu::noinline]] Push part(const StepWorld& world, const StepBody& a, const StepBody& b,
                              const Law& law, const Vector3& between, double reach,
                              double distance) {
    const Vector3 n = between / distance;
    const Vector3 dv = a.velocity - b.velocity;
    const double closing = -n.dot(dv);
    const double gone = closing < 0 ? (reach - distance) / (closing * world.step) : 0;
    const double last = law.clamped ? 0 : law.normal(0, closing);
    Vector3 slip_now = Vector3::Zero();
    if constexpr (Tangential::kRubs)
      slip_now =
          slip(dv, closing, a.radius * a.angular_velocity + b.radius * b.angular_velocity, n);
    return end(std::max(0.0, 1 - gone), force_of(law, last, slip_now, n), n);
  }

  /// The contact lasted for `part` of the step before now and should have had part h ½ (F + F_end)
  /// there; it had h/2 F.
  [[gnu::noinline]] Push end(double part, const StepForce& last_force, const Vector3& n) {
    touching_ = false;
    return Push::of(0.5 * (part * (force_ + last_force) - force_), n, true);
  }

  bool touching_ = false;
  double normal_force_ = 0;  ///< F_N [N]
  StepForce force_;
  [[no_unique_address]] typename Tangential::History history_;
};

}  // namespace slipcheck
