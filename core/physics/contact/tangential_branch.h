#pragma once

#include <cmath>
#include <type_traits>
#include <variant>

#include "physics/contact/normal_force.h"
#include "physics/contact/tangential_force.h"
#include "physics/vector.h"

namespace slipcheck {

// The tangential laws in pieces on which they are smooth, for solvers that stop where a piece ends.
// V is Vector3, or double where everything happens in a plane.

/// On which piece of its law a tangential force is.
struct TangentialBranch {
  double force_sign = 1;   ///< of F_N: viscous, and passive asperity
  bool capped = false;     ///< viscous: at Coulomb's cap; with caps apart: in the plane
  bool growing = true;     ///< passive asperity: F_N grows
  double broken = 0;       ///< printed asperity: ⌊|ζ|/ζ0⌋
  bool capped_up = false;  ///< viscous with caps apart: across the plane
};

/// What may end a piece.
enum class TangentialEdge {
  force_sign,     ///< F_N changes its sign
  cap,            ///< the viscous force reaches Coulomb's cap, or falls below it
  cap_up,         ///< the same of its part across the plane, where caps are apart
  break_forward,  ///< the asperity breaks
  break_back,     ///< the printed saw-tooth is passed backwards
  growth,         ///< F_N stops to grow, or grows again
};

template <class V>
V no_vector() {
  if constexpr (std::is_same_v<V, double>)
    return 0;
  else
    return V::Zero();
}
inline double size_of(double v) { return std::abs(v); }
inline double size_of(const Vector3& v) { return v.norm(); }
/// `amount` along v, which has this size, > 0.
inline double along(double v, double, double amount) { return v < 0 ? -amount : amount; }
inline Vector3 along(const Vector3& v, double size, double amount) { return (amount / size) * v; }

// --- F_T [N] on the first body -------------------------------------------------------------------
// At F_N = `normal` [N], the slip u [m/s], and what the contact remembers: of an asperity its
// displacement or bend ζ [m], or of a passive one while F_N grows the sum ∫F_N dζ [N m]; of the
// impact's angle −φ along the first slip [-].

template <class V>
V tangential_force(const NoTangentialForce&, const TangentialBranch&, double, const V&, const V&) {
  return no_vector<V>();
}

template <class V>
V tangential_force(const ViscousForce& law, const TangentialBranch& branch, double normal,
                   const V& slip, const V&) {
  if (!branch.capped) return -law.damping * slip;
  const double speed = size_of(slip);
  if (!(speed > 0)) return no_vector<V>();
  return along(slip, speed, -law.friction * branch.force_sign * normal);
}

template <class V>
V tangential_force(const AsperityForce& law, const TangentialBranch& branch, double normal,
                   const V&, const V& bend) {
  if (law.form == AsperityForce::Form::printed) {
    const double size = size_of(bend);
    return size > 0 ? along(bend, size, -law.force(normal, size, branch.broken)) : no_vector<V>();
  }
  if (branch.force_sign < 0) return no_vector<V>();  // an attraction bends nothing
  const double stiffness = law.friction / law.size;
  return branch.growing ? V(-stiffness * bend) : V(-stiffness * normal * bend);
}

template <class V>
V tangential_force(const ImpactAngleForce&, const TangentialBranch&, double normal, const V&,
                   const V& bend) {
  return V(normal * bend);
}

template <class V>
V tangential_force(const TangentialForce& law, const TangentialBranch& branch, double normal,
                   const V& slip, const V& bend) {
  return std::visit(
      [&](const auto& each) -> V { return tangential_force(each, branch, normal, slip, bend); },
      law);
}

// --- caps apart, for solvers in space
// -------------------------------------------------------------

inline bool caps_apart(const TangentialForce& law) {
  const auto* viscous = std::get_if<ViscousForce>(&law);
  return viscous && viscous->caps == ViscousForce::Caps::apart;
}

/// Of the tangent plane of a contact along n: in the substrate's plane, and across it.
struct TangentAxes {
  Vector3 along, up;

