#pragma once

#include <algorithm>
#include <cmath>
#include <variant>

#include "physics/contact/hard_contact.h"

namespace slipcheck {

// Tangential forces between two spheres that touch. u is the velocity of the first sphere's surface
// relative to the second's across the line of centres, both ways: in the plane (K's shear F_S) and
// vertical (K's rubbing F_R); the law is isotropic in the tangent plane.

struct NoTangentialForce {};

/// K (4), (6) and Haff-Werner, B (39) with its sign mended: F_T = −min(c |u|, ν_s |F_N|) û,
/// c = γ_S m̄.
///
/// caps together: the vector F_T is capped, whichever way it points, as friction is that knows no
/// directions. apart: K's F_S in the plane and F_R across it have ν_s |F_N| each, and their sum up
/// to √2 of it.
struct ViscousForce {
  enum class Caps { together, apart };
  double damping = 0;   ///< c = γ_S m̄ [N s/m], >= 0
  double friction = 0;  ///< ν_s [-], >= 0
  Caps caps = Caps::together;

  /// |F_T| [N] at the slip speed |u| [m/s] below Coulomb's cap.
  double viscous(double slip) const { return damping * slip; }
  double cap(double normal) const { return friction * std::abs(normal); }
};

/// Asperities that bend and break, B (35), (37).
///
/// printed: F_T = −μ F_N (|ζ|/ζ0 − ⌊|ζ|/ζ0⌋) ζ̂ with the displacement ζ̇ = u since the first touch,
/// odd in ζ. It follows the present F_N, so a bent asperity gains energy as F_N grows.
/// passive: ζ is how far the asperity is bent; dF_T = −(μ/ζ0) F_N dζ while F_N grows, F_T scales
/// with F_N while it falls (Walton 1993), the asperity breaks at |ζ| = ζ0, and where F_N attracts
/// there is no F_T.
struct AsperityForce {
  enum class Form { printed, passive };
  double friction = 0;  ///< μ [-], >= 0
  double size = 0;      ///< ζ0 [m], > 0
  Form form = Form::printed;

  /// |F_T| [N] at the bend |ζ| [m] of an asperity that `broken` others came before.
  double force(double normal, double bend, double broken) const {
    return friction * normal * (bend / size - broken);
  }
};

/// L App. B: the rule of hard spheres, L (5)-(12), for contacts that last. F_T = −φ F_N along the
/// slip of the first touch as long as the contact lasts, with
///   φ = μ min(1, tan γ/tan γ0),  tan γ = u_t/g_N,  tan γ0 = μ (1 + e)/(κ (1 + β0)),
/// so that the sum of F_T is the impulse of the hard rule whatever the course of F_N; L (B2), (B3).
struct ImpactAngleForce {
  double friction = 0;                ///< μ [-], >= 0
  double tangential_restitution = 0;  ///< β0 [-], in [−1, 1]
  double mass_ratio = 2.0 / 7;        ///< κ of the pair, tangential_mass_ratio() [-]
  RestitutionLaw restitution = 1.0;   ///< e of the normal law at its impact speed

  /// φ [-] of an impact at g_N = `closing` [m/s] with the slip |u_t| [m/s]; where bodies do not
  /// approach, what slides slides.
  double ratio(double closing, double slip) const {
    if (!(closing > 0)) return slip > 0 ? friction : 0;
    const double sticking = mass_ratio * (1 + tangential_restitution) * slip /
                            ((1 + restitution_at(restitution, closing)) * closing);
    return std::min(friction, sticking);
  }
};

using TangentialForce =
    std::variant<NoTangentialForce, ViscousForce, AsperityForce, ImpactAngleForce>;

}  // namespace slipcheck
