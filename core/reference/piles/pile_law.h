#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "physics/contact/contact_memory.h"
#include "physics/contact/hard_contact.h"
#include "physics/contact/normal_force.h"
#include "physics/contact/sticking_spring.h"
#include "physics/frame.h"
#include "reference/spring_speeds.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// The friction of the impact that a hard contact is, L (5)-(12).
struct PileImpactLaw {
  double sliding_mass = 0;            ///< κ m_eff [kg]
  double tangential_restitution = 0;  ///< β0 [-]
  FrictionLaw friction;               ///< μ
};

/// All forces of one contact of a body with another, the substrate or a surface.
struct PileLaw {
  NormalForce normal;
  bool clamped = true;                ///< ContactEnd::zero_force
  std::optional<PileImpactLaw> hard;  ///< which it stands for; the normal force is linear
  double most_overlap = 0;            ///< beyond which nothing is meant to overlap [m], > 0
  double deepest = 1;                 ///< the same over the smaller radius [-], > 0
  SpringFriction sliding;
  SpringTorque rolling, drilling;
  /// Over the speed of the centre, of `rolling.length` [m] in place of a constant; null: none.
  const RollingFriction* rolling_table = nullptr;
  double rolling_lever = 0;  ///< length over that coefficient [m]
  /// Rolling resistance acts on what slides, too.
  bool rolls_while_sliding = true;

  bool resists_rolling() const { return rolling.length > 0 || rolling_table; }
  /// Against rolling at this speed of the centre [m/s] where it is pressed so [N].
  SpringNow rolling_at(double pressed, double speed) const {
    SpringNow now = rolling.at(pressed);
    if (rolling_table) now.holds = now.slides = rolling_lever * (*rolling_table)(speed)*pressed;
    return now;
  }
};

/// The laws of a scene's contacts: soft ones as they are, hard ones as linear ones that last.
///
/// A hard contact gets the spring and dashpot whose collisions take collision_time() and rebound
/// with its e_n, at least least_restitution, and that end with their force. For as long as a
/// collision takes it has the friction of an impact, which leaves −β0 of a slip that sticks, none
/// of it on the substrate; from then on a tangential spring that would have left the same
/// (sticking_spring.h); and, up to their own caps, springs against rolling and drilling as stiff as
/// that one at the distance R_eff and critically damped. A hard pair with β0 = −1 has no friction.
class PileLaws {
 public:
  static constexpr double kLeastRestitution = 1e-2;

  /// `scene` must outlive the laws; collision_time [s], > 0, and least_restitution, in (0, 1], of
  /// hard contacts. Throws Unsupported for what has no counterpart here.
  PileLaws(const ContactScene& scene, double collision_time,
           double least_restitution = kLeastRestitution);

  double collision_time() const { return collision_time_; }
  bool has_hard() const { return has_hard_; }  ///< one of them is taken as lasting
  bool is_linear() const { return linear_; }   ///< so are all normal forces
  bool turns() const { return turns_; }        ///< rolling or drilling is resisted somewhere
  /// Where all normal forces are linear: bodies are soft for each other, no contact attracts, and
  /// what is against sliding is nothing or a spring of one stiffness, with a dashpot of its own.
  bool is_plain() const { return plain_; }

  /// Of a body and what Touch::second names: a body, the substrate or a surface.
  PileLaw of(std::size_t body, int second) const;

  /// By body, the fastest of its contacts with the substrate and the surfaces.
  std::vector<SpringSpeeds> spring_speeds() const;

  /// The shortest half period [s] of a contact's springs, over all bodies.
  double shortest_contact() const;

 private:
  /// A hard contact per reduced mass and per mass κ m_eff that slides.
  struct Hard {
    double stiffness = 0, damping = 0;
    StickingSpring sticking;
  };

  Hard hard(const PairContact& contact) const;
  SpringSpeeds spring_speeds_of(std::size_t body) const;
  PileLaw of_hard(const Hard& hard, const PairContact& contact, double mass, double kappa) const;
  PileLaw of_soft(const SoftContact& contact) const;
  void resist(const SubstrateContact& contact, const Sphere& sphere, PileLaw& law) const;
  void look_at(const PileLaw& law);

  const ContactScene* scene_;
  double collision_time_, least_restitution_;
  std::vector<std::optional<Hard>> pairs_;        ///< by row × row of the scene's
  std::vector<Hard> on_substrate_;                ///< by material
  std::vector<std::optional<Hard>> on_surfaces_;  ///< by material × surface
  bool has_hard_ = false, linear_ = true, turns_ = false, plain_ = true;
};

/// The duration of hard contacts' collisions [s]: 1e-3 of the time in which the scene's smallest
/// body falls, or moves, by its own radius; in scenes of more than ten bodies longer in proportion
/// to their number, up to ten times that.
double pile_collision_time(const ContactScene& scene);

}  // namespace slipcheck
