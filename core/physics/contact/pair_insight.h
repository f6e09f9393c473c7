#pragma once

#include <array>

#include "physics/closed_forms.h"
#include "physics/contact/linear_contact.h"
#include "physics/contact/rubbing.h"
#include "physics/sphere.h"

namespace slipcheck {

// What closed forms say of two spheres of one radius that roll along a line on a level, still
// substrate and collide centrally with the linear law: K Sec. III-IV, App. C, D, F, derived anew
// (docs/model.md lists the misprints). Sphere 0 is behind and sphere 1 in front; speeds are signed
// along the line.

/// One of the two.
struct RollingSphere {
  Sphere sphere;
  double speed = 0;             ///< v [m/s]
  double static_friction = 0;   ///< μ_s with the substrate [-], >= kinetic_friction
  double kinetic_friction = 0;  ///< μ_k with the substrate [-], > 0
};

struct RollingPair {
  std::array<RollingSphere, 2> spheres;  ///< radii equal; spheres[0].speed > spheres[1].speed
  double gravity = 9.80665;              ///< g [m/s²], > 0
  double rubbing_rate = 0;               ///< γ_S [1/s], >= 0
  double rubbing_friction = 0;           ///< ν_s, Coulomb's cap of the rubbing [-], >= 0
  bool confined = false;                 ///< bodies never leave the plane

  double closing_speed() const { return spheres[0].speed - spheres[1].speed; }  ///< v_rel [m/s]
  /// v_i + v_j [m/s]: how fast the surfaces pass each other where they touch.
  double surface_speed() const { return spheres[0].speed + spheres[1].speed; }
};

/// When the spheres begin to slide during the collision, K (33)-(37), App. C.
///
/// F_N pushes a rolling sphere back; for it to keep rolling the substrate must turn it with
/// f = F_N/(1 + A), at most μ_s m g: it slides from F_N = (1 + A) μ_s m g on. For unlike spheres
/// the one that slides first counts. The rubbing F_R is left out (it is zero at equal speeds).
struct SlidingOnset {
  /// x_min = 2 (1 + A) μ_s g/ω0² for equal spheres: the overlap at which it begins, without damping
  /// [m].
  double overlap = 0;
  /// t_min = x_min/v_rel [s], without damping and to first order in ω0 t_min.
  double time = 0;
  /// The same exactly: with damping, by which F_N = γ_N m̄ v_rel at the first touch may be enough
  /// (0), and with the inertia of spheres that roll [s]; infinite: they never slide.
  double exact_time = 0;

  // Speeds v_rel [m/s]; v^b and v^c are K's letters.
  /// Sliding begins above it, exactly: the largest F_N over a damped collision of spheres that roll
  /// reaches the threshold. v^b √(A/(1 + A)) without damping.
  double sliding_speed = 0;
  /// v^b = x_min ω0 = 2 (1 + A) μ_s g/ω0 for equal spheres, K (35) corrected: the overlap v/ω0 of
  /// an undamped collision of sliding spheres reaches x_min.
  double v_b = 0;
  /// v^c = 2 (1 + A) μ_s g/γ_N for equal spheres, App. C corrected: above it sliding begins at the
  /// first touch; infinite without damping.
  double v_c = 0;
};

/// From the collision to rolling; K (38)-(44), (57)-(64). See SlideToRoll for the last part.
struct AfterCollision {
  double velocity = 0;          ///< v^f = v − (m̄/m)(1 + e_n) v_rel, signed [m/s]
  double surface_velocity = 0;  ///< R Ω^f = v − R ΔΩ [m/s]
  /// u^f = v^f − R Ω^f [m/s], with rubbing of the pair but without what the substrate's friction
  /// does in t_col (of order μ_k g t_col, and of μ_k C v_rel for the sphere pressed down).
  double slip = 0;
  double sliding_time = 0;      ///< t^s [s]
  double sliding_distance = 0;  ///< s, the displacement while it slides, signed [m]
  double rolling_velocity = 0;  ///< v^s [m/s]
  double energy_change = 0;     ///< ΔE = v^f² − v^s² [m²/s²]
  double momentum_change = 0;   ///< Δp = v^f − v^s per unit mass [m/s]
};

/// App. F: the rubbing lifts the faster sphere.
struct Jump {
  int sphere = 0;     ///< which one
  double speed = 0;   ///< v^z: (∫ F_R dt)/m less g t from the lift-off to the end [m/s]
  double height = 0;  ///< h^z = v^z²/(2g) [m]
  double time = 0;    ///< t^z = 2 v^z/g [s]
  /// v^d = m g/(γ_S m̄) (2g/γ_S for equal spheres) [m/s]: |v_i + v_j| above which viscous rubbing
  /// exceeds the weight at the first touch; infinite where Coulomb's cap ν_s F_N never lets it, at
  /// this v_rel.
  double v_d = 0;
};

struct PairInsight {
  double collision_time = 0;     ///< t_col [s]
  double contact_frequency = 0;  ///< ω0 [1/s]
  double damping_ratio = 0;      ///< ε = γ_N/ω0 [-]
  double restitution = 0;        ///< e_n [-]
  double largest_overlap = 0;    ///< x_max [m]
  /// App. D: the substrate's friction, μ_k g on each, presses sliding spheres together. To first
  /// order t_col grows by 4 μ_k g/(π v_rel ω0) and x_max by 2 μ_k g/(v_rel ω0) of itself [-].
  double collision_time_change = 0;
  double largest_overlap_change = 0;
  /// v^a = μ_k g/ω0, μ_k of both in the mean [m/s]: above it both changes are small.
  double v_a = 0;

  double rubbing_constant = 0;   ///< C, K (55): first order of the share of Ω_i + Ω_j [-]
  double exponential_share = 0;  ///< ½ (1 − e^(−2C)), without the cap [-]
  Rubbing rubbing;               ///< with the cap and, unless confined, the lift-off

  SlidingOnset onset;
  bool slides = false;  ///< v_rel > onset.sliding_speed; if not, what follows does not hold
  /// The substrate's friction turns each sphere during the collision: first as it rolls, then as it
  /// slides. To first order in ω0 t_min, without damping, R ΔΩ = A g (μ_s t_min/2 + μ_k (t_col −
  /// t_min)) [m/s] for equal spheres, the corrections of K (36), (37). Not part of AfterCollision.
  double substrate_turning = 0;
  std::array<AfterCollision, 2> after;
  /// e_eff: (A e_n − 1)/(1 + A) for equal spheres [-]. The substrate's friction on the sphere that
  /// the rubbing presses down meanwhile, left out here, adds A μ_k ∫F_R dt/((1 + A) m v_rel).
  double effective_restitution = 0;
  Jump jump;
};

/// The collision must end: contact.collision_time() finite. Its reduced mass is that of the pair.
PairInsight pair_insight(const LinearContact& contact, const RollingPair& pair);

/// App. D with the friction accelerating the spheres towards each other by `braking` [m/s²], 2 μ_k
/// g for equal ones: relative changes of t_col and x_max to first order, without damping.
double collision_time_change(double braking, double closing_speed, double contact_frequency);
double largest_overlap_change(double braking, double closing_speed, double contact_frequency);

}  // namespace slipcheck
