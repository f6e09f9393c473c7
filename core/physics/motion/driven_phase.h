#pragma once

#include <variant>

#include "physics/contact/hard_contact.h"
#include "physics/motion/dry_slide.h"
#include "physics/motion/substrate_motion.h"
#include "physics/sphere.h"

namespace slipcheck {

/// A stretch of one body's motion between events on a substrate that is tilted, moves, or both; the
/// counterpart of SubstratePhase, with the state in the frame of the laboratory.
///
/// With G = a_G − a_S(t), a_G gravity's part along the plane (`downhill`), u the slip and
/// w = v − v_S(t):
/// Sliding, K (18), (20): v̇ = a_G − μ_k g û,  u̇ = G − (1+A) μ_k g û.
/// Rolling, K (11)-(16), (22): v̇ = (A a_G + a_S)/(1+A) − μ_r(|w|) g ŵ, which is
///   ẇ = A/(1+A) G − μ_r(|w|) g ŵ; it sticks while |G| <= (1+A) μ_s g, K (17), (25).
/// Resting: w = 0, held by rolling friction while A/(1+A) |G| <= μ_r(0) g, or without a drive.
/// Drilling (uncoupled) as on a still plane. Flying: v̇ = a_G − g k̂.
///
/// Exact: flying, resting, rolling without rolling friction, whatever keeps to a line under a
/// constant friction, and constant friction under a constant G. Elsewhere (a slip that turns on an
/// oscillating substrate, a table of rolling friction) a piece of a power series, whose velocities
/// are in error by at most DrySlide::kTolerance = 1e-13 times the scale of the speeds in it,
/// |v| + R|Ω| + |v_S| + |a_G|/ω; pieces do not amplify each other's errors where the friction does
/// not fall with the speed. Such a phase ends where its piece does and the next one goes on.
class DrivenPhase {
 public:
  enum class Kind { flying, sliding, rolling, resting };

  /// Whether the contact's laws are those above: no coupled drilling and no rolling friction on a
  /// sliding body.
  static bool can(const SubstrateContact& contact) {
    return contact.coupled_radius == 0 && !contact.rolling_while_sliding;
  }

  DrivenPhase() = default;

  /// The phase that starts at `state` at the time `start_time` [s] of the motion; downhill [m/s²].
  DrivenPhase(const Sphere& sphere, const SubstrateContact& contact, double gravity,
              const Vector2& downhill, const SubstrateMotion& motion, double start_time,
              const BodyState& state, bool confined = false);

  Kind kind() const { return kind_; }
  bool is_supported() const { return kind_ != Kind::flying; }
  /// Nothing moves relative to the substrate, not even a spin.
  bool is_at_rest() const;
  /// Time until the phase ends [s], > 0, maybe infinite. It ends where the kind of motion does,
  /// where the substrate's velocity jumps, or where its piece of the solution ends.
  double duration() const { return duration_; }

  /// The state after `elapsed` [s], in [0, duration()].
  BodyState at(double elapsed) const;
  Vector3 position_at(double elapsed) const;
  /// The state at the end with what ended there exactly zero: the slip, the velocity relative to
  /// the substrate or the spin; on the plane exactly after a flight, the landing's impulse not
  /// included.
  BodyState at_end() const;

  const BodyState& start() const { return start_; }
  /// The path is x + v t + ½ a t² with the acceleration() below.
  bool is_parabola() const { return is_parabola_; }
  const Vector3& acceleration() const { return acceleration_; }
  /// A bound of |acceleration of the centre| in this phase [m/s²].
  double largest_acceleration() const { return largest_acceleration_; }

 private:
  void start_flying(double gravity);
  void start_sliding(const SubstrateContact& contact, double gravity, const Vector2& slip,
                     double scale);
  void start_rolling(const SubstrateContact& contact, double gravity, double scale, double floor);
  void start_spin(const Sphere& sphere, const SubstrateContact& contact, double gravity);
  DryFriction rolling_friction(const SubstrateContact& contact, double gravity, const Drive& drive,
                               const Vector2& velocity, double scale) const;

  /// v_S(t) and x_S(t) − x_S(0) in this phase.
  Vector2 substrate_velocity(double t) const;
  Vector2 substrate_displacement(double t) const;
  /// w or, sliding, u; and its integral.
  Vector2 relative_velocity(double t) const;
  Vector2 relative_displacement(double t) const;

  Kind kind_ = Kind::resting;
  BodyState start_;
  double radius_ = 0, A_ = 0;
  double duration_ = 0;
  double motion_duration_ = 0;  // until the slip, the rolling, the hold or the piece ends
  double spin_duration_ = 0;    // until the drilling ends
  bool is_parabola_ = false, stops_ = false;
  Vector3 acceleration_ = Vector3::Zero();
  Vector3 angular_acceleration_ = Vector3::Zero();
  double largest_acceleration_ = 0;
  Vector2 downhill_ = Vector2::Zero();
  Vector2 substrate_ = Vector2::Zero();  // v_S at the start
  Drive drive_;                          // G
  DrySlide slide_;
};

}  // namespace slipcheck
