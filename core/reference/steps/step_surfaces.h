#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/state_archive.h"
#include "reference/steps/step_contact.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// The contacts of StepLoop's bodies with surfaces at rest: of each with each, as few touch one.
class StepSurfaces {
 public:
  using Contact = StepContact<AnyNormalForce, AnyPair>;
  using Law = Contact::Law;

  /// The scene's surfaces are still, and it outlives this. laws: by material × surface.
  StepSurfaces(const Scene& scene, std::vector<Law> laws)
      : scene_(&scene), laws_(std::move(laws)), contacts_(scene.bodies.size() * count()) {}

  void exchange(StateArchive& archive) { archive(contacts_); }

  /// What they do to bodies now, beside what else does.
  [[gnu::noinline]] void meet(StepWorld& world) {
    StepBody surface;  // where it is touched
    for (std::size_t k = 0; k < world.bodies.size(); ++k) {
      StepBody& body = world.bodies[k];
      const std::size_t i = world.number_of(k);
      for (std::size_t s = 0; s < count(); ++s) {
        Contact& contact = contacts_[i * count() + s];
        const NearestPoint at = nearest_point(scene_->surfaces[s].shape, body.position);
        if (at.distance > body.radius && !contact.touching()) continue;
        StepTally tally;
        contact.step(
            world, body, surface, at.distance * at.normal,
            [&]() -> const Law& { return laws_[scene_->material[i] * count() + s]; }, tally,
            [&](const Contact::Push& push) { push.on(body, false); });
        world.touching += tally.touching;
      }
    }
  }

  /// Adds those that press a body.
  void show(const StepWorld& world, std::vector<Touch>& touches) const {
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      const double impulse = std::abs(contacts_[k].normal_force()) * world.step;
      if (contacts_[k].touching() && impulse > 0)
        touches.push_back({static_cast<int>(k / count()), surface_touch(k % count()), impulse});
    }
  }

 private:
  std::size_t count() const { return scene_->surfaces.size(); }

  const Scene* scene_;
  std::vector<Law> laws_;
  std::vector<Contact> contacts_;  ///< by body, in the scene's order, × surface
};

}  // namespace slipcheck
