#pragma once

#include <span>

#include "physics/sphere.h"
#include "reference/pair/pair_collision.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// Whether collide_batch() has these laws: all but the power law, PowerForce.
bool can_batch(const SoftContact& contact);

/// Many collisions of two kinds of free spheres: for maps ε^T(g^N, g^T), sweeps and tuning. Each is
/// one lane of a SIMD vector; a lane whose collision ended takes the next one.
///
/// Without substrate and gravity, and in the limit of a contact much shorter than the time in which
/// the spheres pass each other (B, Sec. IV), the line of centres keeps its direction:
///   ξ̈ = −F_N/m_eff,  u̇ = F_T/(κ m_eff)  (elastic_pair.h),
/// from ξ = 0, ξ̇ = g_N, u = g_T to the contact's end. F_T acts on the first body: to F_T/m_eff from
/// the centres the spins add R²/I F_T each, because −R n×F_T turns both spheres and
/// d(−RΩ×n)/dt = (R²/I) (n×F_T)×n = (R²/I) F_T.
///
/// steps: in the duration of the collision without damping, >= 8. The first begins at the first
/// touch, the end is found inside of the last one. All errors are of second order in the step h,
/// whatever the laws: also from the root of x in B (24), where Coulomb's cap starts and ends to
/// hold, and where asperities break, any number in one step. What lasts for a part of a step alone
/// is seen coarsely, such as a cap that holds for an instant after the first touch; and a bend,
/// which swings at the frequency ω² = (μ/κ) F_N/(m_eff ζ0), needs hω below 1.
///
/// out: of the size of both speeds [m/s], > 0. The same bits on every instruction set, as all use
/// the same operations (none fused) in the same order for a lane; between machines as far as the C
/// library's pow and expm1 agree. Spheres that still touch after 1000 such durations have the
/// restitution 0 and an infinite duration.
///
/// Throws std::invalid_argument for a law that it does not have and for spans of unlike size, and
/// std::domain_error, which says how many steps are needed, for damping too fast for the steps;
/// what `out` holds is open then.
void collide_batch(const SoftContact& contact, const Sphere& first, const Sphere& second,
                   std::span<const double> normal_speed, std::span<const double> tangential_speed,
                   int steps, std::span<PairCollision> out);

/// How far a collision is from the one with half as many steps: where the error is of second order,
/// three times the error.
struct PairDoubt {
  double normal_restitution = 0;      ///< [-]
  double tangential_restitution = 0;  ///< [-]
  double duration = 0;                ///< [s]; 0 where both are infinite
};

/// The same with the doubt of each, at one and a half times the cost. steps: even, >= 16.
void collide_batch(const SoftContact& contact, const Sphere& first, const Sphere& second,
                   std::span<const double> normal_speed, std::span<const double> tangential_speed,
                   int steps, std::span<PairCollision> out, std::span<PairDoubt> doubt);

/// The SIMD instruction set that collide_batch() uses on this machine, by Highway's name.
const char* batch_target();

}  // namespace slipcheck
