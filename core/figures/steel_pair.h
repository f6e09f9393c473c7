#pragma once

#include <string>
#include <vector>

#include "harness/observe/observables.h"
#include "harness/run/reference_run.h"
#include "physics/contact/linear_contact.h"
#include "physics/contact/pair_insight.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// K's steel spheres. The contact is linear, so t_col is the same at all speeds; K gives it at
/// 10 cm/s (App. B, whose formula is a factor 2^(2/5) too long; the number is kept as printed).
struct SteelParameters {
  double radius = 2e-3;             ///< R [m]
  double density = 7850;            ///< ρ [kg/m³]
  double collision_time = 2.55e-5;  ///< t_col [s]
  double rubbing_ratio = 0.5;       ///< γ_S/γ_N [-]
  double rubbing_friction = 0.5;    ///< ν_s [-]
  double static_friction = 0.5;     ///< μ_s with the substrate [-]
  double kinetic_friction = 0.1;    ///< μ_k with the substrate [-]
  double gravity = 9.81;            ///< [m/s²]
};
inline constexpr SteelParameters kSteel{};
/// All of them as the captions say it.
std::string steel_caption();

/// Two of them that roll along x towards each other: i from behind, j in front.
struct SteelPair {
  double v_i = 0, v_j = 0;   ///< [m/s], v_i > v_j
  double restitution = 0.9;  ///< e_n [-]
  bool confined = true;      ///< bodies never leave the plane, as in K Sec. II-IV

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
