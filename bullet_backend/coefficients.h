#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "physics/frame.h"
#include "scenario/hard_scene.h"

/// A scene's coefficients in Bullet's terms. Bullet's solver knows four numbers of a contact:
///   friction           μ, |tangential impulse| <= μ λ_n
///   restitution        e
///   rolling friction   a length ρ: |torque impulse| <= ρ min(λ_n, 1) about each of two fixed axes
///                      in the plane of contact
///   spinning friction  a length likewise, about the normal; left out where ρ = 0
/// with λ_n the contact's normal impulse in whatever units [N s here]
/// (btSequentialImpulseConstraintSolver.cpp, convertContact and solveSingleIteration).
namespace slipcheck::bullet {

/// What stands in the place of a body's index where a ball touches no other ball: the substrate or
/// the floor of a box, either of its walls, its lid.
inline constexpr int kFloor = kSubstrate, kWall = -2, kLid = -3;

/// The exact map: pair by pair, what makes Bullet's contact do what the scene says.
class PairCoefficients {
 public:
  /// Steps of `time_step` [s], > 0, in which the substrate gives a resting body λ_n = m g dt.
  PairCoefficients(const HardScene& scene, double time_step);

  /// Between a body and another, or kFloor, kWall, kLid [-].
  double friction(int body, int other) const;

  /// At the normal approach speed [m/s], >= 0 [-].
  double restitution(int body, int other, double approach_speed) const;

  /// On the substrate at a speed [m/s]; between bodies and in a box 0 [m].
  /// K (16): a rolling sphere slows down with μ_r g. With a torque of ρ m g it slows down with
  /// ρ g/((1 + q) R), q = I/(m R²), hence ρ = (1 + q) μ_r R.
  double rolling_friction(int body, int other, double speed) const;

  /// On the substrate the torque about the vertical per normal force; between bodies and in a
  /// box 0 [m].
  double spinning_friction(int body, int other) const;

  /// m g dt > 1 N s: there min(λ_n, 1) would cut the two torques, and they are raised by m g dt.
  /// Right for a body at rest on the plane, wrong by the ratio of its load to its weight otherwise.
  bool is_cut(int body) const { return raise_[index(body)] > 1; }

 private:
  /// What two balls do, or a ball and a box.
  const PairContact& pair_contact(int body, int other) const;
  bool is_substrate(int other) const { return other == kSubstrate && !scene_.box; }
  static std::size_t index(int body) { return static_cast<std::size_t>(body); }

  HardScene scene_;
  std::vector<double> raise_;  // max(1, m g dt), by body
};

/// What people type into a rigid body's own fields.
struct BodyFields {
  double friction = 0.5;
  double restitution = 0;
  double rolling_friction = 0;
  double spinning_friction = 0;
};

/// The scene's numbers straight: a ball gets μ_k and μ_r of its contact with the substrate, its
/// drilling length, and the restitution with the first other body (with the substrate when alone).
/// In a box it gets μ and restitution of its contact with the first other body (with the floor when
/// alone). A power law gives its value at its reference speed, a table of restitutions that at the
/// speed at which the two start relative to each other, a table of μ_r its first entry.
BodyFields naive_ball(const HardScene& scene, std::size_t body);

/// μ_k and restitution of the first body's contact with the substrate, or μ and restitution of its
/// contact with the box at kFloor, kWall or kLid.
BodyFields naive_surface(const HardScene& scene, int surface);

/// The first two bodies for each two materials, or one material, of which there are two: they stand
/// for all contacts between balls.
std::vector<std::pair<std::size_t, std::size_t>> material_pairs(const HardScene& scene);

}  // namespace slipcheck::bullet
