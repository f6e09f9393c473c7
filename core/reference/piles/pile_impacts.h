#pragma once

#include <algorithm>

#include "reference/piles/pile_contact.h"
#include "reference/piles/pile_loop.h"

namespace slipcheck {

/// What hard contacts of piles do as long as they may be impacts and no more: friction without
/// springs, whose sum is that of the hard rule, L (5)-(12), whatever the course of F_N.
template <bool kTurns>
class PileImpacts {
 public:
  using Contact = PileContact<kTurns>;

  /// time: now [s].
  PileImpacts(const PileWorld& world, double time) : world_(&world), time_(time) {}

  /// Of two that touch from now on.
  PileImpact begin(const PileLaw& law, const PileMotion& m) const {
    if (!law.hard || !(m.closing > 0) || law.sliding.static_friction == 0 || world_->dilates)
      return {};
    return {time_ + world_->laws->collision_time(), friction_at(law.hard->friction, m.slip.norm()),
            -law.hard->tangential_restitution * m.slip};
  }

  /// Coulomb's friction on what the slip is above what sticking leaves of it.
  Vector3 slide(Contact& c, const PileMotion& m, double pressed, double way, double& lost) const {
    const Vector3 excess = m.slip - c.impact.leaves;
    const double mass = c.law->hard->sliding_mass, cap = c.impact.friction * pressed;
    const Vector3 force = grip(excess, mass, cap);
    c.sliding.slides = stops(excess.norm(), mass) > cap;
    lost -= 0.5 * way * work_of(Vector3(c.sliding_dashpot + force), m.slip_before);
    c.sliding_dashpot = force;
    return force;
  }

  PileCouples turn(Contact& c, const PileMotion& m, double pressed, double way,
                   double& lost) const {
    const PileBody& a = world_->bodies[c.first];
    const PileLaw& law = *c.law;
    const double about = m.spin.dot(m.normal), about_before = m.spin_before.dot(m.normal);
    PileCouples couples;
    if (law.resists_rolling() && (!c.sliding.slides || law.rolls_while_sliding)) {
      const double inertia =
          law.rolls_while_sliding ? a.inertia : a.mass * a.radius * law.rolling_lever;
      couples.rolling =
          grip(m.spin - about * m.normal, inertia, law.rolling_at(pressed, m.speed).holds);
    }
    if (law.drilling.length > 0)
      couples.drilling = grip(about * m.normal, a.inertia, law.drilling.length * pressed);
    const double drilling = couples.drilling.dot(m.normal);
    lost -= 0.5 * way *
            (work_of(Vector3(c.rolling_dashpot + couples.rolling), m.spin_before) +
             work_of(c.drilling_dashpot + drilling, about_before));
    c.rolling_dashpot = couples.rolling;
    c.drilling_dashpot = drilling;
    return couples;
  }

  /// It has become a contact that lasts, whose springs go on with its forces.
  void end(Contact& c, double& lost) const {
    c.impact.until = 0;
    c.stiffness = c.law->sliding.stiffness;
    lost -= hand_over(c.stiffness, c.sliding, c.sliding_dashpot);
    if constexpr (kTurns) {
      lost -= hand_over(c.law->rolling.stiffness, c.rolling, c.rolling_dashpot);
      lost -= hand_over(c.law->drilling.stiffness, c.drilling, c.drilling_dashpot);
    }
  }

 private:
  /// What takes half of a motion in a step that moves `inertia` [kg] or [kg m²].
  double stops(double rate, double inertia) const { return 0.5 * inertia * rate / world_->step; }
  /// Against such a motion: so much, up to the cap.
  Vector3 grip(const Vector3& rate, double inertia, double cap) const {
    const double size = rate.norm();
    if (size == 0) return Vector3::Zero();
    return -std::min(cap, stops(size, inertia)) / size * rate;
  }

  /// Returns what the spring then has.
  template <class V>
  static double hand_over(double stiffness, SpringMemory<V>& spring, V& force) {
    if (stiffness == 0) return 0;
    spring.stretch = V((-1 / stiffness) * force);
    force = V(0 * force);
    return spring_energy(stiffness, spring.stretch);
  }

  const PileWorld* world_;
  double time_;  ///< now [s]
};

}  // namespace slipcheck
