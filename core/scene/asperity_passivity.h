#pragma once

#include <map>

#include "scene/scaled_impact.h"

namespace slipcheck {

/// Up to where the printed law of asperities, B (35), creates no energy.
///
/// An unbroken asperity is a spring whose stiffness (μ/ζ0) F_N follows the present F_N. With
/// m_eff ξ̈ = −F_N and the mass κ m_eff that it moves,
///   ζ̈ = (μ/(κ ζ0)) ξ̈ ζ,
/// and in the scales of the collision (scaled_impact.h), F_N being f there,
///   ζ'' = −Λ f ζ, Λ = μ L/(κ ζ0).
/// A slip too slow to break the asperity leaves with ε^T = ζ'(end)/ζ'(0). Without damping it
/// depends on Λ alone: 1 at Λ = 0, falling to −1 at one Λ and below −1 after it. Damping makes F_N
/// larger on the way in than on the way out, which takes energy from the slip too: with enough of
/// it no |ε^T| exceeds 1, but for what an attraction at the end of the contact adds.
///
/// `dissipation`: D at Λ = 1 [-], >= 0; both grow with the speed, Λ as v^(2/(1+α)) and D as v^p.
/// The least Λ [-] beyond which an |ε^T| exceeds 1; infinite where that was found nowhere up to a
/// hundred times the bound without damping, which is 316 times its speed where α = 3/2.
double largest_passive_bend(const ScaledLaw& law, ContactEnd end, double dissipation);

/// The impact speeds at which Λ reaches that bound, of pairs with one law and one end.
class PassiveSpeeds {
 public:
  explicit PassiveSpeeds(ContactEnd end) : end_(end) {}

  /// [m/s]; in faster impacts the printed law can create energy; maybe infinite. `at_one`: of the
  /// collision at 1 m/s; bend_per_length: μ/(κ ζ0) [1/m], > 0. Pairs of unlike spheres differ in
  /// the dissipation alone: it is taken to four digits and each is integrated once.
  double of(const ImpactScales& at_one, double bend_per_length);

 private:
  ContactEnd end_;
  std::map<double, double> bend_;  // by dissipation
};

}  // namespace slipcheck
