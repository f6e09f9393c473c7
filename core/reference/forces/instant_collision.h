#pragma once

#include <memory>
#include <vector>

#include "physics/contact/collision.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// The collision of two bodies in the limit t_col → 0 of their own soft law, for solvers that take
/// collisions as instants.
///
/// Stiffer by s², with times by 1/s and lengths of the law by 1/s, the forces of a contact keep
/// their restitution, the share of the spin that they rub away and the number of asperities that
/// break, while weight and the way that the bodies go meanwhile vanish as 1/s. What stays is what
/// only the forces of the contact do: they press a body onto the substrate, which rubs it while the
/// contact lasts, or lift it off. No law for the sum of the impulses knows that; the collision is
/// integrated, alone, by ContactSolver, with a contact as short as 1e-9 of the time in which the
/// smaller body goes by its own radius.
class InstantCollision final : public CollisionLaw {
 public:
  /// `hard`: where the soft law has no part, of collisions that part slower than the rule allows.
  /// `softness`: factor on the time that the contact takes, > 0; what is left out is in proportion.
  InstantCollision(SoftContact soft, PairContact hard, double softness = 1)
      : soft_(std::move(soft)), hard_(std::move(hard)), softness_(softness) {}

  /// Throws IntegrationFailure.
  CollisionResult collide(const CollisionRule& rule, CollidingBody first,
                          CollidingBody second) const override;

 private:
  SoftContact soft_;
  PairContact hard_;
  double softness_;
};

/// Of each pair of materials with a soft contact; null for the others.
std::vector<std::shared_ptr<const CollisionLaw>> instant_collisions(const ContactScene& scene,
                                                                    double softness = 1);

}  // namespace slipcheck
