#pragma once

#include <cstddef>
#include <vector>

#include "bullet_backend/bullet_settings.h"
#include "bullet_backend/periodic_cell.h"
#include "physics/frame.h"
#include "scene/scene.h"

/// A scene's coefficients in Bullet's terms. Bullet's solver knows four numbers of a contact:
///   friction           μ, |tangential impulse| <= μ λ_n
///   restitution        e
///   rolling friction   a length ρ: |torque impulse| <= ρ λ_n in the plane of contact. Of rigid
///                      bodies <= ρ min(λ_n, 1) about each of two fixed axes
///   spinning friction  a length likewise, about the normal; of rigid bodies left out where ρ = 0
/// with λ_n the contact's normal impulse in whatever units
/// (btSequentialImpulseConstraintSolver.cpp, convertContact and solveSingleIteration;
/// btMultiBodyConstraintSolver.cpp, solveSingleIteration).
namespace slipcheck::bullet {

/// What stands in the place of a body's index where a ball touches no other ball: the substrate or
/// the floor of a box, either of its walls, its lid. Where there is no box, what is below
/// kSubstrate is a surface_touch().
inline constexpr int kFloor = kSubstrate, kWall = -2, kLid = -3;

/// The four numbers of a contact, or those that people type into a body's own fields.
struct BodyFields {
  double friction = 0.5;
  double restitution = 0;
  double rolling_friction = 0;
  double spinning_friction = 0;
};

/// The exact map: pair by pair, what makes Bullet's contact do what the scene says. Lengths, times
/// and masses in the units of the scene that it is given.
class PairCoefficients {
 public:
  /// Steps of `time_step`, > 0, in which the substrate gives a resting body λ_n = m g dt.
  PairCoefficients(const Scene& scene, const BulletSettings& settings, double time_step);

  /// Further steps are of another length, > 0.
  void set_time_step(double time_step);

  /// Of the substrate, in the world's axes: slip and speed on it count from here.
  void set_ground_velocity(const Vector3& velocity) { ground_velocity_ = velocity; }
  const Vector3& ground_velocity() const { return ground_velocity_; }

  /// Between a body and another, kFloor, kWall, kLid, or a surface [-], where they slip at a speed.
  /// A contact that does not slip has its static friction where the settings tell the two apart.
  double friction(int body, int other, bool slips, double slip_speed = 0) const;
  /// Whether it depends on how fast the surfaces slip.
  bool has_friction_law(int body, int other) const;

  /// At the normal approach speed, >= 0 [-]. A multibody has this step's gravity when Bullet looks
  /// at its velocity: on a floor it would part with e (v + g dt), hence e v/(v + g dt).
  double restitution(int body, int other, double approach_speed) const {
    return restitution(body, other, approach_speed, gravity_onto(other));
  }
  /// The same where gravity pulls with `onto` towards what it touches, as surfaces lie in all ways.
  double restitution(int body, int other, double approach_speed, double onto) const;

  /// On the substrate or a surface at a speed; between bodies and in a box 0. K (16): a rolling
  /// sphere slows down with μ_r g. With a torque of ρ m g it slows down with ρ g/((1 + q) R), q =
  /// I/(m R²), hence ρ = (1 + q) μ_r R.
  double rolling_friction(int body, int other, double speed, bool slips) const;

  /// On the substrate or a surface the torque about the normal per normal force; between bodies and
  /// in a box 0.
  double spinning_friction(int body, int other) const;

  /// All four where none of them depends on how the body moves over the substrate, so that nobody
  /// needs to look; else null.
  const BodyFields* fixed(int body, int other) const {
    return is_substrate(other) && !fixed_.empty() ? &fixed_[index(body)] : nullptr;
  }

  /// Whether a contact with the substrate slips at this speed: faster than friction can stop in
  /// the step, in which u falls by (1 + 1/q) μ_k g dt.
  bool slips(int body, double slip_speed) const {
    return slips(body, kSubstrate, slip_speed, scene_.gravity);
  }
  /// The same on the substrate or a surface onto which gravity pulls with `onto`, >= 0. All else,
  /// where it makes no difference, slips.
  bool slips(int body, int other, double slip_speed, double onto) const;

  /// Along the world's axes as Bullet has it.
  void set_gravity(const Vector3& gravity) { gravity_ = gravity; }
  const Vector3& gravity() const { return gravity_; }
  /// Across whose edges balls meet; none repeats at first.
  void set_cell(const PeriodicCell& cell) { cell_ = cell; }
  const PeriodicCell& cell() const { return cell_; }

  const Sphere& body(int index) const { return scene_.bodies[static_cast<std::size_t>(index)]; }

  /// m g dt > 1: there min(λ_n, 1) would cut the two torques, and they are raised by m g dt.
  /// Right for a body at rest on the plane, wrong by the ratio of its load to its weight otherwise.
  bool is_cut(int body) const { return raise_[index(body)] > 1; }

 private:
  /// What two balls do, or a ball and a box.
  const PairContact& pair_contact(int body, int other) const;
  bool is_substrate(int other) const { return other == kSubstrate && !scene_.box; }
  bool is_surface(int other) const { return other < kSubstrate && !scene_.box; }
  /// Of a body on the substrate or a surface; null elsewhere.
  const SubstrateContact* lasting_contact(int body, int other) const;
  bool depends_on_motion() const;
  /// Gravity towards a surface.
  double gravity_onto(int other) const;
  static std::size_t index(int body) { return static_cast<std::size_t>(body); }

  Scene scene_;
  BulletSettings settings_;
  double time_step_ = 0;
  PeriodicCell cell_;
  Vector3 ground_velocity_ = Vector3::Zero(), gravity_ = Vector3::Zero();
  std::vector<double> raise_;      // max(1, m g dt), by body
  std::vector<BodyFields> fixed_;  // by body; empty where one of them depends on motion
};

/// The scene's numbers straight: a ball gets μ_k and μ_r of its contact with the substrate, or
/// where there is none with the first surface, its drilling length, and the restitution with the
/// first other body (with the substrate when alone). In a box it gets μ and restitution of its
/// contact with the first other body (with the floor when alone). A power law gives its value at
/// its reference speed, a table of restitutions that at the speed at which the two start relative
/// to each other, a table of μ_r its first entry.
BodyFields naive_ball(const Scene& scene, std::size_t body);

/// μ_k and restitution of the first body's contact with the substrate or a surface, or μ and
/// restitution of its contact with the box at kFloor, kWall or kLid.
BodyFields naive_surface(const Scene& scene, int surface);

}  // namespace slipcheck::bullet
