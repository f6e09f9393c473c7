#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "harness/observe/observables.h"
#include "harness/run/reference_run.h"
#include "physics/contact/linear_contact.h"
#include "physics/contact/pair_insight.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// K's steel spheres, App. B, C. The density is not printed; this one gives the printed t_col.
struct SteelParameters {
  double radius = 2e-3;             ///< R [m]
  double density = 7850;            ///< ρ [kg/m³]
  double collision_time = 2.55e-5;  ///< t_col at v_rel = 10 cm/s [s]
  double rubbing_ratio = 0.5;       ///< γ_S/γ_N [-]
  double rubbing_friction = 0.5;    ///< ν_s [-]
  double static_friction = 0.5;     ///< μ_s with the substrate [-]
  double kinetic_friction = 0.1;    ///< μ_k with the substrate [-]
  double gravity = 9.81;            ///< [m/s²]
};
inline constexpr SteelParameters kSteel{};

/// t_col [s] of a collision at v_rel [m/s], > 0: in proportion to v_rel^(−1/5), K App. B. Each
/// contact is linear all the same. (B1) lacks a factor 2 in the force, which makes the printed
/// number 2^(2/5) too long; it is kept.
double steel_collision_time(double v_rel);

/// All of them as the captions say it.
std::string steel_caption();

/// v_rel [cm/s] of integrated points, over the range that K considers.
inline constexpr std::array kSpeedPoints = {1.,  2.,  3.,  5.,  7.,  10., 20., 30.,
                                            40., 50., 60., 70., 80., 90., 100.};
inline constexpr std::size_t kTenCentimetres = 5;  ///< of them

/// g t_col/v_rel at v_rel [m/s], K (38): the order of what K leaves out, the substrate's friction
/// during the collision, beside the collision [-].
double left_out_by_k(double v_rel);

/// Two of them that roll along x towards each other: i from behind, j in front.
struct SteelPair {
  double v_i = 0, v_j = 0;   ///< [m/s], v_i > v_j
  double restitution = 0.9;  ///< e_n [-]
  bool confined = true;      ///< bodies never leave the plane, as in K Sec. II-IV
  double rubbing_ratio = kSteel.rubbing_ratio;  ///< γ_S/γ_N [-]

  /// The scene in which they first touch after `lead` [s], at x = 0.
  ContactScene scene(double lead = 0) const;
  RollingPair rolling() const;
  LinearContact contact() const;
  /// What closed forms say of them.
  PairInsight insight() const { return pair_insight(contact(), rolling()); }
  /// Until neither slides; the bodies are "i" and "j".
  ReferenceResult solve() const;
};

Sphere steel_sphere();

/// Both bodies at a time [s] of a scene that begins at 0, integrated.
std::vector<BodyState> states_at(const ContactScene& scene, double time);

/// R Ω_y [m/s]: the velocity with which a sphere that turns so rolls along x.
double surface_velocity(const BodyState& state, double radius);

/// An observable's value, NaN where it was not observed.
double value_of(const ReferenceResult& result, const std::string& name);

}  // namespace slipcheck
