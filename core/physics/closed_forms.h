#pragma once

#include "physics/sphere.h"

namespace slipcheck {

// Kondic's closed forms, in their corrected versions (docs/model.md lists the misprints), without
// rolling friction. They hold whatever the law of the contact, and but for the first two on a
// level, still substrate.

/// Acceleration [m/s²] of a sphere that rolls without slip on a substrate accelerated by
/// `substrate`, with gravity's part `downhill` along it; K (22), (24) with gravity beside the
/// collision forces:
///   a = (A a_G + a_S)/(1 + A),  (5/7) a_G + (2/7) a_S for a solid sphere.
/// From m a = m a_G + f and, without slip, a − a_S = −R k̂×Ω̇ = −A f/m, f the substrate's friction.
Vector3 rolling_acceleration(double A, const Vector3& downhill, const Vector3& substrate);

/// The largest |a_S − a_G| [m/s²] at which it keeps rolling, K (17), (25) with the substrate's
/// normal force: |f| = m |a_S − a_G|/(1 + A) <= μ_s F_N. `normal` is F_N/m, g on a level substrate:
/// 1.75 g for a solid sphere with μ_s = 1/2.
double rolling_limit(double A, double static_friction, double normal);

/// From a sliding start to rolling, given the state v^f, Ω^f in which the sliding begins.
///
/// The slip u^f = v^f + R k̂×Ω^f falls at (1+A) μ_k g along itself, so
///   t^s = |u^f|/((1+A) μ_k g),  v^s = v^f − u^f/(1+A),  displacement (v^f + v^s) t^s/2,
///   ΔE = |v^f|² − |v^s|²  (per unit mass, times 2),  Δp = v^f − v^s.
struct SlideToRoll {
  /// kinetic_friction, gravity [m/s²]: > 0.
  SlideToRoll(const Sphere& sphere, double kinetic_friction, double gravity,
              const Vector3& velocity, const Vector3& angular_velocity);

  Vector3 slip;              ///< u^f [m/s]
  double sliding_time;       ///< t^s [s]
  Vector3 rolling_velocity;  ///< v^s [m/s]
  Vector3 displacement;      ///< [m]
  double sliding_distance;   ///< s [m], its length
  double energy_change;      ///< ΔE [m²/s²]
  Vector3 momentum_change;   ///< Δp per unit mass [m/s]
};

/// What each of two spheres that meet at v and −v loses in the collision and while it slides
/// afterwards, K Sec. IV A 4: of its translational energy as shares of v², of its momentum of v
/// [-].
struct SymmetricLosses {
  double collision_energy;    ///< 1 − e_n²
  double collision_momentum;  ///< 1 − e_n
  double sliding_energy;      ///< (1 + e_n)(e_n − 1 + 2 A e_n)/(1 + A)², K (46)
  double sliding_momentum;    ///< (1 + e_n)/(1 + A), K (48)

  /// (1 + A)² (1 − e_n)/(e_n − 1 + 2 A e_n) [-], K (47).
  double energy_ratio() const { return collision_energy / sliding_energy; }
  /// (1 + A)(1 − e_n)/(1 + e_n) [-], K (49).
  double momentum_ratio() const { return collision_momentum / sliding_momentum; }
};

/// Two equal spheres that roll along one line and collide centrally, K Sec. IV. Velocities are
/// signed along the line; Ω stands for RΩ = v of rolling.
struct HeadOnCollision {
  double A = 2.5;          ///< m R²/I [-]
  double restitution = 1;  ///< e_n [-], in [0, 1]
  /// c in ΔΩ = −c (Ω_i + Ω_j) by the vertical rubbing of the pair, K (55): 0 for smooth spheres,
  /// ½ (1 − e^(−2C)) for viscous rubbing on confined spheres, ½ (1 + β0) for hard sticking ones.
  double spin_exchange = 0;

  /// v^f_i = ½[(1 − e) v_i + (1 + e) v_j].
  double velocity_after(double v_i, double v_j) const;
  /// R Ω^f_i = v_i − c (v_i + v_j).
  double surface_velocity_after(double v_i, double v_j) const;
  /// u^f_i = −½ (1 + e)(v_i − v_j) + c (v_i + v_j), K (62) corrected.
  double slip_after(double v_i, double v_j) const;
  /// v^s_i = v^f_i − u^f_i/(1 + A).
  double rolling_velocity(double v_i, double v_j) const;
  /// e_eff = (A e_n − 1)/(1 + A): what is left of the relative velocity once neither slides.
  /// Rubbing turns both spheres by the same ΔΩ and drops out.
  double effective_restitution() const;
  /// v_i/v_j for which sphere i slides back to where it was struck, K (61) corrected; −6 for smooth
  /// elastic solid spheres.
  double zero_sliding_distance_ratio() const;
  /// K (44): s of each of two spheres that meet at v and −v, v_rel = 2v [m/s].
  double symmetric_sliding_distance(double v_rel, double kinetic_friction, double gravity) const;
  /// K (46)-(49), whatever the speed, the size and the friction.
  SymmetricLosses symmetric_losses() const;
};

}  // namespace slipcheck
