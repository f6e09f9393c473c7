#pragma once

#include "physics/contact/hard_contact.h"
#include "physics/sphere.h"

namespace slipcheck {

/// A stretch of one body's motion between events with an exact solution, on a still, level
/// substrate.
///
/// Sliding, K (18): v̇ = −μ_k g û, u̇ = −(1+A) μ_k g û with û constant: the slip falls in a
/// straight line to zero and the path is a parabola.
/// Rolling, K (16): v̇ = −μ_r(|v|) g v̂ on a straight path; Ω follows v without slip.
/// Drilling (uncoupled): Ω̇_z = −sgn(Ω_z) l g/(q R²), l the drilling length.
/// Flying: v̇ = −g k̂, Ω constant.
class SubstratePhase {
 public:
  enum class Kind { flying, sliding, rolling, resting };

  SubstratePhase() = default;

  /// The phase that starts at `state`. A body flies if it is above the plane or leaves it.
  SubstratePhase(const Sphere& sphere, const SubstrateContact& contact, double gravity,
                 const BodyState& state, bool confined = false);

  Kind kind() const { return kind_; }
  bool is_supported() const { return kind_ != Kind::flying; }
  /// Nothing moves, not even a spin.
  bool is_at_rest() const;
  /// Time until the phase ends [s], > 0, maybe infinite. A flight ends at the landing.
  double duration() const { return duration_; }

  /// The state after `elapsed` [s], in [0, duration()].
  BodyState at(double elapsed) const;
  Vector3 position_at(double elapsed) const;
  /// The state at the end with what ended there exactly zero: the slip, the speed or the spin; on
  /// the plane exactly after a flight, the landing's impulse not included.
  BodyState at_end() const;

  const BodyState& start() const { return start_; }
  /// The path is x + v t + ½ a t².
  bool is_parabola() const { return decay_ == 0; }
  const Vector3& acceleration() const { return acceleration_; }

 private:
  void start_sliding(const Sphere& sphere, const SubstrateContact& contact, double gravity,
                     const Vector3& slip);
  void start_rolling(const SubstrateContact& contact, double gravity);

  /// Path length and speed on a rolling piece of the friction table.
  double rolled_distance(double elapsed) const;
  double rolling_speed(double elapsed) const;

  Kind kind_ = Kind::resting;
  BodyState start_;
  double radius_ = 0;
  bool turns_ = true;  // a block does not
  double duration_ = 0;
  double motion_duration_ = 0;  // until the slip, the rolling piece or the flight ends
  double spin_duration_ = 0;    // until the drilling ends
  Vector3 acceleration_ = Vector3::Zero();
  Vector3 angular_acceleration_ = Vector3::Zero();
  // Rolling: v̇ = −(deceleration_ + decay_ (v − speed_)).
  Vector3 direction_ = Vector3::Zero();
  double speed_ = 0;
  double deceleration_ = 0;
  double decay_ = 0;
  double end_speed_ = 0;
};

/// A normal impulse J [N s], >= 0, of the substrate on a body at once, in the limit of a short and
/// strong push: Coulomb friction acts on the slip (μ_k J at most), drilling friction on the spin,
/// and rolling friction with what is left of J once the body sticks. The vertical velocity stays.
void apply_substrate_impulse(const Sphere& sphere, const SubstrateContact& contact, double impulse,
                             BodyState& state);

/// Lands a body: its vertical velocity becomes −e v_z, or 0 where that is below `slowest_rebound`
/// [m/s], and the substrate's friction acts with the impulse m (1+e) |v_z|.
void land(const Sphere& sphere, const SubstrateContact& contact, double slowest_rebound,
          BodyState& state);

}  // namespace slipcheck