  explicit TangentAxes(const Vector3& n) {
    const Vector3 across(-n.y(), n.x(), 0);  // k̂×n
    const double size = across.norm();
    along = size > 0 ? Vector3(across / size) : Vector3(Vector3::UnitX());
    up = n.cross(along);
  }
};

/// F_T [N] of any law, at the contact along n.
inline Vector3 tangential_force(const TangentialForce& law, const TangentialBranch& branch,
                                double normal, const Vector3& slip, const Vector3& bend,
                                const Vector3& n) {
  if (!caps_apart(law)) return tangential_force(law, branch, normal, slip, bend);
  const auto& viscous = std::get<ViscousForce>(law);
  const TangentAxes axes(n);
  TangentialBranch up = branch;
  up.capped = branch.capped_up;
  return tangential_force(viscous, branch, normal, slip.dot(axes.along), 0.0) * axes.along +
         tangential_force(viscous, up, normal, slip.dot(axes.up), 0.0) * axes.up;
}

/// How much of the slip decides at an edge [m/s].
inline double slip_at(TangentialEdge edge, const TangentialForce& law, const Vector3& slip,
                      const Vector3& n) {
  if (!caps_apart(law)) return slip.norm();
  const TangentAxes axes(n);
  return std::abs(slip.dot(edge == TangentialEdge::cap_up ? axes.up : axes.along));
}

// --- memory --------------------------------------------------------------------------------------

/// Whether the contact remembers anything.
inline bool has_memory(const TangentialForce& law) {
  return std::holds_alternative<AsperityForce>(law) ||
         std::holds_alternative<ImpactAngleForce>(law);
}

/// What it remembers from the first touch on, at which the bodies close in at `closing` [m/s].
template <class V>
V first_bend(const TangentialForce& law, double closing, const V& slip) {
  const auto* angle = std::get_if<ImpactAngleForce>(&law);
  const double size = angle ? size_of(slip) : 0;
  return size > 0 ? along(slip, size, -angle->ratio(closing, size)) : no_vector<V>();
}

/// The rate of that, without the turning of the contact.
template <class V>
V bend_rate(const TangentialForce& law, const TangentialBranch& branch, double normal,
            const V& slip) {
  const auto* asperity = std::get_if<AsperityForce>(&law);
  if (!asperity) return no_vector<V>();
  if (asperity->form == AsperityForce::Form::printed) return slip;
  if (branch.force_sign < 0) return no_vector<V>();
  return (branch.growing ? normal : 1.0) * slip;
}

/// What is left of it where F_N has fallen to zero for good, or for a while.
template <class V>
V bend_without_force(const TangentialForce& law, const V& bend) {
  return std::holds_alternative<ImpactAngleForce>(law) ? bend : no_vector<V>();
}

// --- from piece to piece -------------------------------------------------------------------------

/// Where friction with a cap is: a contact that begins, or that is looked at in steps over corners.
inline void follow(const TangentialForce& law, double normal, double slip,
                   TangentialBranch& branch) {
  branch.force_sign = normal < 0 ? -1 : 1;
  if (const auto* viscous = std::get_if<ViscousForce>(&law))
    branch.capped = viscous->viscous(slip) > viscous->cap(normal);
}

inline void follow(const TangentialForce& law, double normal, const Vector3& slip, const Vector3& n,
                   TangentialBranch& branch) {
  follow(law, normal, slip_at(TangentialEdge::cap, law, slip, n), branch);
  if (!caps_apart(law)) return;
  const auto& viscous = std::get<ViscousForce>(law);
  branch.capped_up =
      viscous.viscous(slip_at(TangentialEdge::cap_up, law, slip, n)) > viscous.cap(normal);
}

/// Calls watch(edge, direction) for each edge of this piece; 1 where its edge_value() rises through
/// zero, −1 where it falls, 0 for either.
template <class Watch>
void for_each_edge(const TangentialForce& law, const TangentialBranch& branch, ContactEnd end,
                   Watch watch) {
  const bool attracts = end == ContactEnd::zero_overlap;
  if (std::holds_alternative<ViscousForce>(law)) {
    if (attracts) watch(TangentialEdge::force_sign, 0);
    watch(TangentialEdge::cap, 0);
    if (caps_apart(law)) watch(TangentialEdge::cap_up, 0);
  } else if (const auto* asperity = std::get_if<AsperityForce>(&law)) {
    const bool passive = asperity->form == AsperityForce::Form::passive;
    const bool acts = !passive || branch.force_sign > 0;
    if (acts) watch(TangentialEdge::break_forward, 1);
    if (passive && attracts) watch(TangentialEdge::force_sign, 0);
    if (passive && acts) watch(TangentialEdge::growth, branch.growing ? -1 : 1);
    if (!passive && branch.broken > 0) watch(TangentialEdge::break_back, -1);
  }
}

/// What crosses zero at the edge; `growth` has the sign of dF_N/dt (force_growth()), `slip` and
/// `bend` are sizes.
inline double edge_value(TangentialEdge edge, const TangentialForce& law,
                         const TangentialBranch& branch, double normal, double growth, double slip,
                         double bend) {
  switch (edge) {
    case TangentialEdge::force_sign:
      return normal;
    case TangentialEdge::growth:
      return growth;
    case TangentialEdge::cap:
    case TangentialEdge::cap_up: {
      const auto& viscous = std::get<ViscousForce>(law);
      return viscous.viscous(slip) - viscous.cap(normal);
    }
    case TangentialEdge::break_forward: {
      const auto& asperity = std::get<AsperityForce>(law);
      const double reach = asperity.form == AsperityForce::Form::printed ? branch.broken + 1
                           : branch.growing                              ? normal
                                                                         : 1;
      return bend - reach * asperity.size;
    }
    case TangentialEdge::break_back:
      return bend - branch.broken * std::get<AsperityForce>(law).size;
  }
  return 0;
}

/// Goes on to the next piece; `rises`: edge_value() did.
template <class V>
void cross(TangentialEdge edge, bool rises, const TangentialForce& law, double normal,
           TangentialBranch& branch, V& bend) {
  switch (edge) {
    case TangentialEdge::force_sign:
      branch.force_sign = rises ? 1 : -1;
      if (!std::holds_alternative<AsperityForce>(law)) break;
      bend = no_vector<V>();
      branch.growing = true;
      break;
    case TangentialEdge::cap:
      branch.capped = rises;
      break;
    case TangentialEdge::cap_up:
      branch.capped_up = rises;
      break;
    case TangentialEdge::break_forward:
      if (std::get<AsperityForce>(law).form == AsperityForce::Form::printed)
        branch.broken += 1;
      else
        bend = no_vector<V>();
      break;
    case TangentialEdge::break_back:
      branch.broken -= 1;
      break;
    case TangentialEdge::growth:
      if (branch.growing == rises) break;
      // From F_N times the bend to the bend, or back.
      bend = rises ? V(bend * normal) : normal > 0 ? V(bend / normal) : no_vector<V>();
      branch.growing = rises;
      break;
  }
}

}  // namespace slipcheck
