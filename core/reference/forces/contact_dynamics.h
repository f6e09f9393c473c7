#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "reference/forces/contact_modes.h"

namespace slipcheck {

/// Numbers of the state of a body, and of a contact slot.
inline constexpr std::size_t kBody = 9, kSlot = 4;

/// The equations of motion of all bodies in their present modes, K (1)-(27) with B's and L's
/// forces.
///
/// State y, nine numbers a body: the centre, its height counted from that on the plane; the
/// velocity; the slip u_x, u_y and Ω_z. Heights and slips of their own keep the digits of the
/// smallest jump and of a slip that begins or dies out. Then four numbers a contact slot (overlap ξ
/// and tangential displacement ζ), the energy dissipated and the substrate's work since the start.
class ContactDynamics {
 public:
  explicit ContactDynamics(const ContactScene& scene);

  /// Forces on one body and what follows from them.
  struct BodyForces {
    Vector3 applied = Vector3::Zero();   ///< by gravity and other bodies [N]
    Vector3 torque = Vector3::Zero();    ///< by other bodies [N m]
    double normal = 0;                   ///< of the substrate [N], positive upwards
    Vector3 friction = Vector3::Zero();  ///< of the substrate, horizontal [N]
    /// What static friction has to hold of it [N]. Rolling friction that ends where the body slips
    /// cannot break it loose.
    Vector3 slip_load = Vector3::Zero();
    Vector3 acceleration = Vector3::Zero();
    Vector3 angular_acceleration = Vector3::Zero();
    /// What holding would take from a friction that holds or could: force against rolling away
    /// [N], or while sliding couple against turning [N m]; and that friction's limit.
    Vector3 roll_load = Vector3::Zero();
    double roll_limit = 0;
  };
  /// Forces in one contact.
  struct ContactForces {
    double normal = 0;   ///< F_N as the law gives it, also where clamped [N]
    double closing = 0;  ///< ξ̇ [m/s]
    Vector3 n = Vector3::Zero();
    Vector3 slip = Vector3::Zero();        ///< u_t [m/s]
    Vector3 tangential = Vector3::Zero();  ///< F_T on the first [N]
    double closing_rate = 0;               ///< ξ̈ [m/s²]
  };
  struct Evaluation {
    std::vector<BodyForces> bodies;
    std::vector<ContactForces> contacts;
    double dissipation = 0, work = 0;  ///< powers [W]
  };

  /// Below this speed [m/s] a friction that sliding and spin share falls off in proportion: what
  /// would stick creeps, and the direction of the friction stays defined.
  double creep_speed = 0;
  /// Well above this speed [m/s] a slip that has begun has a direction of its own; well below, that
  /// of the load which broke it loose.
  double onset_speed = 0;
  /// When the substrate's velocity next jumps [s]: until that event it is the one before.
  double next_kink;

  std::vector<BodyMode> modes;
  std::vector<ContactMode> contacts;
  std::size_t slots = 0;

  std::size_t size() const { return scene_->hard.bodies.size() * kBody + slots * kSlot + 2; }
  std::size_t slot_at(std::size_t slot) const {
    return scene_->hard.bodies.size() * kBody + slot * kSlot;
  }
  std::size_t dissipated_at() const { return size() - 2; }
  std::size_t work_at() const { return size() - 1; }

  /// All forces and accelerations; `out` is reused.
  void evaluate(double t, const double* y, Evaluation& out) const;
  /// ẏ.
  void right_side(double t, const double* y, double* rate);

  /// v_S [m/s].
  Vector3 substrate_velocity(double t) const;
  /// u = v + R k̂×Ω − v_S [m/s], horizontal.
  Vector3 slip(std::size_t i, const double* y) const {
    return {y[i * kBody + 6], y[i * kBody + 7], 0};
  }
  /// Ω [rad/s], from the slip.
  Vector3 angular_velocity(std::size_t i, double t, const double* y) const {
    return angular_velocity(i, substrate_velocity(t), y);
  }
  /// The slip [m/s] of a body with this state.
  Vector3 slip_of(std::size_t i, double t, const BodyState& state) const;
  /// v − v_S [m/s], horizontal.
  Vector3 relative_velocity(std::size_t i, double t, const double* y) const;
  /// From the centre of j to that of i [m].
  Vector3 between_centres(std::size_t i, std::size_t j, const double* y) const;
  /// What has the sign of dF_N/dt in a contact.
  double growth(const ContactMode& contact, const ContactForces& forces, const double* y) const {
    return force_growth(contact.law->normal, y[slot_at(contact.slot)], forces.closing,
                        forces.closing_rate);
  }
  /// Drilling is coupled to the sliding and takes part in it.
  bool is_coupled(std::size_t i) const { return scene_->hard.on_substrate(i).coupled_radius > 0; }

  /// Kinetic energy and that of gravity and of elastic contacts [J].
  double kinetic_energy(double t, const double* y) const;
  double potential_energy(const double* y) const;
  /// That of elastic contacts alone [J].
  double elastic_energy(const double* y) const;

 private:
  Vector3 angular_velocity(std::size_t i, const Vector3& substrate, const double* y) const;
  void add_contact(const ContactMode& contact, const Vector3& substrate, const double* y,
                   ContactForces& forces, Evaluation& out) const;
  void move(std::size_t i, double t, const Vector3& substrate, const double* y,
            Evaluation& out) const;
  Vector3 sticking_force(std::size_t i, const Vector3& substrate_acceleration,
                         const BodyForces& f) const;
  void slide(std::size_t i, const Vector3& substrate_acceleration, const Vector3& spin,
             const Vector3& slip, BodyForces& f, Evaluation& out) const;
  void roll(std::size_t i, const Vector3& relative, const Vector3& substrate_acceleration,
            BodyForces& f, Evaluation& out) const;

  const ContactScene* scene_;
  Evaluation scratch_;
};

}  // namespace slipcheck
