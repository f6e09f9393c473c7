#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "physics/contact/coupled_friction.h"
#include "physics/contact/hard_contact.h"
#include "physics/motion/substrate_phase.h"
#include "physics/sphere.h"

namespace slipcheck {

/// What bodies of one material and size have in common.
struct StepKind {
  double inverse_mass = 0;     ///< 1/m [1/kg]
  double inverse_inertia = 0;  ///< 1/I [1/(kg m²)]
  double weight = 0;           ///< m g along −z [N]
  double inverse_radius = 0;   ///< [1/m]
  double share = 0;            ///< 1/(1+A): the slip that reaches the centre when a body sticks [-]
  double turn = 0;             ///< A/R: |ΔΩ| for each |Δv| by friction [1/m]
  Sphere sphere;
  const SubstrateContact* contact = nullptr;
  bool coulomb_alone = false;  ///< nothing else of the substrate need be looked at
};

/// One sphere in the fixed-step solver. Velocities lie half a step before the positions. What says
/// which bodies touch lies in one line of the cache. A step waits for what the one before wrote,
/// and the processor hands that on only to a load of what was written at once: x and y of a vector
/// lie in one line, and those that are set to zero together not side by side, where they would be
/// written across each other's ends.
struct alignas(64) StepBody {
  Vector3 position = Vector3::Zero();  ///< x_n [m]
  double radius = 0;                   ///< R [m]
  Vector3 velocity = Vector3::Zero();  ///< v_{n−1/2} [m/s]
  const StepKind* kind = nullptr;
  /// What the last step changed: half of it more is the velocity predicted for the positions' time.
  Vector3 velocity_change = Vector3::Zero();
  Vector3 force = Vector3::Zero();             ///< by other bodies [N]
  Vector3 angular_velocity = Vector3::Zero();  ///< Ω_{n−1/2} [rad/s]
  Vector3 angular_velocity_change = Vector3::Zero();
  Vector3 torque = Vector3::Zero();  ///< by other bodies [N m]
  bool supported = false;            ///< on the substrate
  bool sticks = false;               ///< to it: no slip
  float bounced = 0;  ///< while it flies: impulse by the substrate in the last step [N s]

  void forget_forces() {
    force.setZero();
    torque.setZero();
  }
};
static_assert(sizeof(StepBody) == 192, "three lines of the cache");

/// What acts on all bodies alike.
struct StepSurroundings {
  double gravity = 0;                         ///< along −z [m/s²]
  Vector2 downhill = Vector2::Zero();         ///< along the plane [m/s²]
  Vector2 velocity_before = Vector2::Zero();  ///< v_S where the velocities come from [m/s]
  Vector2 velocity = Vector2::Zero();         ///< v_S where they go to [m/s]
  bool confined = false;
};

/// A level, still substrate without friction that no body leaves.
struct BareSubstrate {};
/// A level, still substrate with Coulomb friction alone.
struct PlainSubstrate {};
/// Everything: tilt, motion, rolling and drilling friction.
struct FullSubstrate {};

/// Whether the substrate takes the slip and nothing else.
inline bool is_coulomb_alone(const SubstrateContact& contact) {
  return contact.rolling.is_zero() && !(contact.drilling_length > 0) &&
         !(contact.coupled_radius > 0);
}

/// Rolling friction of a body that sticks, K (16): it takes μ_r |N|/m dt from the velocity relative
/// to the substrate, and all of it at most. The couple (1+q) μ_r |N| R and the static friction it
/// calls for do the same to the centre. Returns the change [m/s].
inline Vector2 rolling_change(const StepKind& kind, const Vector2& relative, double load) {
  if (kind.contact->rolling.is_zero()) return Vector2::Zero();
  const double speed = relative.norm();
  if (!(speed > 0)) return Vector2::Zero();
  const double lost = std::min(speed, kind.contact->rolling(speed) * load * kind.inverse_mass);
  return (-lost / speed) * relative;
}

/// The slip that the last step lets expect in the middle of this one, with the substrate velocities
/// in it. It does not wait for the forces of now.
struct ExpectedSlip {
  Vector2 slip = Vector2::Zero();  ///< [m/s]
  double size = 0, inverse = 0;    ///< |slip| [m/s] and 1/|slip|

