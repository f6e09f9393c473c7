#pragma once

#include "physics/contact/hard_contact.h"
#include "physics/sphere.h"

namespace slipcheck {

/// One of two bodies that collide.
struct CollidingBody {
  const Sphere& sphere;
  const SubstrateContact& substrate;
  BodyState& state;
  bool supported;  ///< rests on the substrate when the collision begins
};

/// What a collision does besides changing the two states.
struct CollisionResult {
  double impact_speed = 0;            ///< normal, before [m/s], >= 0
  Vector3 impulse = Vector3::Zero();  ///< on the first body [N s]
  bool altered = false;               ///< the rule changed how they part
};

/// Options of the substrate's part in a collision.
struct CollisionRule {
  bool confined = false;  ///< bodies never leave the plane, whatever lifts them
  /// The pair parts at least this fast [m/s], >= 0: keeps an endless cascade of ever weaker
  /// collisions finite (inelastic collapse).
  double slowest_rebound = 0;
};

/// Two hard spheres that touch exchange an impulse at once, L (5)-(12) with the mobilities of
/// unlike spheres (B 8).
///
/// With n from the second to the first and u the velocity of the first at the contact point
/// relative to the second, u' follows from u_n' = −e u_n and u_t' = −β0 u_t. The impulse P on the
/// first obeys Δu = C P with
///   C = Σ [ S/m + (R²/I)(1 − n nᵀ) ],
/// S = 1 for a body that is free to move and 1 − k̂ k̂ᵀ for one that the substrate holds: the body
/// that is pressed down takes the substrate's reaction at once, K (9), (54); the one that is lifted
/// is free, or held too where the plane confines it. For two free equal spheres C is m12⁻¹ (n nᵀ +
/// κ⁻¹ (1 − n nᵀ)) of L and B. Where |P_t| would exceed μ P_n, its direction stays and its size is
/// μ P_n (for free spheres L's β = min[β0, β1]). The substrate's friction then acts on the pressed
/// body with the reaction's impulse.
CollisionResult collide(const PairContact& contact, const CollisionRule& rule, CollidingBody first,
                        CollidingBody second);

/// What two spheres that touch exchange at once where it is another law than that of hard spheres.
class CollisionLaw {
 public:
  virtual ~CollisionLaw() = default;
  /// Changes both states, seen from the substrate, as collide() does.
  virtual CollisionResult collide(const CollisionRule& rule, CollidingBody first,
                                  CollidingBody second) const = 0;
};

}  // namespace slipcheck
