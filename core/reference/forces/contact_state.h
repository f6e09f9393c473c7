#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/contact/collision.h"
#include "reference/forces/contact_dynamics.h"
#include "reference/initial_contacts.h"

namespace slipcheck {

/// What counts as nothing, from the scene's scales and the tolerance of the integration.
struct ContactScales {
  double speed = 0;             ///< of the scene, speed_scale() [m/s], > 0
  double slip_floor = 0;        ///< slower than this is no slip [m/s]
  double rebound_fraction = 0;  ///< collapse_fraction of EventSettings
  double slowest_landing = 0;   ///< as of EventSettings [m/s]
};

/// The state of all bodies with the modes they are in, and the changes of mode at events.
class ContactState {
 public:
  /// The contacts of `overlapping` begin at the start, with nothing bent yet.
  ContactState(const ContactScene& scene, std::span<const BodyState> initial, double time,
               const ContactScales& scales, std::span<const InitialContact> overlapping = {});

  const ContactScene& scene() const { return *scene_; }
  ContactDynamics& dynamics() { return dynamics_; }
  const ContactDynamics& dynamics() const { return dynamics_; }
  const ContactDynamics::Evaluation& evaluation() const { return evaluation_; }
  const ContactScales& scales() const { return scales_; }

  double time = 0;
  std::vector<double> y;

  BodyState body(std::size_t i) const;
  std::vector<BodyState> bodies() const;

  // --- events ------------------------------------------------------------------------------------
  /// Two bodies that touch, or overlap by this much [m] from the start.
  void begin_contact(std::size_t i, std::size_t j, double overlap = 0);
  void end_contact(std::size_t contact);
  /// zero_force: the force is gone, or comes back, while the bodies overlap.
  void clamp_contact(std::size_t contact);
  void release_contact(std::size_t contact);
  /// A viscous contact that begins at rest has no root at Coulomb's cap: its force and its cap grow
  /// from zero together. Whether one is found beyond its cap, and now is at it; after evaluate().
  bool reach_caps();
  /// Goes on to the next piece of a contact's tangential law.
  void cross_edge(std::size_t contact, TangentialEdge edge, bool rises);
  /// What counts as nothing between two bodies that rest against each other: a gap [m], a speed
  /// [m/s] and a part of what accelerates them.
  struct Rest {
    double gap, speed, push;
  };
  Rest rest_of(std::size_t i, std::size_t j) const;
  /// Whether two bodies that touch approach each other.
  bool meet(std::size_t i, std::size_t j) const;
  /// The hard contact of a pair acts at this instant.
  CollisionResult collide_now(std::size_t i, std::size_t j);
  /// Of bodies that were left together by an impact and that another one drives into each other,
  /// those that approach fastest collide, until none does.
  void hand_impulses_on();
  void land_now(std::size_t i);
  void lift_off(std::size_t i);
  /// The slip has come to zero: the body sticks if static friction holds it. A slip that merely
  /// turned right round goes on.
  void end_slip(std::size_t i);
  void begin_slip(std::size_t i);
  void end_roll(std::size_t i);
  void begin_roll(std::size_t i);
  void end_spin(std::size_t i);
  void begin_spin(std::size_t i);
  /// After the velocity of the substrate jumped.
  void feel_substrate_jump();

  /// Brings evaluation() up to the present state.
  void evaluate() { dynamics_.evaluate(time, y.data(), evaluation_); }
  /// Makes all modes agree with the forces: what cannot hold gives way.
  void settle();
  /// Keeps the reference directions of dry friction close to the present ones.
  void follow_directions();
  /// Sets what rolling and resting bodies obey exactly, free of the integrator's drift.
  void project();

  bool in_contact(std::size_t i) const;
  /// Slides with a slip that counts; sliding coupled to a spin dies out and never ends by itself.
  bool slides(std::size_t i) const;
  bool rests(std::size_t i) const;
  /// No two bodies in contact still press into each other or part; as of the last evaluate().
  bool only_leans() const;

 private:
  double approach_speed(std::size_t i, std::size_t j) const;
  double leaning_speed() const { return 1e-9 * scales_.speed; }
  void place(std::size_t i);
  void set_body(std::size_t i, const BodyState& state);
  void set_rolling(std::size_t i);
  void project(std::size_t i);
  bool give_way(std::size_t i);
  void account_impulse(double energy_before, const Vector3& momentum_before,
                       std::span<const std::size_t> bodies);
  Vector3 momentum(std::span<const std::size_t> bodies) const;

  const ContactScene* scene_;
  ContactScales scales_;
  ContactDynamics dynamics_;
  ContactDynamics::Evaluation evaluation_;
  std::vector<std::size_t> free_slots_;
  std::vector<double>
      hardest_impact_;  ///< of each body, the normal speed of its hard collisions [m/s]
};

}  // namespace slipcheck