  void set(const Vector2& expected) {
    slip = expected;
    size = slip.norm();
    inverse = 1 / size;
  }
  static ExpectedSlip along(const Vector2& slip) {
    ExpectedSlip expected;
    expected.set(slip);
    return expected;
  }
};

template <class Substrate>
[[gnu::always_inline]] inline Vector2 expected_slip(const StepBody& b, const StepSurroundings& s) {
  const Vector3 velocity = b.velocity + 0.5 * b.velocity_change;
  const Vector3 spin = b.angular_velocity + 0.5 * b.angular_velocity_change;
  Vector2 slip(velocity.x() - b.radius * spin.y(), velocity.y() + b.radius * spin.x());
  if constexpr (std::is_same_v<Substrate, FullSubstrate>) {
    // component by component: of sums of vectors the compiler leaves calls
    slip.x() -= 0.5 * (s.velocity_before.x() + s.velocity.x());
    slip.y() -= 0.5 * (s.velocity_before.y() + s.velocity.y());
  }
  return slip;
}

/// Takes |lost| from a rate at most down to zero.
inline double towards_zero(double rate, double lost) {
  return std::copysign(std::max(0.0, std::abs(rate) - lost), rate);
}

/// Whether friction that takes `friction` from v [m/s] may act against the slip that was expected,
/// where u is the one at hand. Not if that is turned by more than a right angle. Nor if friction
/// takes all of it in a step and more: where the substrate's acceleration keeps such a slip up, it
/// would jump from side to side for as long.
[[gnu::always_inline]] inline bool follows(const StepKind& kind, const Vector2& expected,
                                           const Vector2& u, double friction) {
  return expected.dot(u) > 0 &&
         kind.share * kind.share * expected.squaredNorm() > friction * friction;
}

/// The friction of the substrate over dt on a body with the velocities `v`, `w` that all other
/// forces gave it, K (11)-(19), (22)-(27). load = |N| dt [N s]. With the slip u that the other
/// forces leave, the impulse −m u/(1+A) makes the body stick; it does if the impulse is within
/// μ_s |N| dt (μ_k for a body that slides), else μ_k |N| dt acts against the slip: friction may
/// stop the slip within a step but not reverse it.
///
/// This is what Coulomb's friction does alone. expected: gives the ExpectedSlip.
template <class Substrate, class Expected>
[[gnu::always_inline]] inline void rub_alone(StepBody& b, const StepKind& kind,
                                             const StepSurroundings& s, double load,
                                             const Expected& expected, Vector3& v, Vector3& w) {
  constexpr bool kMoves = std::is_same_v<Substrate, FullSubstrate>;
  const SubstrateContact& c = *kind.contact;
  Vector2 u(v.x() - b.radius * w.y(), v.y() + b.radius * w.x());
  if constexpr (kMoves) u -= s.velocity;
  const Vector2 stop = kind.share * u;
  const double per_slip = load * kind.inverse_mass;  // (1+A) times this is taken from the slip
  const double cap = (b.sticks ? c.static_friction : c.kinetic_friction) * per_slip;
  b.sticks = stop.squaredNorm() <= cap * cap;
  if (b.sticks) {
    Vector2 relative = v.head<2>() - stop;
    if constexpr (kMoves) {
      relative -= s.velocity;
      v.head<2>() = s.velocity + relative;
    } else {
      v.head<2>() = relative;
    }
    w.head<2>() = Vector2(-relative.y(), relative.x()) * kind.inverse_radius;
    return;
  }
  // Friction acts against the slip that is expected, so that a turning slip is followed to second
  // order; where that says nothing, against the one at hand.
  const ExpectedSlip& hoped_for = expected();
  double x = hoped_for.slip.x(), y = hoped_for.slip.y(), inverse = hoped_for.inverse;
  const double friction = c.kinetic_friction * per_slip;
  if (!follows(kind, hoped_for.slip, u, friction)) [[unlikely]]
    x = u.x(), y = u.y(), inverse = 1 / u.norm();
  const double change = friction * inverse;
  const double turn = change * kind.turn;
  v.x() -= change * x;
  v.y() -= change * y;
  w.x() -= turn * y;
  w.y() += turn * x;
}

/// The same with all else that a substrate does to a body.
template <class Expected>
inline void rub_and_roll(StepBody& b, const StepKind& kind, const StepSurroundings& s, double load,
                         const Expected& expected, Vector3& v, Vector3& w) {
  const SubstrateContact& c = *kind.contact;
  const double R = b.radius;
  const auto slip = [R](const Vector3& velocity, const Vector3& spin,
                        const Vector2& substrate) -> Vector2 {
    return Vector2(velocity.x() - R * spin.y(), velocity.y() + R * spin.x()) - substrate;
  };
  const double spin = std::abs(b.angular_velocity.z() + 0.5 * b.angular_velocity_change.z());
  const bool shares_friction = c.coupled_radius > 0 && spin > 0;
  const double per_slip = load * kind.inverse_mass;
  Vector2 u = slip(v, w, s.velocity);
  double drilling = c.drilling_length * load;

  // A disc that spins has no static friction: it creeps.
  const double held_by = shares_friction ? 0 : b.sticks ? c.static_friction : c.kinetic_friction;
  const Vector2 sticking = -kind.share * u;
  const Vector2 held = v.head<2>() + sticking - s.velocity;
  const Vector2 rolling = rolling_change(kind, held, load);
  // Rolling friction that ends where the body slips cannot break it loose.
  const Vector2 load_on_stick = c.rolling_while_sliding ? Vector2(sticking + rolling) : sticking;
  const double cap = held_by * per_slip;
  b.sticks = load_on_stick.squaredNorm() <= cap * cap;
  if (b.sticks) {
    const Vector2 relative = held + rolling;
    v.head<2>() = s.velocity + relative;
    w.x() = -relative.y() * kind.inverse_radius;
    w.y() = relative.x() * kind.inverse_radius;
  } else {
    if (c.rolling_while_sliding) {
      // The couple (1+q) μ_r |N| R against the rolling rate; 1+q = 1/(1 − 1/(1+A)).
      const double rate = w.head<2>().norm();
      if (rate > 0) {
        const double couple = c.rolling(R * rate) * load * R / (1 - kind.share);
        w.head<2>() *= std::max(0.0, 1 - couple * kind.inverse_inertia / rate);
        u = slip(v, w, s.velocity);
      }
    }
    ExpectedSlip against = expected();
    double friction = c.kinetic_friction * per_slip;
    if (!follows(kind, against.slip, u, friction)) against = ExpectedSlip::along(u);
    if (shares_friction) {
      const CoupledFriction shared =
          coupled_friction(c.hertzian_pressure ? DiscPressure::hertzian : DiscPressure::uniform,
                           against.size, c.coupled_radius * spin);
      friction *= shared.force;
      drilling = c.kinetic_friction * load * c.coupled_radius * shared.torque;
    }
    // As much along it as rub_alone() takes, with the same roundings.
    double change = 0;
    if (friction * friction >= (kind.share * u).squaredNorm()) {
      against.slip = u;
      change = kind.share;
      b.sticks = !shares_friction;
    } else if (against.size > 0) {
      change = friction * against.inverse;
    }
    const double turn = change * kind.turn;
    v.head<2>() -= change * against.slip;
    w.x() -= turn * against.slip.y();
    w.y() += turn * against.slip.x();
  }
  w.z() = towards_zero(w.z(), drilling * kind.inverse_inertia);
}

template <class Substrate, class Expected>
[[gnu::always_inline]] inline void rub(StepBody& b, const StepKind& kind, const StepSurroundings& s,
                                       double load, const Expected& expected, Vector3& v,
                                       Vector3& w) {
  if (std::is_same_v<Substrate, PlainSubstrate> || kind.coulomb_alone) {
    rub_alone<Substrate>(b, kind, s, load, expected, v, w);
  } else {
    rub_and_roll(b, kind, s, load, expected, v, w);
  }
}

[[gnu::always_inline]] inline double kick_freely(StepBody& b, const StepKind& kind, double dt) {
  const Vector3 w = b.angular_velocity + (dt * kind.inverse_inertia) * b.torque;
  const double vx = b.velocity.x() + (dt * kind.inverse_mass) * b.force.x();
  const double vy = b.velocity.y() + (dt * kind.inverse_mass) * b.force.y();
  const double impulse = std::abs(kind.weight - b.force.z()) * dt;
  b.velocity_change = Vector3(vx, vy, 0) - b.velocity;
  b.angular_velocity_change = w - b.angular_velocity;
  b.velocity = {vx, vy, 0};
  b.angular_velocity = w;
  b.sticks = vx == b.radius * w.y() && vy == -b.radius * w.x();
  return impulse;
}

template <class Substrate, class Expected>
[[gnu::always_inline]] inline double kick_and_rub(StepBody& b, const StepKind& kind,
                                                  const StepSurroundings& s, double dt,
                                                  const Expected& expected) {
  Vector3 v = b.velocity + (dt * kind.inverse_mass) * b.force;
  Vector3 w = b.angular_velocity + (dt * kind.inverse_inertia) * b.torque;
  if constexpr (std::is_same_v<Substrate, FullSubstrate>) {
    v.x() += dt * s.downhill.x();
    v.y() += dt * s.downhill.y();
  }
  double impulse = 0;
  if (b.supported) {
    const double normal = kind.weight - b.force.z();
    if (normal >= 0 || s.confined) {
      v.z() = 0;
      impulse = std::abs(normal) * dt;
      rub<Substrate>(b, kind, s, impulse, expected, v, w);
    } else {
      b.supported = b.sticks = false;
      b.bounced = 0;
      v.z() -= dt * s.gravity;
    }
  } else {
    b.bounced = 0;
    v.z() -= dt * s.gravity;
  }
  b.velocity_change = v - b.velocity;
  b.angular_velocity_change = w - b.angular_velocity;
  b.velocity = v;
  b.angular_velocity = w;
  return impulse;
}

/// The velocities of a body dt later, under the forces of now. Returns what the substrate presses
/// it with meanwhile [N s]. expected: gives the ExpectedSlip.
template <class Substrate, class Expected>
[[gnu::always_inline]] inline double kick(StepBody& b, const StepKind& kind,
                                          const StepSurroundings& s, double dt,
                                          const Expected& expected) {
  if constexpr (std::is_same_v<Substrate, BareSubstrate>)
    return kick_freely(b, kind, dt);
  else
    return kick_and_rub<Substrate>(b, kind, s, dt, expected);
}

template <class Substrate>
[[gnu::always_inline]] inline double kick(StepBody& b, const StepKind& kind,
                                          const StepSurroundings& s, double dt) {
  return kick<Substrate>(b, kind, s, dt,
                         [&] { return ExpectedSlip::along(expected_slip<Substrate>(b, s)); });
}

/// A body that came down on the substrate within the last step lands, in the substrate's frame.
inline void land_after_drift(StepBody& b, const StepKind& kind, const StepSurroundings& s,
                             double slowest_rebound) {
  const Vector3 substrate(s.velocity.x(), s.velocity.y(), 0);
  const double late = std::min((b.radius - b.position.z()) / -b.velocity.z(), 1.0);
  BodyState state{b.position, b.velocity - substrate, b.angular_velocity};
  land(kind.sphere, *kind.contact, slowest_rebound, state);
  b.bounced = static_cast<float>((state.velocity.z() - b.velocity.z()) / kind.inverse_mass);
  b.velocity = state.velocity + substrate;
  b.angular_velocity = state.angular_velocity;
  b.velocity_change.setZero();
  b.angular_velocity_change.setZero();
  b.supported = !(b.velocity.z() > 0);
  b.position.z() = b.radius + (b.supported ? 0 : b.velocity.z() * late);
  const double slip = slip_velocity(state, b.radius).head<2>().norm();
  b.sticks = b.supported &&
             slip <= 1e-14 * (state.velocity.norm() + b.radius * state.angular_velocity.norm());
}

}  // namespace slipcheck
